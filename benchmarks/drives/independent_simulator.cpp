#include "benchmarks/drives/independent_simulator.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "benchmarks/drives/linear_system.h"
#include "benchmarks/drives/load_shares.h"
#include "benchmarks/drives/rim_integral.h"

namespace regoplan::drives {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFadeSpeed_mps = 1e-3, kTransferLag_s = 0.1;

double faded(double force, double a, double b) {
  const double speed = std::hypot(a, b);
  return force * speed / std::hypot(speed, kFadeSpeed_mps);
}

double moved_to(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

/// The vehicle as it truly is, about its true centre of gravity.
Vehicle carried(Vehicle vehicle, const DriveTruth& truth) {
  vehicle.yaw_inertia_kgm2 *= 1 + truth.payload_kg / vehicle.mass_kg;
  vehicle.mass_kg += truth.payload_kg;
  vehicle.cg_height_m += truth.cg_up_m;
  for (WheelMount& mount : vehicle.wheels) {
    mount.x_m -= truth.cg_forward_m;
    mount.y_m -= truth.cg_left_m;
  }
  if (vehicle.rocker_bogie) {
    vehicle.rocker_bogie->rocker_pivot_x_m -= truth.cg_forward_m;
    vehicle.rocker_bogie->bogie_pivot_x_m -= truth.cg_forward_m;
  }
  return vehicle;
}

}  // namespace

/// Ground and commands at a moment.
struct IndependentSimulator::Posture {
  std::array<std::int16_t, kMaxWheels> soil{};
  double slope_along = 0, slope_left = 0, hollow = 0, yaw = 0;
  double curvature = 0, crab = 0, rim = 0;

