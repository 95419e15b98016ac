#include "planner/driving/crash_ahead.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace regoplan {
namespace {

struct DriveEnd {
  bool away = false;  ///< stopped, or turned round by a quarter
  double travelled_m = 0;
  std::optional<RejectedState> rejection{};
};

DriveEnd driven(const World& world, const VehicleControl& control) {
  constexpr double kLongest_s = 60;
  const double step_s = world.search_step_s();
  VehicleState state = world.start();
  DriveEnd end;
  for (double time_s = 0; time_s < kLongest_s && !end.away; time_s += step_s) {
    const StepResult step = world.dynamics().step(state, control, step_s);
    end.travelled_m += std::hypot(step.state.x_m - state.x_m, step.state.y_m - state.y_m);
    end.rejection = world.rejected(step.state, step.strain, std::nullopt);
    if (end.rejection || !step.converged) return end;
    state = step.state;
    const double turned =
        std::abs(std::remainder(state.yaw_rad - world.start().yaw_rad, 2 * std::numbers::pi));
    end.away = std::abs(state.motion.vx_mps) < 0.01 * world.problem().start.speed_mps ||
               turned > std::numbers::pi / 2;
  }
  end.away = true;
  return end;
}

}  // namespace

std::optional<std::string> crash_ahead(const World& world) {
  const PlanningProblem& problem = world.problem();
  const double speed = problem.start.speed_mps;
  if (speed <= 0) return std::nullopt;
  constexpr int kCurvatures = 12;  // to either side
  for (const double target : {0.0, speed}) {
    for (int i = -kCurvatures; i <= kCurvatures; ++i) {
      const double curvature = problem.vehicle.curvature_max_1pm * i / kCurvatures;
      if (driven(world, {.speed_target_mps = target, .curvature_target_1pm = curvature}).away) {
        return std::nullopt;
      }
    }
  }
  const DriveEnd straight = driven(world, {});
  const double needed_m = speed * speed / (2 * problem.vehicle.acceleration_max_mps2);
  return fmt::format(
      "from its start at {:.3g} m/s the vehicle can neither stop nor turn away: stopping takes "
      "{:.3g} m, and straight ahead {} ends it after {:.3g} m",
      speed, needed_m, straight.rejection ? name(straight.rejection->reason) : "slip",
      straight.travelled_m);
}

}  // namespace regoplan
