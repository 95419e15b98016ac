#include "terramech/margins/trim.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "terramech/vehicle/rim_speed.h"

namespace regoplan {
namespace {

constexpr double kAngleScale = 0.2;  // radians, and share of the drive factor, of one unit

/// Newton's method is done below this share of the normal load; beyond the other it has failed.
constexpr double kConverged = 1e-7;
constexpr double kAccepted = 1e-4;

}  // namespace

SteadyManoeuvre::SteadyManoeuvre(const Vehicle& vehicle, const LoadSharing& sharing,
                                 std::span<const WheelLaw> laws, double curvature_1pm,
                                 double normal_n, bool reverse, double crab_rad)
    : vehicle_(vehicle),
      sharing_(sharing),
      laws_(laws),
      curvature_1pm_(curvature_1pm),
      normal_n_(normal_n),
      direction_(reverse ? -1 : 1),
      crab_rad_(crab_rad),
      length_m_(longest_arm_m(vehicle)) {
  rims_follow_ = vehicle.drive_law != DriveLaw::kEqualTorque &&
                 std::ranges::all_of(vehicle.wheels, [](const WheelMount& w) { return w.driven; });
  laws_have_slopes_ = std::ranges::all_of(laws, [](const WheelLaw& l) { return l.has_slopes(); });
}

SteadyManoeuvre SteadyManoeuvre::turn_on_the_spot(const Vehicle& vehicle,
                                                  const LoadSharing& sharing,
                                                  std::span<const WheelLaw> laws, double normal_n,
                                                  bool to_the_left) {
  SteadyManoeuvre turn(vehicle, sharing, laws, 0, normal_n, !to_the_left);
  turn.on_the_spot_ = true;
  return turn;
}

PathForce SteadyManoeuvre::ahead() const {
  if (on_the_spot_) return {.yaw_nm = direction_ * length_m_};
  return {.forward_n = direction_};
}

double SteadyManoeuvre::ahead_n(const PathForce& force) const {
  return direction_ * (on_the_spot_ ? force.yaw_nm / length_m_ : force.forward_n);
}

/// Slip-free, the vehicle's origin goes at 1 m/s, or the end of the longest arm turns at 1 m/s.
double SteadyManoeuvre::rim_pace() const {
  return on_the_spot_ ? direction_ / length_m_ : direction_;
}

BodyMotion SteadyManoeuvre::body_motion(const Point& at) const {
  if (on_the_spot_) {
    const double yaw_rate = rim_pace();
    return {.vx_mps = kAngleScale * at[0],
            .vy_mps = kAngleScale * at[1] - yaw_rate * vehicle_.turn_centre_x_m,
            .yaw_rate_rad_s = yaw_rate};
  }
  const double slip_angle = kAngleScale * at[0];
  return {.vx_mps = direction_ * std::cos(slip_angle),
          .vy_mps = direction_ * std::sin(slip_angle),
          .yaw_rate_rad_s = direction_ * curvature_1pm_};
}

SteeringCommand SteadyManoeuvre::steering(const Point& at) const {
  if (on_the_spot_) return {};
  return {.curvature_1pm = kAngleScale * at[1] / length_m_, .crab_rad = crab_rad_};
}

std::array<SteeredWheel, kMaxWheels> SteadyManoeuvre::wheels(const Point& at) const {
  return on_the_spot_ ? wheels_on_the_spot(vehicle_) : steered_wheels(vehicle_, steering(at));
}

double SteadyManoeuvre::rim_speed_mps(std::size_t wheel, const Point& at,
                                      const SteeredWheel& steered, double load_n,
                                      const WheelMotion& motion) const {
  const bool driven = vehicle_.wheels[wheel].driven;
  if (driven && vehicle_.drive_law != DriveLaw::kEqualTorque) {
    return rim_pace() * (1 + kAngleScale * at[2]) * steered.rim_speed_per_speed;
  }
  const double mean_load = normal_n_ / static_cast<double>(vehicle_.wheels.size());
  const double torque =
      driven ? direction_ * kAngleScale * at[2] * mean_load * vehicle_.wheel.radius_m : 0;
  constexpr double kLeast_mps = 1e-6;
  return rim_speed_at_torque(
      [&](double rim_speed_mps) {
        return laws_[wheel].forces(load_n, {motion.vx_mps, motion.vy_mps, rim_speed_mps}).torque_nm;
      },
      torque, motion.vx_mps, kLeast_mps);
}

GroundReaction SteadyManoeuvre::reaction(const Point& at, const ForceLine& line) const {
  const PathForce force = line.at(at[3]);
  if (on_the_spot_) {
    return {.normal_n = normal_n_, .forward_n = force.forward_n, .left_n = force.left_n};
  }
  const double c = std::cos(kAngleScale * at[0]), s = std::sin(kAngleScale * at[0]);
  return {.normal_n = normal_n_,
          .forward_n = c * force.forward_n - s * force.left_n,
          .left_n = s * force.forward_n + c * force.left_n};
}

std::optional<SteadyManoeuvre::Residual> SteadyManoeuvre::residual(const Point& at,
                                                                   const ForceLine& line) const {
  const BodyMotion body = body_motion(at);
  const GroundReaction ground = reaction(at, line);
  const auto steered = wheels(at);
  bool carried = true;  // and every wheel has forces
  const BodyForce sum = sum_by_side(vehicle_, BodyForce{}, [&](BodyForce& of_side, std::size_t i) {
    const WheelMount& mount = vehicle_.wheels[i];
    const double load = sharing_.load_n(i, ground);
    WheelMotion motion = wheel_motion(mount, steered[i], body, 0);
    carried = carried && load > 0 && std::isfinite(motion.vx_mps);
    if (!carried) return;
    motion.rim_speed_mps = rim_speed_mps(i, at, steered[i], load, motion);
    carried = std::isfinite(motion.rim_speed_mps);  // a step of Newton's method may end anywhere
    if (!carried) return;
    const WheelForces forces = laws_[i].forces(load, motion);
    carried = has_forces(forces.status);
    of_side.add(mount, steered[i], forces);
  });
  if (!carried) return std::nullopt;
  return Residual{(sum.forward_n - ground.forward_n) / normal_n_,
                  (sum.left_n - ground.left_n) / normal_n_,
                  (sum.yaw_nm - line.at(at[3]).yaw_nm) / (normal_n_ * length_m_)};
}

/// From the slopes of the wheels' forces, where a small change of the steering turns a wheel and
/// its rim speed.
SteadyManoeuvre::Slopes SteadyManoeuvre::slopes_by_law(const Point& at,
                                                       const ForceLine& line) const {
  const BodyMotion body = body_motion(at);
  const GroundReaction ground = reaction(at, line);
  const double angle = on_the_spot_ ? 0 : kAngleScale * at[0];
  const double c = std::cos(angle), s = std::sin(angle);
  const PathForce& along = line.per_unit;
  // By the first unknown: body slip angle, or speed forward.
  const BodyMotion body_by_first = on_the_spot_
                                       ? BodyMotion{.vx_mps = 1}
                                       : BodyMotion{.vx_mps = -body.vy_mps, .vy_mps = body.vx_mps};
  const GroundReaction ground_by_first =
      on_the_spot_ ? GroundReaction{}
                   : GroundReaction{.forward_n = -ground.left_n, .left_n = ground.forward_n};
  const GroundReaction ground_by_p{.forward_n = c * along.forward_n - s * along.left_n,
                                   .left_n = s * along.forward_n + c * along.left_n};
  constexpr double kTurn = 1e-6;
  Point more_at = at, less_at = at;
  more_at[1] += kTurn;
  less_at[1] -= kTurn;
  const auto steered = wheels(at), steered_more = wheels(more_at), steered_less = wheels(less_at);
  const double factor = rim_pace() * (1 + kAngleScale * at[2]);
  const Slopes zero = Slopes::Zero();
  Slopes slopes = sum_by_side(vehicle_, zero, [&](Slopes& of_side, std::size_t i) {
    const WheelMount& mount = vehicle_.wheels[i];
    const SteeredWheel &wheel = steered[i], &more = steered_more[i], &less = steered_less[i];
    const WheelMotion motion = wheel_motion(mount, wheel, body, factor * wheel.rim_speed_per_speed);
    const SlopedForces f = laws_[i].forces_with_slopes(sharing_.load_n(i, ground), motion);
    const auto add = [&](int k, double scale, const WheelMotion& moved, double load, double turn) {
      const auto change = [&](const SlopedForce& force) {
        return force.by_load * load + force.by_vx_nspm * moved.vx_mps +
               force.by_vy_nspm * moved.vy_mps + force.by_rim_speed_nspm * moved.rim_speed_mps;
      };
      BodyForce sum;
      sum.add(
          mount, wheel,
          {.fx_n = change(f.fx) + f.fy.value_n * turn, .fy_n = change(f.fy) - f.fx.value_n * turn});
      of_side.col(k) +=
          scale / normal_n_ * Residual{sum.forward_n, sum.left_n, sum.yaw_nm / length_m_};
    };
    add(0, kAngleScale, wheel_motion(mount, wheel, body_by_first, 0),
        sharing_.load_n(i, ground_by_first), 0);
    if (on_the_spot_) {
      add(1, kAngleScale, wheel_motion(mount, wheel, {.vy_mps = 1}, 0), 0, 0);
    }
    const double turn =
        (less.cos_steer * more.sin_steer - less.sin_steer * more.cos_steer) / (2 * kTurn);
    const double faster =
        factor * (more.rim_speed_per_speed - less.rim_speed_per_speed) / (2 * kTurn);
    add(1, 1, {motion.vy_mps * turn, -motion.vx_mps * turn, faster}, 0, turn);
    add(2, 1, {0, 0, rim_pace() * kAngleScale * wheel.rim_speed_per_speed}, 0, 0);
    add(3, 1, {}, sharing_.load_n(i, ground_by_p), 0);
  });
  slopes.col(0) -=
      kAngleScale / normal_n_ * Residual{ground_by_first.forward_n, ground_by_first.left_n, 0};
  slopes.col(3) -=
      Residual{ground_by_p.forward_n, ground_by_p.left_n, along.yaw_nm / length_m_} / normal_n_;
  return slopes;
}

std::optional<SteadyManoeuvre::Slopes> SteadyManoeuvre::slopes(
    const Point& at, const ForceLine& line, std::optional<Residual> residual_at) const {
  if (rims_follow_ && laws_have_slopes_) return slopes_by_law(at, line);
  if (!residual_at) residual_at = residual(at, line);
  if (!residual_at) return std::nullopt;
  constexpr double kStep = 1e-3;
  // Unknowns that have a side to the side that they lie on, so that mirrored manoeuvres have
  // mirrored slopes; straight on, to both.
  const double side = on_the_spot_ ? direction_
                      : at[0] != 0 ? at[0]
                      : at[1] != 0 ? at[1]
                                   : curvature_1pm_;
  Slopes slopes;
  for (int k = 0; k < 4; ++k) {
    const bool has_side = k == 1 || (k == 0 && !on_the_spot_);
    Point moved = at;
    moved[k] += has_side && side < 0 ? -kStep : kStep;
    const auto there = residual(moved, line);
    if (!there) return std::nullopt;
    slopes.col(k) = (*there - *residual_at) / (moved[k] - at[k]);
    if (has_side && side == 0) {
      moved[k] = at[k] - kStep;
      const auto other = residual(moved, line);
      if (!other) return std::nullopt;
      slopes.col(k) = (*there - *other) / (2 * kStep);
    }
  }
  return slopes;
}

std::optional<SteadyManoeuvre::Point> SteadyManoeuvre::solve(const Point& guess,
                                                             const ForceLine& line) const {
  Point at = guess;
  double error_before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 20; ++iteration) {
    const auto missing = residual(at, line);
    if (!missing) return std::nullopt;
    const double error = missing->cwiseAbs().maxCoeff();
    const bool stalls = iteration > 3 && error > error_before / 2;
    if (error < kConverged || (stalls && error < kAccepted)) return at;
    error_before = error;
    const auto slope = slopes(at, line, *missing);
    if (!slope) return std::nullopt;
    Eigen::Vector3d step = slope->leftCols<3>().partialPivLu().solve(*missing);
    const double longest = step.cwiseAbs().maxCoeff();
    constexpr double kLongestStep = 0.5;
    if (!std::isfinite(longest)) return std::nullopt;
    if (longest > kLongestStep) step *= kLongestStep / longest;
    at.head<3>() -= step;
  }
  return std::nullopt;
}

