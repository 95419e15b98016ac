#include "terramech/trim.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace regoplan {
namespace {

constexpr double kAngleScale = 0.2;  // radians, and share of the drive factor, of one unit

/// Newton's method is done below this share of the normal load; beyond the other it has failed.
constexpr double kConverged = 1e-7;
constexpr double kAccepted = 1e-4;

double longest_arm_m(const Vehicle& vehicle) {
  double longest = 0;
  for (const WheelMount& mount : vehicle.wheels) {
    longest = std::max(longest, std::hypot(mount.x_m, mount.y_m));
  }
  return longest;
}

}  // namespace

SteadyManoeuvre::SteadyManoeuvre(const Vehicle& vehicle, const LoadSharing& sharing,
                                 std::span<const WheelLaw> laws, double curvature_1pm,
                                 double normal_n, bool reverse)
    : vehicle_(vehicle),
      sharing_(sharing),
      laws_(laws),
      curvature_1pm_(curvature_1pm),
      normal_n_(normal_n),
      direction_(reverse ? -1 : 1),
      length_m_(longest_arm_m(vehicle)) {}

BodyMotion SteadyManoeuvre::body_motion(const Point& at) const {
  const double slip_angle = kAngleScale * at[0];
  return {.vx_mps = direction_ * std::cos(slip_angle),
          .vy_mps = direction_ * std::sin(slip_angle),
          .yaw_rate_rad_s = direction_ * curvature_1pm_};
}

double SteadyManoeuvre::steer_curvature_1pm(const Point& at) const {
  return kAngleScale * at[1] / length_m_;
}

double SteadyManoeuvre::drive_factor(const Point& at) const {
  return 1 + kAngleScale * at[2];
}

GroundReaction SteadyManoeuvre::reaction(const Point& at, const ForceLine& line) const {
  const PathForce force = line.at(at[3]);
  const double c = std::cos(kAngleScale * at[0]), s = std::sin(kAngleScale * at[0]);
  return {.normal_n = normal_n_,
          .forward_n = c * force.forward_n - s * force.left_n,
          .left_n = s * force.forward_n + c * force.left_n};
}

std::optional<SteadyManoeuvre::Residual> SteadyManoeuvre::residual(const Point& at,
                                                                   const ForceLine& line) const {
  const BodyMotion body = body_motion(at);
  const GroundReaction ground = reaction(at, line);
  const double steer_curvature = steer_curvature_1pm(at);
  const double rim_speed = direction_ * drive_factor(at);
  BodyForce sum;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const WheelMount& mount = vehicle_.wheels[i];
    const double load = sharing_.load_n(i, ground);
    if (!(load > 0)) return std::nullopt;
    const SteeredWheel wheel = steered_wheel(vehicle_, mount, {.curvature_1pm = steer_curvature});
    const WheelMotion motion =
        wheel_motion(mount, wheel, body, rim_speed * wheel.rim_speed_per_speed);
    const WheelForces forces = laws_[i].forces(load, motion);
    if (!has_forces(forces.status)) return std::nullopt;
    sum.add(mount, wheel, forces);
  }
  return Residual{(sum.forward_n - ground.forward_n) / normal_n_,
                  (sum.left_n - ground.left_n) / normal_n_, sum.yaw_nm / (normal_n_ * length_m_)};
}

std::optional<SteadyManoeuvre::Slopes> SteadyManoeuvre::slopes(const Point& at,
                                                               const ForceLine& line,
                                                               const Residual& residual_at) const {
  constexpr double kStep = 1e-3;
  Slopes slopes;
  for (int k = 0; k < 4; ++k) {
    Point moved = at;
    moved[k] += kStep;
    const auto there = residual(moved, line);
    if (!there) return std::nullopt;
    slopes.col(k) = (*there - residual_at) / kStep;
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

std::optional<SteadyManoeuvre::Point> SteadyManoeuvre::solve_from_rolling(
    const ForceLine& line) const {
  // Outward from free rolling on either side, the first sign change of the missing forward force.
  constexpr std::array<double, 12> kDriving{1.0, 1.03, 1.07, 1.12, 1.2,  1.3,
                                            1.4, 1.55, 1.75, 2.0,  2.35, 2.8};
  const double slip_angle = kinematic_body_slip_angle_rad(vehicle_, curvature_1pm_);
  const auto point_at = [&](double factor) {
    return Point{slip_angle / kAngleScale, curvature_1pm_ * length_m_ / kAngleScale,
                 (factor - 1) / kAngleScale, 0};
  };
  const auto rolling = residual(point_at(1), line);
  if (!rolling) return std::nullopt;
  const bool must_brake = direction_ * (*rolling)[0] > 0;
  double before = (*rolling)[0];
  for (std::size_t i = 1; i < kDriving.size(); ++i) {
    const double factor = must_brake ? 1 / kDriving[i] : kDriving[i];
    const double factor_before = must_brake ? 1 / kDriving[i - 1] : kDriving[i - 1];
    const auto missing = residual(point_at(factor), line);
    if (!missing) return std::nullopt;
    if (before * (*missing)[0] <= 0) {
      const double share = before / (before - (*missing)[0]);
      return solve(point_at(factor_before + share * (factor - factor_before)), line);
    }
    before = (*missing)[0];
  }
  return std::nullopt;
}

Trim SteadyManoeuvre::trim(const Point& at, const ForceLine& line) const {
  const BodyMotion body = body_motion(at);
  const GroundReaction ground = reaction(at, line);
  Trim trim{.force = line.at(at[3]),
            .body_slip_angle_rad = kAngleScale * at[0],
            .steer_curvature_1pm = steer_curvature_1pm(at),
            .drive_factor = drive_factor(at),
            .wheels = {}};
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const WheelMount& mount = vehicle_.wheels[i];
    const SteeredWheel wheel =
        steered_wheel(vehicle_, mount, {.curvature_1pm = trim.steer_curvature_1pm});
    const WheelMotion motion = wheel_motion(
        mount, wheel, body, direction_ * trim.drive_factor * wheel.rim_speed_per_speed);
    const double load = sharing_.load_n(i, ground);
    trim.wheels.push_back({.load_n = load,
                           .steer_rad = wheel.steer_rad(),
                           .slip = slip_ratio(motion),
                           .slip_angle_rad = slip_angle_rad(motion),
                           .forces = laws_[i].forces(load, motion)});
  }
  return trim;
}

}  // namespace regoplan
