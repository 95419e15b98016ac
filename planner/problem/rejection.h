#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "terramech/basics/angles.h"
#include "terramech/margins/state_margins.h"

namespace regoplan {

/// Why a state was rejected: the first of these, in this order, that it fails; and, below, why a
/// path that is driven cannot be followed.
enum class Rejection {
  kBounds,  ///< outside the map
  kSpeed,
  kUnknownTerrain,
  kObstacle,
  kSlope,
  kSinkage,
  kSlip,
  kSlipAngle,
  kTraction,
  kTipOver,
  kCornering,
  // Of a drive along a given path, not of a state.
  kSteering,   ///< a curvature beyond the vehicle's steering
  kDeviation,  ///< the vehicle strayed from the path
  kStalled,
  kDynamics,     ///< no motion balances the forces
  kDoesNotStop,  ///< at the end of the path
  kGoalMissed,   ///< the vehicle stands too far from it
};
/// Those of states come first.
inline constexpr int kRejectionCount = static_cast<int>(Rejection::kSteering);

/// What the number of a reason counts, and how it is shown.
struct RejectedQuantity {
  std::string_view words = {};  ///< `slope`, `cornering margin`; empty where there is no number
  double si_per_shown = 1;      ///< radians in a degree, for angles
  std::string_view unit = {};   ///< `deg`, `m`, `m/s`, `1/m`; empty of a ratio or a margin
  bool at_least = false;        ///< the limit is a least, as of margins; else a most
  bool either_way = false;      ///< signed, and the limit holds for both signs
};

/// A reason in words.
struct RejectionWords {
  Rejection rejection;
  std::string_view name;  ///< as it stands in files: `bounds`, `speed`, `unknown_terrain`, ...
  RejectedQuantity quantity = {};
};

/// In the order of the enumeration.
inline constexpr auto kRejectionWords = std::to_array<RejectionWords>({
    {Rejection::kBounds, "bounds"},
    {Rejection::kSpeed, "speed", {.words = "speed", .unit = "m/s"}},
    {Rejection::kUnknownTerrain, "unknown_terrain"},
    {Rejection::kObstacle, "obstacle"},
    {Rejection::kSlope, "slope", {.words = "slope", .si_per_shown = kDegree, .unit = "deg"}},
    {Rejection::kSinkage, "sinkage", {.words = "sinkage", .unit = "m"}},
    {Rejection::kSlip, "slip", {.words = "slip", .either_way = true}},
    {Rejection::kSlipAngle,
     "slip_angle",
     {.words = "slip angle", .si_per_shown = kDegree, .unit = "deg", .either_way = true}},
    {Rejection::kTraction, "traction", {.words = "traction margin", .at_least = true}},
    {Rejection::kTipOver, "tip_over", {.words = "tip over margin", .at_least = true}},
    {Rejection::kCornering, "cornering", {.words = "cornering margin", .at_least = true}},
    {Rejection::kSteering, "steering", {.words = "steering", .unit = "1/m", .either_way = true}},
    {Rejection::kDeviation, "deviation", {.words = "deviation", .unit = "m"}},
    {Rejection::kStalled, "stalled"},
    {Rejection::kDynamics, "dynamics"},
    {Rejection::kDoesNotStop, "does_not_stop", {.words = "speed at the end", .unit = "m/s"}},
    {Rejection::kGoalMissed, "goal_missed", {.words = "distance from the goal", .unit = "m"}},
});

std::string_view name(Rejection rejection);
const RejectedQuantity& quantity(Rejection rejection);

/// Whether a reason is one of the three stability margins.
bool is_margin(Rejection rejection);

/// What was found and what was allowed, SI, of the quantity that a reason names.
struct Exceeded {
  double found = 0;
  double limit = 0;
};

/// A place where the search met the edge of feasibility.
struct RejectedState {
  Rejection reason = Rejection::kBounds;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double speed_mps = 0;
  double curvature_1pm = 0;
  /// Nothing where the reason has no number. Of a margin: nothing where no steady trim exists.
  std::optional<Exceeded> exceeded = {};
  bool while_stopping = false;  ///< beyond a path's end, on the way that it takes to stop
};

/// The first margin, in the order of `Rejection`, that is missing or smaller than the least;
/// sinkage where a wheel sinks deeper in the steady trim than it may. \param at the state, which
/// the answer describes
std::optional<RejectedState> rejected_by(const StateMargins& margins, double margin_min,
                                         RejectedState at);

}  // namespace regoplan
