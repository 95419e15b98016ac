#include "planner/evaluation/spot_turn.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "planner/evaluation/tracked_drive.h"

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

/// At the start of a turn, at rest.
VehicleState before_turning(const SpotTurn& turn, const Vehicle& vehicle) {
  VehicleState state = state_at(turn, vehicle, std::copysign(0.0, turn.angle_rad));
  state.motion = {};
  state.turn_rate_rad_s = 0;
  return state;
}

class Turner {
 public:
  Turner(const World& world, const SpotTurn& turn, double deviation_max_m,
         const std::stop_token& stop)
      : vehicle_(world.problem().vehicle),
        turn_(turn),
        arm_m_(longest_arm_m(vehicle_)),
        side_(turn.angle_rad < 0 ? -1 : 1),
        drive_(world, before_turning(turn, vehicle_), turning_step_s(turn.rate_rad_s, vehicle_),
               deviation_max_m, stop) {}

  TrackingRun drive() {
    const double angle = std::abs(turn_.angle_rad);
    const double patience_s =
        5 * angle / turn_.rate_rad_s + 20 + 2 * turn_.rate_rad_s * arm_m_ / acceleration();
    if (const auto end = drive_.begin()) return drive_.finish(*end);
    bool slows = false;
    while (!slows || drive_.now().state.turn_rate_rad_s != 0) {
      if (drive_.now().time_s > patience_s) return drive_.finish(TrackingEnd::kStalled);
      const double rate = std::abs(drive_.now().state.motion.yaw_rate_rad_s);
      slows = slows || turned_rad_ + rate * rate * arm_m_ / (2 * acceleration()) >= angle;
      const auto end = drive_.step({.turn_rate_target_rad_s = slows ? 0 : side_ * turn_.rate_rad_s},
                                   [this](const VehicleState& before, const VehicleState& now) {
                                     return located(before, now);
                                   });
      if (end) return drive_.finish(*end);
    }
    return drive_.finish(TrackingEnd::kArrived);
  }

 private:
  double acceleration() const { return vehicle_.acceleration_max_mps2; }

  TrackedDrive::Place located(const VehicleState& before, const VehicleState& now) {
    turned_rad_ += side_ * std::remainder(now.yaw_rad - before.yaw_rad, 2 * std::numbers::pi);
    const double ahead_m = vehicle_.turn_centre_x_m;
    return {.s_m = std::max(turned_rad_, 0.0) * arm_m_,
            .offset_m = std::hypot(now.x_m + ahead_m * std::cos(now.yaw_rad) - turn_.centre_x_m,
                                   now.y_m + ahead_m * std::sin(now.yaw_rad) - turn_.centre_y_m)};
  }

  const Vehicle& vehicle_;
  SpotTurn turn_;
  double arm_m_, side_;
  double turned_rad_ = 0;
  TrackedDrive drive_;
};

}  // namespace

double turning_step_s(double rate_rad_s, const Vehicle& vehicle) {
  return std::clamp(0.05 / (rate_rad_s * longest_arm_m(vehicle)), 0.02, 0.25);
}

PathEvaluation evaluate(const World& verdict, const SpotTurn& turn,
                        const EvaluationSettings& settings) {
  const Vehicle& vehicle = verdict.problem().vehicle;
  assert(can_turn_on_the_spot(vehicle));
  validate(settings);
  const double allowed_m = settings.deviation_max_m.value_or(default_deviation_max_m(vehicle));
  const double arm_m = longest_arm_m(vehicle), angle = std::abs(turn.angle_rad);
  return judged(verdict,
                {.name = turn.name,
                 .length_m = angle * arm_m,
                 .duration_s = angle / turn.rate_rad_s,
                 .speed_max_mps = turn.rate_rad_s * arm_m,
                 .stations = stations_of(turn, vehicle),
                 .run = Turner(verdict, turn, allowed_m, settings.stop).drive(),
                 .deviation_allowed_m = allowed_m},
                settings);
}

}  // namespace regoplan
