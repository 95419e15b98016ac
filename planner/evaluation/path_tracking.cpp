#include "planner/evaluation/path_tracking.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/evaluation/tracked_drive.h"

namespace regoplan {
namespace {

double angle_between(double to_rad, double from_rad) {
  return std::remainder(to_rad - from_rad, 2 * std::numbers::pi);
}

/// The place of the path nearest to a position, not far from where it was.
double nearest_m(const PathCurve& curve, double x_m, double y_m, double s_m) {
  double s = s_m;
  for (int i = 0; i < 3; ++i) {
    const CurvePlace place = curve.at(s);
    const double c = std::cos(place.heading_rad), n = std::sin(place.heading_rad);
    const double along = c * (x_m - place.x_m) + n * (y_m - place.y_m);
    const double left = c * (y_m - place.y_m) - n * (x_m - place.x_m);
    // On the inner side of a turn the path is shorter than the way.
    const double shrink = std::clamp(1 - place.curvature_1pm * left, 0.2, 5.0);
    s = std::clamp(s + along / shrink, 0.0, curve.length_m());
  }
  return s;
}

double offset_m(const CurvePlace& place, double x_m, double y_m) {
  return std::cos(place.heading_rad) * (y_m - place.y_m) -
         std::sin(place.heading_rad) * (x_m - place.x_m);
}

class Tracker {
 public:
  Tracker(const World& world, const ReferencePath& path, const SteeringLaw& law,
          double deviation_max_m, const std::stop_token& stop)
      : vehicle_(world.problem().vehicle),
        path_(path),
        law_(law),
        speed_top_mps_(path.speed.speed_max_mps()),
        direction_(path.reverse ? -1 : 1),
        drive_(world,
               path.recorded.empty() ? path.state_at(world.problem().vehicle, 0)
                                     : path.recorded.front().state,
               tracking_step_s(path.speed.speed_max_mps()), deviation_max_m, stop) {}

  TrackingRun drive() {
    const double patience_s =
        2 * path_.speed.duration_s(path_.curve.length_m()) + 20 + 200 * drive_.step_s();
    if (const auto end = drive_.begin()) return drive_.finish(*end);
    while (!arrived()) {
      if (drive_.now().time_s > patience_s) return drive_.finish(TrackingEnd::kStalled);
      const auto end = drive_.step(
          control(),
          [this](const VehicleState&, const VehicleState& state) { return located(state); });
      if (end) return drive_.finish(*end);
    }
    return drive_.finish(TrackingEnd::kArrived);
  }

 private:
  static double speed(const VehicleState& state) {
    return std::hypot(state.motion.vx_mps, state.motion.vy_mps);
  }

  bool arrived() const {
    const double near_m = std::max(0.02, 2 * speed(drive_.now().state) * drive_.step_s());
    return drive_.now().s_m >= path_.curve.length_m() - near_m;
  }

  TrackedDrive::Place located(const VehicleState& state) {
    const double s_m = nearest_m(path_.curve, state.x_m, state.y_m, drive_.now().s_m);
    const double rim = direction_ * state.rim_speed_mps;
    if (std::abs(rim) > 0.05 * speed_top_mps_) {
      const double share = drive_.step_s() / (drive_.step_s() + law_.slip_memory_s);
      const double ratio = std::clamp(speed(state) / rim, 0.5, 1.5);
      speed_per_rim_ += share * (ratio - speed_per_rim_);
    }
    return {.s_m = s_m, .offset_m = offset_m(path_.curve.at(s_m), state.x_m, state.y_m)};
  }

