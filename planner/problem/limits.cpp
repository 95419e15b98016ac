#include "planner/problem/limits.h"

#include <array>
#include <string>

#include "planner/problem/planning_problem.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/parameters/trusted_range.h"

namespace regoplan {

Limits default_limits(const Vehicle& vehicle) {
  return {.margin_min = 0.05,
          .slip_max = vehicle.slip_max,
          .slip_angle_max_rad = vehicle.slip_angle_max_rad,
          .slope_max_rad = vehicle.slope_max_rad,
          .sinkage_max_m = vehicle.sinkage_max_m};
}

double steepest_held_rad(const Limits& limits) {
  constexpr double kRounding = 1e-4;
  return (1 + kRounding) * limits.slope_max_rad;
}

StrainLimits strain_limits(const Limits& limits) {
  return {.slip_angle_max_rad = limits.slip_angle_max_rad,
          .slip_max = limits.slip_max,
          .sinkage_max_m = limits.sinkage_max_m};
}

std::span<const LimitKey> limit_keys() {
  static constexpr ValueRange kShare{.min = 0, .max = 1, .max_excluded = true};
  static constexpr ValueRange kAngle_deg{.min = 0, .max = 60, .min_excluded = true};
  static constexpr auto kKeys = std::to_array<LimitKey>(
      {{"margin_min", &Limits::margin_min, 1, kShare},
       {"slip_max",
        &Limits::slip_max,
        1,
        {.min = 0, .max = kTrustedSlip_max, .min_excluded = true}},
       {"slip_angle_max_deg", &Limits::slip_angle_max_rad, kDegree, kAngle_deg},
       {"slope_max_deg", &Limits::slope_max_rad, kDegree, kAngle_deg},
       {"sinkage_max_m", &Limits::sinkage_max_m, 1, kAbove0},
       {"probability_min", &Limits::probability_min, 1, kShare}});
  return kKeys;
}

void validate(const Limits& limits) {
  for (const LimitKey& limit : limit_keys()) {
    // The range in SI, so that 60 degrees read from a file are within it to the last bit.
    ValueRange range = limit.shown_range;
    range.min *= limit.si_per_shown;
    range.max *= limit.si_per_shown;
    if (!range.contains(limits.*limit.value)) {
      throw ValueError("limits." + std::string(limit.key), limit.shown(limits),
                       limit.shown_range.text());
    }
  }
}

}  // namespace regoplan
