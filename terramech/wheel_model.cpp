#include "terramech/wheel_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "terramech/input_error.h"

namespace regoplan {
namespace {

using wheel_contact::Angles;
using wheel_contact::Ground;
using wheel_contact::Integrals;
using wheel_contact::Ratios;

constexpr double kQuarterTurn = std::numbers::pi / 2;  // theta_f where the axle is at the surface
constexpr double kMobilised = 1e12;                    // a displacement ratio that shears fully

/// A motion told as ratios of a wheel that goes forward, and what turns the forces back.
struct ForwardMotion {
  Ratios ratios;
  double x_sign = 1;  ///< -1: evaluated mirrored, Fx and T change sign
  double y_sign = 0;
  WheelStatus status = WheelStatus::kOk;
};

ForwardMotion forward_motion(const WheelMotion& motion) {
  ForwardMotion forward;
  double w = motion.rim_speed_mps;
  double vx = motion.vx_mps;
  const double vy = std::abs(motion.vy_mps);
  if (w == 0 && vx == 0 && vy == 0) {
    forward.ratios = {.rim = 0, .axle = 0};
    forward.status = WheelStatus::kStandstill;
    return forward;
  }
  if (w * vx < 0) {
    w = 0;
    forward.status = WheelStatus::kCounterRotating;
  }
  if (w < 0 || (w == 0 && vx < 0)) {
    w = -w;
    vx = -vx;
    forward.x_sign = -1;
  }
  forward.y_sign = motion.vy_mps > 0 ? 1 : motion.vy_mps < 0 ? -1 : 0;
  Ratios& ratios = forward.ratios;
  ratios.beta_abs_rad = std::atan2(vy, vx);
  if (w == 0) {
    ratios.rim = 0;
    ratios.axle = vx > 0 ? kMobilised : 0;
    ratios.lateral = vy > 0 ? kMobilised : 0;
    ratios.slip = vx > 0 ? -1 : 0;
  } else {
    ratios.axle = std::min(vx / w, kMobilised);
    ratios.lateral = std::min(vy / w, kMobilised);
    ratios.slip = ratios.axle <= 1 ? 1 - ratios.axle : 1 / ratios.axle - 1;
  }
  constexpr double kTrustedAngle = std::numbers::pi / 3;
  constexpr double kRounding = 1e-9;
  if (forward.status == WheelStatus::kOk &&
      (ratios.slip < -0.9 - kRounding || ratios.slip > 0.95 + kRounding ||
       ratios.beta_abs_rad > kTrustedAngle + kRounding)) {
    forward.status = WheelStatus::kUntrusted;
  }
  return forward;
}

/// Entry angle whose contact carries the load with Q = 1, and the integrals there.
struct Equilibrium {
  Angles angles;
  Integrals integrals;
};

class SinkageSolver {
 public:
  SinkageSolver(const Ground& ground, const Ratios& ratios, double load_n, WheelAccuracy accuracy)
      : ground_(ground), ratios_(ratios), load_n_(load_n), accuracy_(accuracy) {}

  /// Secant in (ln theta_f, ln Fz), where Fz is nearly a power; the sure search where that fails.
  std::optional<Equilibrium> solve() const {
    const double tolerance = accuracy_ == WheelAccuracy::kFast ? 3e-5 : 1e-8;
    double slope = 2 * ground_.soil.n + 1;
    double x = first_guess();
    double x_before = 0, y_before = 0;
    for (int iteration = 0; iteration < 12; ++iteration) {
      const double theta_f = std::exp(x);
      if (!(theta_f < kQuarterTurn)) break;
      const Equilibrium at = evaluate(theta_f);
      const double fz = at.integrals.fz_n(1);
      if (!(fz > 0)) break;
      const double y = std::log(fz / load_n_);
      if (iteration > 0 && x != x_before) {
        slope = (y - y_before) / (x - x_before);
        if (!(slope > 0.2)) break;  // not on a rising branch
      }
      if (std::abs(y) < tolerance) return at;
      x_before = x;
      y_before = y;
      x -= std::clamp(y / slope, -1.5, 1.5);
    }
    return search();
  }