/// Along the path without slip, but for what the drive has beyond free rolling.
SteadyManoeuvre::Point SteadyManoeuvre::rolling(double drive) const {
  if (on_the_spot_) return {0, 0, drive / kAngleScale, 0};
  const double slip_angle = kinematic_body_slip_angle_rad(vehicle_, curvature_1pm_) + crab_rad_;
  return {slip_angle / kAngleScale, curvature_1pm_ * length_m_ / kAngleScale, drive / kAngleScale,
          0};
}

double SteadyManoeuvre::rolling_sinkage_m(const ForceLine& line) const {
  const Point at = rolling();
  const GroundReaction ground = reaction(at, line);
  const BodyMotion body = body_motion(at);
  const auto steered = wheels(at);
  double deepest_m = 0;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const double load_n = sharing_.load_n(i, ground);
    if (!(load_n > 0)) continue;
    WheelMotion motion = wheel_motion(vehicle_.wheels[i], steered[i], body, 0);
    motion.rim_speed_mps = rim_pace() * steered[i].rim_speed_per_speed;
    const WheelForces forces = laws_[i].forces(load_n, motion);
    const bool sunk = forces.status == WheelStatus::kSinksToAxle;
    deepest_m = std::max(deepest_m, sunk ? vehicle_.wheel.radius_m : forces.sinkage_m);
  }
  return deepest_m;
}

