#include "planner/problem/rejection.h"

#include <array>
#include <cstddef>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

struct Reason {
  Rejection rejection;
  std::string_view name;
  RejectedQuantity quantity = {};
};

constexpr auto kReasons = std::to_array<Reason>({
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

constexpr bool in_order() {
  for (std::size_t i = 0; i < kReasons.size(); ++i) {
    if (kReasons[i].rejection != static_cast<Rejection>(i)) return false;
  }
  return true;
}
static_assert(in_order(), "the table stands in the order of the enumeration");

const Reason& reason(Rejection rejection) {
  return kReasons.at(static_cast<std::size_t>(rejection));
}

}  // namespace

std::string_view name(Rejection rejection) {
  return reason(rejection).name;
}

const RejectedQuantity& quantity(Rejection rejection) {
  return reason(rejection).quantity;
}

bool is_margin(Rejection rejection) {
  return quantity(rejection).at_least;
}

}  // namespace regoplan