 private:
  Equilibrium evaluate(double theta_f) const {
    const Angles angles = angles_at(ground_, theta_f, ratios_.slip);
    return {angles, integrate(ground_, angles, ratios_, accuracy_)};
  }

  double excess_n(double theta_f) const { return evaluate(theta_f).integrals.fz_n(1) - load_n_; }

  /// Of a parabola of constant mean stress: Fz ~ r b K (theta_f^2/2)^n theta_f.
  double first_guess() const {
    const double n = ground_.soil.n;
    const double full = ground_.wheel.radius_m * ground_.wheel.width_m * ground_.stress_scale_pa *
                        std::pow(0.5, n) * (1 + std::sqrt(ground_.soil.lambda)) * 0.6;
    return std::min(std::log(load_n_ / full) / (2 * n + 1), std::log(0.9 * kQuarterTurn));
  }

  /// The smallest root at which Fz rises through the load: steps outward from almost no contact,
  /// finest where it is shallow, then halves the interval. Nothing where no h < r carries it.
  std::optional<Equilibrium> search() const {
    constexpr int kSteps = 200;
    constexpr double kShallowest = 1e-6;
    double low = kShallowest;
    for (int i = 1; i <= kSteps; ++i) {
      const double high =
          kShallowest * std::pow(kQuarterTurn / kShallowest, static_cast<double>(i) / kSteps);
      if (excess_n(high) >= 0) return bisect(low, high);
      low = high;
    }
    return std::nullopt;
  }

  Equilibrium bisect(double low, double high) const {
    for (int i = 0; i < 60 && high - low > 1e-14 * high; ++i) {
      const double middle = (low + high) / 2;
      (excess_n(middle) < 0 ? low : high) = middle;
    }
    return evaluate(high);
  }