std::optional<SteadyManoeuvre::Point> SteadyManoeuvre::solve_from_rolling(
    const ForceLine& line) const {
  // Outward from free rolling on either side, the first sign change of the missing drive: of the
  // forward force, or of the moment that turns on the spot.
  constexpr std::array<double, 12> kDriving{1.0, 1.03, 1.07, 1.12, 1.2,  1.3,
                                            1.4, 1.55, 1.75, 2.0,  2.35, 2.8};
  // Over the mean load and the wheel's radius.
  constexpr std::array<double, 12> kTorque{0,    0.03, 0.07, 0.12, 0.18, 0.25,
                                           0.33, 0.42, 0.52, 0.63, 0.75, 0.9};
  const bool by_torque = vehicle_.drive_law == DriveLaw::kEqualTorque;
  const auto point_at = [&](double drive) { return rolling(by_torque ? drive : drive - 1); };
  const auto drive_at = [&](std::size_t i, bool brakes) {
    if (by_torque) return brakes ? -kTorque[i] : kTorque[i];
    return brakes ? 1 / kDriving[i] : kDriving[i];
  };
  const auto at_rolling = residual(point_at(drive_at(0, false)), line);
  if (!at_rolling) return std::nullopt;
  const int driven = on_the_spot_ ? 2 : 0;
  const bool must_brake = direction_ * (*at_rolling)[driven] > 0;
  double before = (*at_rolling)[driven];
  for (std::size_t i = 1; i < kDriving.size(); ++i) {
    const double drive = drive_at(i, must_brake), drive_before = drive_at(i - 1, must_brake);
    const auto missing = residual(point_at(drive), line);
    if (!missing) return std::nullopt;
    if (before * (*missing)[driven] <= 0) {
      const double share = before / (before - (*missing)[driven]);
      return solve(point_at(drive_before + share * (drive - drive_before)), line);
    }
    before = (*missing)[driven];
  }
  return std::nullopt;
}

