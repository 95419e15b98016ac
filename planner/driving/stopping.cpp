#include "planner/driving/stopping.h"

#include <cmath>

namespace regoplan {
namespace {

std::optional<RejectedState> refused_stop(const World& world, VehicleState state,
                                          double curvature_1pm, const ReplaySteps& steps) {
  const VehicleControl brake{.speed_target_mps = 0, .curvature_target_1pm = curvature_1pm};
  const double step_s = steps.coarse_s / steps.fine_per_coarse;
  const int steps_per_margin = steps.fine_per_coarse * steps.coarse_per_margin;
  constexpr double kSettling_s = 10;  // what slides longer with its wheels locked does not stop
  const double longest_s =
      std::abs(state.rim_speed_mps) / world.problem().vehicle.acceleration_max_mps2 + kSettling_s;
  RejectedState rejection;
  for (int i = 1; i * step_s < longest_s; ++i) {
    if (world.dynamics().at_rest(state)) return std::nullopt;
    const StepResult step = world.dynamics().step(state, brake, step_s);
    state = step.state;
    rejection = {.reason = Rejection::kSlip,
                 .x_m = state.x_m,
                 .y_m = state.y_m,
                 .yaw_rad = state.yaw_rad,
                 .speed_mps = state.motion.vx_mps,
                 .curvature_1pm = state.curvature_1pm};
    if (!step.converged) {
      if (!step.on_known_ground) rejection.reason = Rejection::kUnknownTerrain;
      return rejection;
    }
    const std::optional<double> margin_min =
        i % steps_per_margin == 0 ? std::optional(world.problem().limits.margin_min) : std::nullopt;
    if (const auto rejected = world.rejected(state, step.strain, margin_min)) return rejected;
  }
  return rejection;
}

}  // namespace

std::optional<RejectedState> refused_stop(const World& world, const VehicleState& from,
                                          const ReplaySteps& steps) {
  std::optional<RejectedState> refused = refused_stop(world, from, from.curvature_1pm, steps);
  if (!refused || !refused_stop(world, from, 0, steps)) return std::nullopt;
  refused->while_stopping = true;
  return refused;
}

}  // namespace regoplan