  const Ground& ground_;
  const Ratios& ratios_;
  double load_n_;
  WheelAccuracy accuracy_;
};

WheelForces forces_at(const Ground& ground, const Angles& angles, const Integrals& integrals,
                      double stress_scale_q, const ForwardMotion& forward, WheelAccuracy accuracy) {
  return {.fx_n = forward.x_sign * integrals.fx_n(stress_scale_q),
          .fy_n = forward.y_sign *
                  side_force_n(ground, angles, forward.ratios, stress_scale_q, accuracy),
          .torque_nm = forward.x_sign * integrals.torque_nm(stress_scale_q),
          .sinkage_m = ground.wheel.radius_m * 2 * std::pow(std::sin(angles.theta_f_rad / 2), 2),
          .theta_f_rad = angles.theta_f_rad,
          .theta_r_rad = angles.theta_r_rad,
          .status = forward.status};
}

/// ishigami2007: the sinkage carries the load with Q = 1.
WheelForces solve_sinkage(const Ground& ground, double load_n, const ForwardMotion& forward,
                          WheelAccuracy accuracy) {
  const auto equilibrium = SinkageSolver(ground, forward.ratios, load_n, accuracy).solve();
  if (!equilibrium) return {.status = WheelStatus::kSinksToAxle};
  return forces_at(ground, equilibrium->angles, equilibrium->integrals, 1, forward, accuracy);
}

/// yoshida2004: h = h0 + c0 max(s, 0), and the stress is scaled until it carries the load.
WheelForces scale_stress(const Ground& ground, double load_n, const ForwardMotion& forward,
                         WheelAccuracy accuracy) {
  const Ratios free_rolling;
  const auto at_zero_slip = SinkageSolver(ground, free_rolling, load_n, accuracy).solve();
  if (!at_zero_slip) return {.status = WheelStatus::kSinksToAxle};
  const double r = ground.wheel.radius_m;
  const double h0 = r * 2 * std::pow(std::sin(at_zero_slip->angles.theta_f_rad / 2), 2);
  const double h = h0 + ground.soil.c0_m * std::max(forward.ratios.slip, 0.0);
  if (!(h < r)) return {.status = WheelStatus::kSinksToAxle};
  const Angles angles =
      angles_at(ground, 2 * std::asin(std::sqrt(h / (2 * r))), forward.ratios.slip);
  const Integrals integrals = integrate(ground, angles, forward.ratios, accuracy);
  const double q = (load_n - integrals.fz_cohesion_n) / integrals.fz_stress_n;
  if (!(q >= 0 && std::isfinite(q))) return {.status = WheelStatus::kCohesionCarriesLoad};
  return forces_at(ground, angles, integrals, q, forward, accuracy);
}

}  // namespace

std::string_view name(WheelStatus status) {
  switch (status) {
    case WheelStatus::kOk:
      return "ok";
    case WheelStatus::kUntrusted:
      return "untrusted";
    case WheelStatus::kStandstill:
      return "standstill";
    case WheelStatus::kCounterRotating:
      return "counter_rotating";
    case WheelStatus::kSinksToAxle:
      return "sinks_to_axle";
    case WheelStatus::kCohesionCarriesLoad:
      return "cohesion_carries_load";
    case WheelStatus::kOutsideCorrection:
      return "outside_correction";
  }
  return "";
}

WheelMotion motion_at(double slip_ratio, double slip_angle_rad) {
  if (!(std::abs(slip_ratio) <= 1)) throw ValueError("slip_ratio", slip_ratio, "-1 to 1");
  if (!(std::abs(slip_angle_rad) <= kQuarterTurn * (1 + 1e-15))) {
    throw ValueError("slip_angle_deg", slip_angle_rad * 180 / std::numbers::pi, "-90 to 90");
  }
  // At slip ratio 1 the axle stands still, yet the slip angle counts (kx, ky): the limit of an axle
  // that hardly moves.
  constexpr double kHardlyMoving_mps = 1e-200;
  const double vx = slip_ratio >= 0 ? std::max(1 - slip_ratio, kHardlyMoving_mps) : 1;
  const double rim = slip_ratio >= 0 ? 1 : 1 + slip_ratio;
  // At 90 deg tan is 1.6e16: the shear along y is fully mobilised, as in the limit.
  return {.vx_mps = vx, .vy_mps = vx * std::tan(slip_angle_rad), .rim_speed_mps = rim};
}

double slip_ratio(const WheelMotion& motion) {
  const ForwardMotion forward = forward_motion(motion);
  return forward.status == WheelStatus::kCounterRotating ? -1 : forward.ratios.slip;
}

double slip_angle_rad(const WheelMotion& motion) {
  return std::atan2(motion.vy_mps, std::abs(motion.vx_mps));
}

WheelModel::WheelModel(const WheelModelSpec& spec, WheelAccuracy accuracy)
    : spec_(spec), accuracy_(accuracy), ground_(spec.wheel, spec.soil, spec.gravity_mps2) {
  validate(spec.wheel);
  validate(spec.soil);
  if (!(spec.gravity_mps2 > 0 && spec.gravity_mps2 <= 100)) {
    throw ValueError("gravity_mps2", spec.gravity_mps2, "above 0 to 100");
  }
  if (!(ground_.stress_scale_pa > 0)) {
    throw ValueError("kc", spec.soil.kc,
                     fmt::format("kc/width_m + kphi above 0, with kphi {}", spec.soil.kphi));
  }
}

WheelForces WheelModel::forces(double load_n, const WheelMotion& motion) const {
  if (!(load_n > 0 && std::isfinite(load_n))) throw ValueError("load_n", load_n, "above 0");
  for (const auto& [field, value] :
       {std::pair{"vx_mps", motion.vx_mps}, std::pair{"vy_mps", motion.vy_mps},
        std::pair{"rim_speed_mps", motion.rim_speed_mps}}) {
    if (!std::isfinite(value)) throw ValueError(field, value, "a finite number");
  }
  const ForwardMotion forward = forward_motion(motion);
  return spec_.variant == WheelVariant::kIshigami2007
             ? solve_sinkage(ground_, load_n, forward, accuracy_)
             : scale_stress(ground_, load_n, forward, accuracy_);
}

}  // namespace regoplan
