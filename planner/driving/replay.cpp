#include "planner/driving/replay.h"

#include <algorithm>
#include <cmath>

#include "planner/driving/stopping.h"

namespace regoplan {
namespace {

/// Drives step by step and keeps the record.
class Driver {
 public:
  Driver(const World& world, const ReplaySteps& steps, bool with_margins)
      : world_(world), steps_(steps), with_margins_(with_margins), state_(world.start()) {
    record_.coarse.push_back(state_);
    with_margins_ ? judge() : check();
  }

  bool goes_on() const { return !record_.rejection && !record_.reached_goal; }

  /// Whether only the last creep with its wheels at rest keeps the vehicle from the goal.
  bool settles() const {
    return goes_on() && state_.rim_speed_mps == 0 && world_.within_goal(state_);
  }
  double curvature_1pm() const { return state_.curvature_1pm; }

  void drive_coarse_step(const VehicleControl& control) {
    const double fine_s = steps_.coarse_s / steps_.fine_per_coarse;
    ++coarse_steps_;
    const bool judges = with_margins_ && coarse_steps_ % steps_.coarse_per_margin == 0;
    int done = 0;
    for (; done < steps_.fine_per_coarse && goes_on(); ++done) {
      const StepResult step = world_.dynamics().step(state_, control, fine_s);
      record_.length_m += std::hypot(step.state.x_m - state_.x_m, step.state.y_m - state_.y_m);
      record_.energy_j += step.drive_energy_j;
      record_.duration_s += fine_s;
      state_ = step.state;
      strain_ = step.strain;
      if (!step.converged) {
        const Rejection reason =
            step.on_known_ground ? Rejection::kSlip : Rejection::kUnknownTerrain;
        reject({.reason = reason, .x_m = state_.x_m, .y_m = state_.y_m, .yaw_rad = state_.yaw_rad});
        return;
      }
      const bool last = done + 1 == steps_.fine_per_coarse;
      record_.reached_goal = world_.at_goal(state_);
      with_margins_ && ((last && judges) || record_.reached_goal) ? judge() : check();
      if (record_.reached_goal && !record_.rejection) check_stop();
    }
    if (done == steps_.fine_per_coarse) record_.coarse.push_back(state_);
  }

  Replay take() {
    if (with_margins_ && goes_on()) {  // the controls end short of the goal
      judge();
    }
    record_.end = state_;
    return std::move(record_);
  }

 private:
  void check() {
    if (const auto rejection = world_.rejected(state_, strain_, std::nullopt)) reject(*rejection);
  }
  void reject(const RejectedState& rejection) {
    record_.rejection = rejection;
    record_.rejection_time_s = record_.duration_s;
  }
  /// Nothing to check where it stands.
  void check_stop() {
    if (const auto refused = refused_stop(world_, state_, steps_)) reject(*refused);
  }
  /// As `check`, margins included; what passes is a point of the record.
  void judge() {
    const Judgement judgement = world_.judge(state_, strain_, record_.duration_s);
    if (judgement.rejected) return reject(*judgement.rejected);
    record_.points.push_back(judgement.point);
    record_.points.back().energy_j = record_.energy_j;
    record_.judged.push_back({state_, strain_});
  }

  const World& world_;
  ReplaySteps steps_;
  bool with_margins_;
  VehicleState state_;
  WheelStrain strain_;
  int coarse_steps_ = 0;
  Replay record_;
};

}  // namespace

Replay replay(const World& world, const std::vector<ControlSegment>& controls,
              const ReplaySteps& steps, bool with_margins) {
  Driver driver(world, steps, with_margins);
  for (const ControlSegment& segment : controls) {
    const auto count = static_cast<int>(std::lround(segment.duration_s / steps.coarse_s));
    for (int i = 0; i < count && driver.goes_on(); ++i) {
      driver.drive_coarse_step({.speed_target_mps = segment.speed_target_mps,
                                .curvature_target_1pm = segment.curvature_target_1pm});
    }
  }
  // The brakes are held until the vehicle stands. In a finer world that may take a moment longer
  // than in the one that the controls come from.
  constexpr double kSettling_s = 2;
  const auto most = static_cast<int>(std::ceil(kSettling_s / steps.coarse_s));
  for (int i = 0; i < most && driver.settles(); ++i) {
    driver.drive_coarse_step({.curvature_target_1pm = driver.curvature_1pm()});
  }
  return driver.take();
}

ReplaySteps verification_steps(const World& world) {
  constexpr double kMarginsEvery_s = 0.5, kMarginsEvery_m = 0.25;
  const double coarse = world.search_step_s();
  const double every_s = std::max(kMarginsEvery_s, kMarginsEvery_m / world.problem().speed_max_mps);
  return {.coarse_s = coarse,
          .fine_per_coarse = 10,
          .coarse_per_margin = std::max(1, static_cast<int>(std::lround(every_s / coarse)))};
}

double deviation_max_m(const Replay& a, const Replay& b) {
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.coarse.size(), b.coarse.size()); ++i) {
    largest = std::max(
        largest, std::hypot(a.coarse[i].x_m - b.coarse[i].x_m, a.coarse[i].y_m - b.coarse[i].y_m));
  }
  return largest;
}

}  // namespace regoplan