  double length() const { return std::sqrt(1 + slope_along * slope_along); }
  double tall() const { return std::sqrt(1 + slope_along * slope_along + slope_left * slope_left); }
};

IndependentSimulator::IndependentSimulator(const Vehicle& vehicle, std::vector<Soil> soils,
                                           double gravity_mps2, VehicleDynamics::Ground ground,
                                           double longest_step_s, const DriveTruth& truth)
    : vehicle_(vehicle),
      truth_(truth),
      faults_(truth.wheels.empty() ? std::vector<WheelFault>(vehicle.wheels.size()) : truth.wheels),
      carried_(carried(vehicle, truth)),
      soils_(std::move(soils)),
      gravity_(gravity_mps2),
      ground_(std::move(ground)),
      longest_step_s_(longest_step_s),
      shares_(load_shares(carried_)) {}

/// The state of the true centre of gravity from that of the known one, by sign 1, or back by -1.
VehicleState IndependentSimulator::moved(VehicleState state, double sign) const {
  const double forward = sign * truth_.cg_forward_m, left = sign * truth_.cg_left_m;
  const double c = std::cos(state.yaw_rad), s = std::sin(state.yaw_rad);
  state.x_m += c * forward - s * left;
  state.y_m += s * forward + c * left;
  state.motion.vx_mps -= state.motion.yaw_rate_rad_s * left;
  state.motion.vy_mps += state.motion.yaw_rate_rad_s * forward;
  return state;
}

double IndependentSimulator::load(std::size_t wheel, double normal, double along,
                                  double left) const {
  const auto& share = shares_[wheel];
  return share[0] * normal + share[1] * along + share[2] * left;
}

IndependentSimulator::WheelAnswer IndependentSimulator::wheel(const Soil& soil, double load_n,
                                                              double along_mps, double left_mps,
                                                              double rim_mps) const {
  const RimIntegral rim(vehicle_.wheel, soil, gravity_, along_mps, left_mps, rim_mps);
  // Upward force grows with the sinkage from nothing: bracketed outward from the one found last,
  // then the secant method kept within the bracket (Illinois).
  double low = 0.97 * last_sinkage_m_, f_low = rim.at(low).up - load_n;
  while (f_low > 0) {
    low *= 0.7;
    f_low = rim.at(low).up - load_n;
  }
  double high = std::max(1.03 * last_sinkage_m_, 1.01 * low), f_high = rim.at(high).up - load_n;
  while (f_high < 0) {
    low = high;
    f_low = f_high;
    high *= 1.3;
    if (high >= vehicle_.wheel.radius_m) return {.carried = false};
    f_high = rim.at(high).up - load_n;
  }
  double sinkage = high;
  for (int round = 0; round < 60; ++round) {
    sinkage = high - f_high * (high - low) / (f_high - f_low);
    const double f = rim.at(sinkage).up - load_n;
    if (std::abs(f) < 1e-8 * load_n) break;
    if ((f < 0) == (f_low < 0)) {
      low = sinkage;
      f_low = f;
      f_high /= 2;
    } else {
      high = sinkage;
      f_high = f;
      f_low /= 2;
    }
  }
  last_sinkage_m_ = sinkage;
  const Contact contact = rim.at(sinkage, true);
  return {.along_n = faded(contact.along, along_mps, rim_mps),
          .left_n = -std::copysign(faded(contact.aside, left_mps, rim_mps), left_mps),
          .torque_nm = faded(contact.torque, along_mps, rim_mps),
          .sinkage_m = sinkage};
}

IndependentSimulator::Sum IndependentSimulator::forces(const Motion& motion, const Posture& at,
                                                       double transfer_along, double transfer_left,
                                                       std::vector<WheelNow>* wheels) const {
  const double normal =
      carried_.mass_kg * (gravity_ / at.tall() + motion.along * motion.along * at.hollow);
  // The turn centre, seen from the vehicle's origin; the crab angle turns it about the origin.
  const double k = at.curvature, xc = vehicle_.turn_centre_x_m;
  const double ahead = std::sqrt(1 - k * xc * k * xc), aside = -k * xc;
  const double c = std::cos(at.crab), s = std::sin(at.crab);
  const double course_x = c * ahead - s * aside, course_y = s * ahead + c * aside;
  Sum sum;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const WheelMount& mount = vehicle_.wheels[i];
    const double gx = course_x - k * mount.y_m, gy = course_y + k * mount.x_m;
    const double steer = mount.steered ? std::atan2(gy, gx) : 0;
    const double rim = at.rim * (mount.steered ? std::hypot(gx, gy) : gx);
    const double arm_x = carried_.wheels[i].x_m, arm_y = carried_.wheels[i].y_m;
    const double vx = motion.along - motion.turn * arm_y;
    const double vy = motion.left + motion.turn * arm_x;
    const double points = steer + faults_[i].steer_offset_rad;
    const double cs = std::cos(points), sn = std::sin(points);
    const double along = cs * vx + sn * vy, left = cs * vy - sn * vx;
    const double weight = load(i, normal, transfer_along, transfer_left);
    WheelAnswer answer;
    if (weight > 0) {
      answer = wheel(soils_.at(static_cast<std::size_t>(at.soil.at(i))), weight, along, left, rim);
    }
    const double fx = cs * answer.along_n - sn * answer.left_n;
    const double fy = sn * answer.along_n + cs * answer.left_n;
    sum.along += fx;
    sum.left += fy;
    sum.moment += arm_x * fy - arm_y * fx;
    if (wheels == nullptr) continue;
    wheels->push_back(
        {.load_n = weight,
         .steer_rad = steer,
         .rim_speed_mps = rim,
         .slip = rim > along ? (rim - along) / rim : (rim - along) / along,
         .slip_angle_rad = std::atan2(left, std::abs(along)),
         .torque_nm = answer.torque_nm + (rim == 0 ? 0 : std::copysign(faults_[i].drag_nm, rim)),
         .sinkage_m = answer.sinkage_m});
  }
  return sum;
}

GroundPatch IndependentSimulator::ground(const VehicleState& state) const {
  return ground_(state.x_m, state.y_m, state.yaw_rad);
}