  VehicleControl control() const {
    const TrackingRun::Moment& now = drive_.now();
    const double v = speed(now.state);
    const CurvePlace place = path_.curve.at(now.s_m);
    const double ahead_m = now.s_m + v * law_.reaction_s;
    const double length =
        std::max(law_.lookahead_wheelbases * wheelbase_m(vehicle_), law_.lookahead_s * v);
    // At rest there is no course; the heading tells where it will go.
    const BodyMotion& motion = now.state.motion;
    const double slip_angle =
        v > 0.01 * speed_top_mps_
            ? std::atan2(direction_ * motion.vy_mps, direction_ * motion.vx_mps)
            : kinematic_body_slip_angle_rad(vehicle_, now.state.curvature_1pm);
    const double heading = now.state.yaw_rad + (path_.reverse ? std::numbers::pi : 0);
    const double course = angle_between(heading + slip_angle, place.heading_rad);
    const double curvature =
        path_.curvature_1pm(ahead_m) -
        direction_ * (now.offset_m / (length * length) + 2 * law_.damping * course / length);
    // From rest, the speed a little farther on: at rest itself the path says to stay.
    const double a = vehicle_.acceleration_max_mps2, dt = drive_.step_s();
    const double creep_mps = std::min(0.05 * speed_top_mps_, a * 4 * dt);
    const double target =
        std::max(creep_mps, path_.speed.at(now.s_m + v * dt + a * dt * dt / 2).speed_mps);
    return {.speed_target_mps = direction_ * target / speed_per_rim_,
            .curvature_target_1pm =
                std::clamp(curvature, -vehicle_.curvature_max_1pm, vehicle_.curvature_max_1pm)};
  }

  const Vehicle& vehicle_;
  const ReferencePath& path_;
  SteeringLaw law_;
  double speed_top_mps_;
  double direction_;  ///< 1 ahead, -1 in reverse
  TrackedDrive drive_;
  double speed_per_rim_ = 1;
};

}  // namespace

double ReferencePath::curvature_1pm(double s_m) const {
  if (recorded.empty()) return (reverse ? -1 : 1) * curve.at(s_m).curvature_1pm;
  const auto above =
      std::upper_bound(recorded.begin(), recorded.end(), s_m,
                       [](double s, const RecordedMoment& moment) { return s < moment.s_m; });
  if (above == recorded.begin()) return recorded.front().state.curvature_1pm;
  if (above == recorded.end()) return recorded.back().state.curvature_1pm;
  const RecordedMoment &b = *above, &a = *(above - 1);
  const double share = (s_m - a.s_m) / (b.s_m - a.s_m);
  return a.state.curvature_1pm + share * (b.state.curvature_1pm - a.state.curvature_1pm);
}

VehicleState ReferencePath::state_at(const Vehicle& vehicle, double s_m) const {
  const CurvePlace place = curve.at(s_m);
  const double curvature = curvature_1pm(s_m);
  const double slip_free = kinematic_body_slip_angle_rad(
      vehicle, std::clamp(curvature, -vehicle.curvature_max_1pm, vehicle.curvature_max_1pm));
  const SpeedProfile::Value value = speed.at(s_m);
  const double direction = reverse ? -1 : 1, v = direction * value.speed_mps;
  const double behind = reverse ? std::numbers::pi : 0;
  return {.x_m = place.x_m,
          .y_m = place.y_m,
          .yaw_rad = angle_between(place.heading_rad - slip_free, behind),
          .motion = {.vx_mps = v * std::cos(slip_free),
                     .vy_mps = v * std::sin(slip_free),
                     .yaw_rate_rad_s = v * curvature},
          .curvature_1pm = curvature,
          .rim_speed_mps = v,
          .rim_acceleration_mps2 = direction * value.acceleration_mps2};
}

WheelStrain largest_of(const WheelStrain& a, const WheelStrain& b) {
  const auto larger = [](double one, double other) {
    return std::abs(other) > std::abs(one) ? other : one;
  };
  return {.slip = larger(a.slip, b.slip),
          .slip_angle_rad = larger(a.slip_angle_rad, b.slip_angle_rad),
          .sinkage_m = std::max(a.sinkage_m, b.sinkage_m),
          .load_min_n = std::min(a.load_min_n, b.load_min_n),
          .torque_max_nm = larger(a.torque_max_nm, b.torque_max_nm)};
}

double tracking_step_s(double speed_max_mps) {
  constexpr double kTravel_m = 0.05, kLongest_s = 0.25;
  return std::min(kTravel_m / speed_max_mps, kLongest_s);
}

double wheelbase_m(const Vehicle& vehicle) {
  const auto [rear, front] =
      std::minmax_element(vehicle.wheels.begin(), vehicle.wheels.end(),
                          [](const WheelMount& a, const WheelMount& b) { return a.x_m < b.x_m; });
  return front->x_m - rear->x_m;
}

TrackingRun track(const World& world, const ReferencePath& path, const SteeringLaw& law,
                  double deviation_max_m, const std::stop_token& stop) {
  return Tracker(world, path, law, deviation_max_m, stop).drive();
}

}  // namespace regoplan
