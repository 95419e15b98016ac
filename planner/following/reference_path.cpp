#include "planner/following/reference_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terramech/basics/input_error.h"

namespace regoplan {

double PathLeg::curvature_1pm(double s_m) const {
  if (!recorded.empty()) return recorded_at(s_m).curvature_1pm;
  return direction() * curve.at(s_m).curvature_1pm;
}

VehicleState PathLeg::recorded_at(double s_m) const {
  const auto above =
      std::upper_bound(recorded.begin(), recorded.end(), s_m,
                       [](double s, const RecordedMoment& moment) { return s < moment.s_m; });
  if (above == recorded.begin()) return recorded.front().state;
  if (above == recorded.end()) return recorded.back().state;
  const RecordedMoment &b = *above, &a = *(above - 1);
  const double share = (s_m - a.s_m) / (b.s_m - a.s_m);
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  VehicleState state = a.state;
  state.x_m = between(a.state.x_m, b.state.x_m);
  state.y_m = between(a.state.y_m, b.state.y_m);
  state.yaw_rad += share * std::remainder(b.state.yaw_rad - a.state.yaw_rad, 2 * std::numbers::pi);
  state.motion.vx_mps = between(a.state.motion.vx_mps, b.state.motion.vx_mps);
  state.motion.yaw_rate_rad_s =
      between(a.state.motion.yaw_rate_rad_s, b.state.motion.yaw_rate_rad_s);
  state.curvature_1pm = between(a.state.curvature_1pm, b.state.curvature_1pm);
  return state;
}

VehicleState PathLeg::state_at(const Vehicle& vehicle, double s_m) const {
  const CurvePlace place = curve.at(s_m);
  const double curvature = curvature_1pm(s_m);
  const double slip_free = kinematic_body_slip_angle_rad(
      vehicle, std::clamp(curvature, -vehicle.curvature_max_1pm, vehicle.curvature_max_1pm));
  const SpeedProfile::Value value = speed.at(s_m);
  const double v = direction() * value.speed_mps;
  const double behind = reverse ? std::numbers::pi : 0;
  return {.x_m = place.x_m,
          .y_m = place.y_m,
          .yaw_rad = std::remainder(place.heading_rad - slip_free - behind, 2 * std::numbers::pi),
          .motion = {.vx_mps = v * std::cos(slip_free),
                     .vy_mps = v * std::sin(slip_free),
                     .yaw_rate_rad_s = v * curvature},
          .curvature_1pm = curvature,
          .rim_speed_mps = v,
          .rim_acceleration_mps2 = direction() * value.acceleration_mps2,
          .direction_at_rest = direction()};
}

double ReferencePath::duration_s() const {
  double time_s = 0;
  for (const PathLeg& leg : legs) time_s += leg.duration_s();
  return time_s;
}

double ReferencePath::speed_max_mps() const {
  double largest_mps = 0;
  for (const PathLeg& leg : legs) largest_mps = std::max(largest_mps, leg.speed.speed_max_mps());
  return largest_mps;
}

double ReferencePath::leg_start_m(std::size_t leg) const {
  double way_m = 0;
  for (std::size_t i = 0; i < leg; ++i) way_m += legs[i].length_m();
  return way_m;
}

ReferencePath::Place ReferencePath::place(double s_m) const {
  double way_m = 0, time_s = 0;
  std::size_t leg = 0;
  while (leg + 1 < legs.size() && s_m >= way_m + legs[leg].length_m()) {
    way_m += legs[leg].length_m();
    time_s += legs[leg].duration_s();
    ++leg;
  }
  return {.leg = legs[leg], .leg_start_s = time_s, .s_m = s_m - way_m};
}

void validate(const ReferencePath& path) {
  if (path.legs.empty()) throw ValueError("legs", 0, "at least one");
  for (std::size_t i = 0; i < path.legs.size(); ++i) {
    const PathLeg& leg = path.legs[i];
    const double length_m = leg.length_m(), end_m = leg.speed.nodes().back().s_m;
    constexpr double kRounding = 1e-6;
    if (end_m >= length_m * (1 - kRounding)) continue;
    throw ValueError(fmt::format("legs[{}].speed: its end, s_m", i), end_m,
                     fmt::format("at least {:.6g}, the length of the curve", length_m));
  }
}

VehicleState start_of(const ReferencePath& path, const Vehicle& vehicle) {
  const PathLeg& first = path.legs.front();
  return first.recorded.empty() ? first.state_at(vehicle, 0) : first.recorded.front().state;
}

double wheelbase_m(const Vehicle& vehicle) {
  const auto [rear, front] =
      std::minmax_element(vehicle.wheels.begin(), vehicle.wheels.end(),
                          [](const WheelMount& a, const WheelMount& b) { return a.x_m < b.x_m; });
  return front->x_m - rear->x_m;
}

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

}  // namespace regoplan