/// TR-BDF2 (Bank et al. 1985): a trapezoidal stage to gamma h, then BDF2 over the rest; Newton's
/// method with slopes by differences.
StepResult IndependentSimulator::substep(const VehicleState& state, const VehicleControl& control,
                                         double h) const {
  const double gamma = 2 - std::numbers::sqrt2;
  const double m = carried_.mass_kg, inertia = carried_.yaw_inertia_kgm2;
  bool known = true, balanced = true;
  const auto posture_at = [&](double after, double x, double y, double yaw) {
    const double ahead = truth_.cg_forward_m, aside = truth_.cg_left_m;
    const GroundPatch patch = ground_(x - std::cos(yaw) * ahead + std::sin(yaw) * aside,
                                      y - std::sin(yaw) * ahead - std::cos(yaw) * aside, yaw);
    known = known && patch.known;
    const double turn = vehicle_.curvature_rate_max_1pms * after;
    double arm = 0;
    for (const WheelMount& w : vehicle_.wheels) arm = std::max(arm, std::hypot(w.x_m, w.y_m));
    return Posture{.soil = patch.soil,
                   .slope_along = patch.slope_forward,
                   .slope_left = patch.slope_left,
                   .hollow = patch.curvature_1pm,
                   .yaw = yaw,
                   .curvature = moved_to(state.curvature_1pm, control.curvature_target_1pm, turn),
                   .crab = moved_to(state.crab_rad, control.crab_target_rad, turn * arm),
                   .rim = moved_to(state.rim_speed_mps, control.speed_target_mps,
                                   vehicle_.acceleration_max_mps2 * after)};
  };
  using Rates = std::array<double, 5>;  // of the velocities and of the transferred forces
  const auto rates = [&](const Rates& y, const Posture& at) {
    const Sum sum = forces({y[0], y[1], y[2]}, at, y[3], y[4], nullptr);
    const double p = at.slope_along, q = at.slope_left;
    const double gx = -gravity_ * p / at.length();
    const double gy = -gravity_ * q / (at.tall() * at.length());
    return Rates{sum.along / m + gx + y[1] * y[2], sum.left / m + gy - y[0] * y[2],
                 sum.moment / inertia, (sum.along - y[3]) / kTransferLag_s,
                 (sum.left - y[4]) / kTransferLag_s};
  };
  const auto drift = [&](const Rates& y, const Posture& at) {
    const double p = at.slope_along, q = at.slope_left;
    const double forward = y[0] / at.length() - p * q / (at.tall() * at.length()) * y[1];
    const double left = at.length() / at.tall() * y[1];
    const double c = std::cos(at.yaw), s = std::sin(at.yaw);
    return std::array{c * forward - s * left, s * forward + c * left,
                      (1 + p * p) / at.tall() * y[2]};
  };
  /// y with y = base + step rates(y).
  const auto implicit = [&](const Rates& base, double step, Rates y, const Posture& at) {
    const double scale = std::max(std::abs(y[0]), 1e-3);
    const std::array nudge{1e-5 * scale, 1e-5 * scale, 1e-5 * scale};
    std::array<Rates, 5> slopes{};
    const Rates here = rates(y, at);
    // What the transferred forces change is left to the iteration.
    for (std::size_t i = 3; i < 5; ++i) slopes[i][i] = -1 / kTransferLag_s;
    for (std::size_t k = 0; k < 3; ++k) {
      Rates there = y;
      there[k] += nudge[k];
      const Rates changed = rates(there, at);
      for (std::size_t i = 0; i < 5; ++i) slopes[i][k] = (changed[i] - here[i]) / nudge[k];
    }
    Rates now = here;
    for (int round = 0; round < 40; ++round) {
      std::array<std::array<double, 6>, 5> rows{};
      for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t k = 0; k < 5; ++k) rows[i][k] = (i == k ? 1 : 0) - step * slopes[i][k];
        rows[i][5] = base[i] + step * now[i] - y[i];
      }
      const Rates change = solved<5>(rows);
      double largest = 0;
      for (std::size_t i = 0; i < 5; ++i) {
        y[i] += change[i];
        largest = std::max(largest, std::abs(change[i]) / (i < 3 ? scale : m));
      }
      if (!(largest < 1e6)) break;
      if (largest < 1e-7) return y;
      now = rates(y, at);
    }
    balanced = false;
    return y;
  };

  const Posture start = posture_at(0, state.x_m, state.y_m, state.yaw_rad);
  const Rates y0{state.motion.vx_mps, state.motion.vy_mps, state.motion.yaw_rate_rad_s,
                 state.transfer_forward_n, state.transfer_left_n};
  const Rates f0 = rates(y0, start);
  const auto d0 = drift(y0, start);
  const double g = gamma * h;
  const Posture between =
      posture_at(g, state.x_m + g * d0[0], state.y_m + g * d0[1], state.yaw_rad + g * d0[2]);
  Rates base{};
  for (std::size_t i = 0; i < 5; ++i) base[i] = y0[i] + g / 2 * f0[i];
  const Rates y1 = implicit(base, g / 2, y0, between);
  const auto d1 = drift(y1, between);
  std::array<double, 3> pose1{state.x_m, state.y_m, state.yaw_rad};
  for (std::size_t i = 0; i < 3; ++i) pose1[i] += g / 2 * (d0[i] + d1[i]);

  const double a = 1 / (gamma * (2 - gamma)), b = (1 - gamma) * (1 - gamma) * a;
  const double rest = (1 - gamma) / (2 - gamma) * h;
  const double ahead = h - g;
  const Posture end =
      posture_at(h, pose1[0] + ahead * d1[0], pose1[1] + ahead * d1[1], pose1[2] + ahead * d1[2]);
  for (std::size_t i = 0; i < 5; ++i) base[i] = a * y1[i] - b * y0[i];
  const Rates y2 = implicit(base, rest, y1, end);
  const auto d2 = drift(y2, end);
  const std::array<double, 3> pose0{state.x_m, state.y_m, state.yaw_rad};
  std::array<double, 3> pose2{};
  for (std::size_t i = 0; i < 3; ++i) pose2[i] = a * pose1[i] - b * pose0[i] + rest * d2[i];

  StepResult result{.state = state, .strain = {}};
  result.on_known_ground = known;
  result.converged = known && balanced;
  result.state.x_m = pose2[0];
  result.state.y_m = pose2[1];
  result.state.yaw_rad = std::remainder(pose2[2], 2 * kPi);
  result.state.motion = {.vx_mps = y2[0], .vy_mps = y2[1], .yaw_rate_rad_s = y2[2]};
  result.state.transfer_forward_n = y2[3];
  result.state.transfer_left_n = y2[4];
  result.state.curvature_1pm = end.curvature;
  result.state.crab_rad = end.crab;
  result.state.rim_speed_mps = end.rim;
  result.state.rim_acceleration_mps2 = (end.rim - state.rim_speed_mps) / h;
  return result;
}