Trim SteadyManoeuvre::trim(const Point& at, const ForceLine& line) const {
  const BodyMotion body = body_motion(at);
  const GroundReaction ground = reaction(at, line);
  const auto steered = wheels(at);
  Trim trim{.force = line.at(at[3]),
            .body_slip_angle_rad = on_the_spot_ ? 0 : kAngleScale * at[0],
            .steer_curvature_1pm = steering(at).curvature_1pm,
            .wheels = {}};
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const double load = sharing_.load_n(i, ground);
    WheelMotion motion = wheel_motion(vehicle_.wheels[i], steered[i], body, 0);
    motion.rim_speed_mps = rim_speed_mps(i, at, steered[i], load, motion);
    trim.wheels.push_back({.load_n = load,
                           .steer_rad = steered[i].steer_rad(),
                           .slip = slip_ratio(motion),
                           .slip_angle_rad = slip_angle_rad(motion),
                           .motion = motion,
                           .forces = laws_[i].forces(load, motion)});
  }
  double driven = 0;
  const double factors = sum_by_side(vehicle_, 0.0, [&](double& sum, std::size_t i) {
    if (!vehicle_.wheels[i].driven) return;
    sum += trim.wheels[i].motion.rim_speed_mps / (rim_pace() * steered[i].rim_speed_per_speed);
    ++driven;
  });
  trim.drive_factor = factors / driven;
  return trim;
}

}  // namespace regoplan
