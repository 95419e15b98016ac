#include "planner/ompl/goal_connection.h"

#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

namespace ob = ompl::base;
using ReedsShepp = ob::ReedsSheppStateSpace;

constexpr double kRadiusShare = 1.25;  // of the tightest
constexpr double kSpeedShare = 0.3;    // of the top speed
constexpr double kBrakeShare = 0.8;    // of the vehicle's acceleration

/// Draws the way step by step, slip-free. The point on the line of turn centres is what moves along
/// the heading.
class Way {
 public:
  Way(const OmplProblem& problem, const VehicleState& from)
      : problem_(problem.world().problem()),
        vehicle_(problem_.vehicle),
        world_(problem.world()),
        step_s_(problem.step_s()),
        yaw_rad_(from.yaw_rad),
        x_m_(from.x_m + vehicle_.turn_centre_x_m * std::cos(from.yaw_rad)),
        y_m_(from.y_m + vehicle_.turn_centre_x_m * std::sin(from.yaw_rad)),
        speed_mps_(from.rim_speed_mps),
        curvature_1pm_(centre_curvature(from.curvature_1pm)) {}

  void brake() {
    while (speed_mps_ != 0) step(0, curvature_1pm_);
  }
  /// At rest.
  void steer(double curvature_1pm) {
    while (curvature_1pm_ != curvature_1pm) step(0, curvature_1pm);
  }
  /// From rest to rest.
  void travel(double length_m) {
    const double sign = length_m < 0 ? -1 : 1;
    const double a = kBrakeShare * vehicle_.acceleration_max_mps2;
    const double top = kSpeedShare * problem_.speed_max_mps;
    double left = std::abs(length_m);
    while (left > 1e-3) {
      // As fast as it can still stop from after this step.
      const double stoppable = std::sqrt(2 * a * left) - a * step_s_;
      const double speed = std::clamp(stoppable, std::min(left / step_s_, 0.02 * top), top);
      const double before = std::abs(speed_mps_);
      step(sign * speed, curvature_1pm_);
      left -= (before + std::abs(speed_mps_)) / 2 * step_s_;
    }
    brake();
  }

  double x_m() const { return x_m_; }
  double y_m() const { return y_m_; }
  double yaw_rad() const { return yaw_rad_; }
  bool blocked() const { return blocked_; }
  std::vector<GoalConnection::Step> take() { return std::move(steps_); }

 private:
  double centre_curvature(double curvature_1pm) const {
    const double share = curvature_1pm * vehicle_.turn_centre_x_m;
    return curvature_1pm / std::sqrt(std::max(1e-6, 1 - share * share));
  }
  double commanded_curvature(double centre_curvature_1pm) const {
    return centre_curvature_1pm / std::hypot(1, centre_curvature_1pm * vehicle_.turn_centre_x_m);
  }
  VehicleState state() const {
    return {.x_m = x_m_ - vehicle_.turn_centre_x_m * std::cos(yaw_rad_),
            .y_m = y_m_ - vehicle_.turn_centre_x_m * std::sin(yaw_rad_),
            .yaw_rad = yaw_rad_,
            .curvature_1pm = commanded_curvature(curvature_1pm_),
            .rim_speed_mps = speed_mps_};
  }
  void step(double speed_mps, double curvature_1pm) {
    const auto approached = [](double value, double target, double most) {
      return value + std::clamp(target - value, -most, most);
    };
    GoalConnection::Step next{
        .control = {.speed_target_mps = speed_mps,
                    .curvature_target_1pm = commanded_curvature(curvature_1pm)},
        .due = state()};
    const double speed = speed_mps_, curvature = curvature_1pm_;
    speed_mps_ = approached(speed, speed_mps, vehicle_.acceleration_max_mps2 * step_s_);
    curvature_1pm_ =
        approached(curvature, curvature_1pm, vehicle_.curvature_rate_max_1pms * step_s_);
    const double travel = (speed + speed_mps_) / 2 * step_s_;
    const double turn = travel * (curvature + curvature_1pm_) / 2;
    x_m_ += travel * std::cos(yaw_rad_ + turn / 2);
    y_m_ += travel * std::sin(yaw_rad_ + turn / 2);
    yaw_rad_ += turn;
    steps_.push_back(next);
    const VehicleState there = state();
    const GroundPatch patch = world_.dynamics().ground(there.x_m, there.y_m, there.yaw_rad);
    blocked_ = blocked_ || !patch.known || world_.obstacles().hit(there, patch);
  }

  const PlanningProblem& problem_;
  const Vehicle& vehicle_;
  const World& world_;
  double step_s_;
  double yaw_rad_, x_m_, y_m_;
  double speed_mps_, curvature_1pm_;
  bool blocked_ = false;
  std::vector<GoalConnection::Step> steps_;
};

ReedsShepp::ReedsSheppPath shortest(const ReedsShepp& space, const Way& from, const Goal& goal,
                                    double turn_centre_x_m) {
  auto* a = space.allocState()->as<ob::SE2StateSpace::StateType>();
  auto* b = space.allocState()->as<ob::SE2StateSpace::StateType>();
  a->setXY(from.x_m(), from.y_m());
  a->setYaw(from.yaw_rad());
  b->setXY(goal.x_m + turn_centre_x_m * std::cos(*goal.heading_rad),
           goal.y_m + turn_centre_x_m * std::sin(*goal.heading_rad));
  b->setYaw(*goal.heading_rad);
  const ReedsShepp::ReedsSheppPath path = space.reedsShepp(a, b);
  space.freeState(a);
  space.freeState(b);
  return path;
}

}  // namespace

GoalConnection connection_to_goal(const OmplProblem& problem, const VehicleState& from,
                                  double longest_m) {
  const PlanningProblem& asked = problem.world().problem();
  if (!asked.goal.heading_rad) return {};
  const Vehicle& vehicle = asked.vehicle;
  const double radius_m = kRadiusShare / vehicle.curvature_max_1pm;
  Way way(problem, from);
  way.brake();
  const ReedsShepp::ReedsSheppPath path =
      shortest(ReedsShepp(radius_m), way, asked.goal, vehicle.turn_centre_x_m);
  if (path.length() * radius_m > longest_m) return {};
  for (std::size_t i = 0; i < 5 && !way.blocked(); ++i) {
    const double length_m = path.length_[i] * radius_m;
    if (path.type_[i] == ReedsShepp::RS_NOP || length_m == 0) continue;
    const double side = path.type_[i] == ReedsShepp::RS_LEFT    ? 1
                        : path.type_[i] == ReedsShepp::RS_RIGHT ? -1
                                                                : 0;
    way.steer(side / radius_m);
    way.travel(length_m);
  }
  if (way.blocked()) return {};
  return {.steps = way.take()};
}

}  // namespace regoplan
