#include "planner/ompl/search_steps.h"

#include <cmath>

namespace regoplan {

SearchStep SearchSteps::next(const VehicleSpace::Values& from, const VehicleControl& control,
                             double duration_s) {
  const StepResult step = world_.dynamics().step(from.vehicle, control, duration_s);
  ++count_;
  SearchStep reached{.values = {.vehicle = step.state,
                                .strain = step.strain,
                                .possible = step.converged || !step.on_known_ground},
                     .drive_energy_j = step.drive_energy_j};
  if (!step.on_known_ground) {
    VehicleState& state = reached.values.vehicle;
    const double travel = step.state.motion.vx_mps * duration_s;
    state.x_m += travel * std::cos(state.yaw_rad);
    state.y_m += travel * std::sin(state.yaw_rad);
  }
  return reached;
}

std::optional<Rejection> SearchSteps::rejected(const VehicleSpace::Values& values) {
  const VehicleState& state = values.vehicle;
  auto rejection = world_.rejected(state, values.strain, margin_min_);
  if (!rejection && !values.possible) {
    rejection = RejectedState{
        .reason = Rejection::kSlip, .x_m = state.x_m, .y_m = state.y_m, .yaw_rad = state.yaw_rad};
  }
  if (!rejection) return std::nullopt;
  rejections_.add(*rejection);
  return rejection->reason;
}

}  // namespace regoplan
