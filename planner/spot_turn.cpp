#include "planner/spot_turn.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace regoplan {
namespace {

/// The vehicle, having turned by an angle.
VehicleState state_at(const SpotTurn& turn, const Vehicle& vehicle, double turned_rad) {
  const double yaw = turn.heading_rad + turned_rad,
               rate = std::copysign(turn.rate_rad_s, turned_rad);
  return {.x_m = turn.centre_x_m - vehicle.turn_centre_x_m * std::cos(yaw),
          .y_m = turn.centre_y_m - vehicle.turn_centre_x_m * std::sin(yaw),
          .yaw_rad = std::remainder(yaw, 2 * std::numbers::pi),
          .motion = {.vy_mps = -rate * vehicle.turn_centre_x_m, .yaw_rate_rad_s = rate},
          .turn_rate_rad_s = rate};
}

std::vector<Station> stations_of(const SpotTurn& turn, const Vehicle& vehicle) {
  constexpr double kApart_rad = 5 * std::numbers::pi / 180;
  const int pieces =
      std::max(4, static_cast<int>(std::ceil(std::abs(turn.angle_rad) / kApart_rad)));
  std::vector<Station> stations;
  for (int k = 0; k <= pieces; ++k) {
    // The first has not turned yet; its sign is that of the turn.
    const double turned = std::copysign(std::abs(turn.angle_rad) * k / pieces, turn.angle_rad);
    stations.push_back({.s_m = std::abs(turned) * longest_arm_m(vehicle),
                        .time_s = std::abs(turned) / turn.rate_rad_s,
                        .state = state_at(turn, vehicle, turned)});
  }
  return stations;
}

class Turner {
 public:
  Turner(const World& world, const SpotTurn& turn, double deviation_max_m)
      : world_(world),
        vehicle_(world.problem().vehicle),
        turn_(turn),
        deviation_max_m_(deviation_max_m),
        arm_m_(longest_arm_m(vehicle_)),
        side_(turn.angle_rad < 0 ? -1 : 1) {
    run_.step_s = std::clamp(0.05 / (turn.rate_rad_s * arm_m_), 0.02, 0.25);
    now_.state = state_at(turn, vehicle_, std::copysign(0.0, side_));
    now_.state.motion = {};
    now_.state.turn_rate_rad_s = 0;
  }

  TrackingRun drive() {
    const double angle = std::abs(turn_.angle_rad);
    const double patience_s =
        5 * angle / turn_.rate_rad_s + 20 + 2 * turn_.rate_rad_s * arm_m_ / acceleration();
    record(true);
    if (!allowed()) return finish(TrackingEnd::kRejected);
    bool slows = false;
    while (!slows || now_.state.turn_rate_rad_s != 0) {
      if (now_.time_s > patience_s) return finish(TrackingEnd::kStalled);
      const double rate = std::abs(now_.state.motion.yaw_rate_rad_s);
      slows = slows || turned_rad_ + rate * rate * arm_m_ / (2 * acceleration()) >= angle;
      const StepResult step = world_.dynamics().step(
          now_.state, {.turn_rate_target_rad_s = slows ? 0 : side_ * turn_.rate_rad_s},
          run_.step_s);
      now_.time_s += run_.step_s;
      if (!step.converged) {
        if (step.on_known_ground) return finish(TrackingEnd::kDynamics);
        run_.rejected = RejectedState{
            .reason = Rejection::kUnknownTerrain, .x_m = now_.state.x_m, .y_m = now_.state.y_m};
        return finish(TrackingEnd::kRejected);
      }
      turned_rad_ +=
          side_ * std::remainder(step.state.yaw_rad - now_.state.yaw_rad, 2 * std::numbers::pi);
      now_.state = step.state;
      now_.strain = step.strain;
      run_.energy_j += step.drive_energy_j;
      locate();
      record(false);
      if (!allowed()) return finish(TrackingEnd::kRejected);
      if (now_.offset_m > deviation_max_m_) return finish(TrackingEnd::kStrayed);
    }
    return finish(TrackingEnd::kArrived);
  }

 private:
  double acceleration() const { return vehicle_.acceleration_max_mps2; }

  bool allowed() {
    run_.rejected = world_.rejected(now_.state, now_.strain, std::nullopt);
    return !run_.rejected;
  }

  void locate() {
    const VehicleState& state = now_.state;
    const double ahead_m = vehicle_.turn_centre_x_m;
    now_.s_m = std::max(turned_rad_, 0.0) * arm_m_;
    now_.offset_m = std::hypot(state.x_m + ahead_m * std::cos(state.yaw_rad) - turn_.centre_x_m,
                               state.y_m + ahead_m * std::sin(state.yaw_rad) - turn_.centre_y_m);
    if (now_.offset_m > run_.deviation_max_m) {
      run_.deviation_max_m = now_.offset_m;
      run_.deviation_at = {state.x_m, state.y_m};
    }
  }

  void record(bool always) {
    run_.strain_max = largest_of(run_.strain_max, now_.strain);
    if (!always && now_.s_m < run_.moments.back().s_m + TrackingRun::kRecordEvery_m) return;
    run_.moments.push_back(now_);
  }

  TrackingRun finish(TrackingEnd end) {
    run_.end = end;
    run_.last = now_;
    run_.duration_s = now_.time_s;
    return std::move(run_);
  }

  const World& world_;
  const Vehicle& vehicle_;
  SpotTurn turn_;
  double deviation_max_m_, arm_m_, side_;
  double turned_rad_ = 0;
  TrackingRun::Moment now_;
  TrackingRun run_;
};

}  // namespace

PathEvaluation evaluate(const World& verdict, const SpotTurn& turn,
                        const EvaluationSettings& settings) {
  const Vehicle& vehicle = verdict.problem().vehicle;
  assert(can_turn_on_the_spot(vehicle));
  const double allowed_m = settings.deviation_max_m.value_or(default_deviation_max_m(vehicle));
  const double arm_m = longest_arm_m(vehicle), angle = std::abs(turn.angle_rad);
  return judged(verdict,
                {.name = turn.name,
                 .length_m = angle * arm_m,
                 .duration_s = angle / turn.rate_rad_s,
                 .speed_max_mps = turn.rate_rad_s * arm_m,
                 .stations = stations_of(turn, vehicle),
                 .run = Turner(verdict, turn, allowed_m).drive(),
                 .deviation_allowed_m = allowed_m},
                settings);
}

}  // namespace regoplan
