#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "planner/evaluation/spot_turn.h"
#include "planner/following/reference_path.h"

namespace regoplan {

/// Manoeuvres that vehicles are compared by.
enum class ManoeuvreKind {
  kSteadyTurn,
  kLaneChange,
  kSlalom,
  kSlopeTraverse,
  kBrakingInATurn,
  kPointTurn,
};
std::string_view name(ManoeuvreKind kind);  ///< `steady_turn`, ...

/// A manoeuvre on a plane of one soil, as a vehicle meets it at a constant speed. Fields that its
/// kind does not name do not count.
struct Manoeuvre {
  ManoeuvreKind kind = ManoeuvreKind::kSteadyTurn;
  std::string name;
  Vehicle vehicle;
  MapSoil soil;
  double speed_mps = 0;
  double slope_rad = 0;          ///< of the plane
  double slope_heading_rad = 0;  ///< uphill, from the heading at the start, left positive

  double radius_m = 0;         ///< steady turn, braking in a turn
  double angle_rad = 0;        ///< of the turn at full curvature, braking aside; point turn
  bool to_the_right = false;   ///< the turn, the lane change or the first bow
  double offset_m = 0;         ///< lane change
  double length_m = 0;         ///< lane change, slope traverse
  double amplitude_m = 0;      ///< slalom
  double wavelength_m = 0;     ///< slalom
  double waves = 0;            ///< slalom
  double braking_mps2 = 0;     ///< braking in a turn
  double turn_rate_rad_s = 0;  ///< point turn, in place of the speed
};

/// A manoeuvre as a problem of its own: its plane as a small map, and its path or turn.
struct PreparedManoeuvre {
  PlanningProblem problem;
  std::variant<ReferencePath, SpotTurn> course;
};

/// \param limits that its states keep \param base the rest: gravity, wheel variant, search
/// \throws ValueError for a speed above the vehicle's, one so small that driving takes more steps
/// than an evaluation takes on (`planner/evaluation/course_bounds.h`), or a number that is not
/// positive; InputError for a point turn of a vehicle that cannot turn on the spot
PreparedManoeuvre prepare(const Manoeuvre& manoeuvre, const Limits& limits,
                          const PlanningProblem& base);

/// How much faster than it is meant to a vehicle may roll when it is driven along a path.
inline constexpr double kSpeedTolerance = 1.1;

}  // namespace regoplan