StepResult IndependentSimulator::step(const VehicleState& state, const VehicleControl& control,
                                      double duration_s) const {
  const int pieces = std::max(1, static_cast<int>(std::ceil(duration_s / longest_step_s_ - 1e-9)));
  StepResult result{.state = moved(state, 1), .strain = {}};
  for (int i = 0; i < pieces; ++i) {
    result = halved_substep(result.state, control, duration_s / pieces, 0);
    if (!result.converged) break;
  }
  result.state = moved(result.state, -1);
  return result;
}

/// From a state that no balance is near to, as at the start on a side slope, the way to it is made
/// in shorter steps.
StepResult IndependentSimulator::halved_substep(const VehicleState& state,
                                                const VehicleControl& control, double h,
                                                int halvings) const {
  constexpr int kMost = 8;
  const StepResult whole = substep(state, control, h);
  if (whole.converged || !whole.on_known_ground || halvings == kMost) return whole;
  const StepResult half = halved_substep(state, control, h / 2, halvings + 1);
  return half.converged ? halved_substep(half.state, control, h / 2, halvings + 1) : half;
}

std::vector<WheelNow> IndependentSimulator::wheels(const VehicleState& state) const {
  const GroundPatch patch = ground(state);
  const BodyMotion motion = moved(state, 1).motion;
  std::vector<WheelNow> wheels;
  forces({motion.vx_mps, motion.vy_mps, motion.yaw_rate_rad_s},
         {.soil = patch.soil,
          .slope_along = patch.slope_forward,
          .slope_left = patch.slope_left,
          .hollow = patch.curvature_1pm,
          .yaw = state.yaw_rad,
          .curvature = state.curvature_1pm,
          .crab = state.crab_rad,
          .rim = state.rim_speed_mps},
         state.transfer_forward_n, state.transfer_left_n, &wheels);
  return wheels;
}

StateMargins IndependentSimulator::margins(const VehicleState&, const GroundPatch&) const {
  throw std::logic_error("the independent simulator judges no margins");
}

bool IndependentSimulator::at_rest(const VehicleState& state) const {
  return std::abs(state.rim_speed_mps) < 1e-9 &&
         std::hypot(state.motion.vx_mps, state.motion.vy_mps) < kFadeSpeed_mps;
}

}  // namespace regoplan::drives
