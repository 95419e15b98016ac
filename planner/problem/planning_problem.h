#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "maps/terrain_map.h"
#include "planner/problem/limits.h"
#include "terramech/margins/margin_judge.h"
#include "terramech/parameters/vehicle.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

struct StartState {
  double x_m = 0;
  double y_m = 0;
  double heading_rad = 0;  ///< from +x toward +y
  double speed_mps = 0;

  bool operator==(const StartState&) const = default;
};

struct Goal {
  double x_m = 0;
  double y_m = 0;
  double radius_m = 0;
  std::optional<double> heading_rad;
  double heading_tolerance_rad = 0;  ///< either side; counts with a heading only
  /// The fastest that the vehicle may arrive; 0: it comes to rest there. Where it may arrive at
  /// speed, it must still be able to stop.
  double speed_max_mps = 0;

  bool operator==(const Goal&) const = default;
};

/// What a path costs in the planners that look for cheap ones (Lattice, StableSparse): a weighted
/// sum. Margins are kept by limits, not bought.
struct Objective {
  double per_s = 1;  ///< time
  double per_m = 0;  ///< length
  double per_j = 0;  ///< energy of the drives
  /// Time in which the stability margin m is below `exposed_below`, each second weighted by
  /// 1 - m/exposed_below.
  double per_exposed_s = 0;
  double exposed_below = 0.2;

  bool operator==(const Objective&) const = default;
};

inline constexpr std::int64_t kIterationsMax = 2000000000;

/// How to search. Exactly one of `time_s` and `iterations` bounds it: wall-clock seconds for the
/// whole search, or iterations of each planner run.
struct Search {
  std::string planner = "auto";  ///< one of `planner_names()`
  Objective objective = {};
  std::optional<double> time_s;
  std::optional<std::int64_t> iterations;
  std::uint64_t seed = 1;
  int candidates = 5;
  bool improve = true;   ///< optimise the controls of what is found (`improved`)
  int soil_draws = 100;  ///< for the quantiles and the probability of each candidate
  int threads = 2;       ///< changes the time taken, never the result under an iteration budget

  bool operator==(const Search&) const = default;
};

/// The names that `Search::planner` may take.
const std::vector<std::string>& planner_names();

/// One query: from where to where, with what, over which soils, within which limits.
struct PlanningProblem {
  TerrainMap map;
  Vehicle vehicle;
  WheelVariant wheel_variant = WheelVariant::kIshigami2007;
  std::vector<Mechanism> mechanisms = {};                   ///< of the wheel model, on every soil
  std::optional<GenericCorrection> generic = std::nullopt;  ///< likewise
  double gravity_mps2 = 9.80665;
  StartState start;
  Goal goal;
  double speed_max_mps = 0;
  Limits limits;
  Search search;
};

/// The wheel model of a problem's vehicle on a soil.
WheelModelSpec wheel_model_spec(const PlanningProblem& problem, const Soil& soil);

/// The limits of the wheels' strain, as margins are judged under them.
StrainLimits strain_limits(const Limits& limits);

/// Whether any of its numbers has a standard deviation.
bool is_uncertain(const MapSoil& soil);

/// Whether any soil of the map is; else there is nothing to draw.
bool has_uncertain_soil(const PlanningProblem& problem);

/// \throws ValueError or InputError for what cannot be asked: start or goal outside the map or on
/// unknown ground, start inside a rock, a limit or a budget that is not positive, ...
void validate(const PlanningProblem& problem);

}  // namespace regoplan
