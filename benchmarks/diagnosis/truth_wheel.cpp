#include "benchmarks/diagnosis/truth_wheel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regoplan::challenge {
namespace {

constexpr int kNodes = 40;   // on either side of the largest stress
constexpr int kStrips = 11;  // where the rut is not level

/// Forces that do not and that do scale with the normal stress.
struct Sums {
  double fx_c = 0, fz_c = 0, torque_c = 0, fu_c = 0;
  double fx_s = 0, fz_s = 0, torque_s = 0, fu_s = 0;
  double flank_n = 0;  // bulldozing on the side, mobilised
};

/// Velocities over the rim's.
struct Kinematics {
  double forward = 1, sideways = 0;
};

Kinematics kinematics(double slip, double beta_rad) {
  const double forward = slip >= 0 ? 1 - slip : 1 / (1 + slip);
  return {forward, forward * std::tan(std::abs(beta_rad))};
}

double profile_at(RutProfile profile, double e) {
  switch (profile) {
    case RutProfile::kCubic:
      return 8 * e * e * e;
    case RutProfile::kParabolic:
      return 1.5 * ((e + 0.5) * (e + 0.5) - 1.0 / 3);
    case RutProfile::kStep:
      return std::tanh(6 * e);
  }
  return 0;
}

double pressure_pa(const TruthPhysics& p, double depth_m) {
  const double k = p.stiffness * (p.soil.kc / p.wheel.width_m + p.soil.kphi), n = p.soil.n;
  const double shallow = std::pow(std::min(depth_m, p.break_depth_m), n);
  double pressure = k * (shallow + p.deep_ratio * (std::pow(depth_m, n) - shallow));
  if (p.deep_ratio == 1) pressure = k * std::pow(depth_m, n);
  if (p.crust != 0) {
    pressure +=
        p.crust * k * std::pow(p.crust_depth_m, n) * -std::expm1(-depth_m / p.crust_depth_m);
  }
  return pressure;
}

/// Bekker 1956, soil that breaks: a peak of 1 near j = k, nothing left far beyond.
double brittle_share(double j_over_k) {
  constexpr double kK2 = 1.1;
  const double root = std::sqrt(kK2 * kK2 - 1), slow = kK2 - root, fast = kK2 + root;
  const auto bare = [&](double u) { return std::exp(-slow * u) - std::exp(-fast * u); };
  return bare(j_over_k) / bare(std::log(fast / slow) / (fast - slow));
}

struct Shares {
  double x, y;
};

Shares shear_shares(const TruthPhysics& p, double jx_m, double jy_m, double kx_m, double ky_m) {
  const auto law = [&](double j, double k) {
    const double softened = 1 - p.softening * -std::expm1(-std::pow(j / p.softening_m, 3));
    const double lasting = -std::expm1(-j / k) * (1 + p.sech_peak / std::cosh(j / k)) * softened;
    return p.brittle == 0 ? lasting : (1 - p.brittle) * lasting + p.brittle * brittle_share(j / k);
  };
  const double ex = law(std::abs(jx_m), kx_m), ey = law(jy_m, ky_m);
  double share = 1;
  if (p.circle != 0) share *= 1 - p.circle * (1 - 1 / std::max(1.0, std::hypot(ex, ey)));
  if (p.product != 0) share *= 1 - p.product * (1 - 1 / std::sqrt(1 + ex * ex * ey * ey));
  return {std::copysign(share * ex, jx_m), share * ey};
}

/// Adds one strip of the given share of the width. Depths below the level ground ahead.
Sums strip(const TruthPhysics& p, const Kinematics& v, double slip, double depth_m, double share) {
  const double r = p.wheel.radius_m, beta = std::abs(p.at.slip_angle_rad);
  const double theta_f = std::acos(1 - depth_m / r);
  const double theta_r = -std::acos(std::max(-1.0, 1 - p.soil.lambda * depth_m / r));
  const double theta_m = (p.soil.a0 + p.soil.a1 * slip) * theta_f;
  const double kx = p.soil.kx0_m + p.soil.kx1_m * beta, ky = p.soil.ky0_m + p.soil.ky1_m * beta;
  const double shear_r = r + p.lug_m;
  const double cohesion = p.limit * p.soil.cohesion_pa;
  const double tan_phi = p.limit * std::tan(p.soil.friction_angle_rad);
  const double phi = std::atan(tan_phi);
  const double xc = std::numbers::pi / 4 - phi / 2;
  const double cot_xc = 1 / std::tan(xc);
  const double d1 = cot_xc + std::tan(xc + phi), d2 = cot_xc + cot_xc * cot_xc * tan_phi;
  Sums sum;
  double flank = 0;
  const auto add = [&](double theta, double mirrored, double arc) {
    const double from_front = theta_f - theta;
    const double jx = shear_r * (from_front - v.forward * (std::sin(theta_f) - std::sin(theta)));
    const double jy = shear_r * v.sideways * from_front;
    double sigma = pressure_pa(p, std::max(0.0, r * (std::cos(mirrored) - std::cos(theta_f))));
    sigma *= 1 - p.excavated_x * -std::expm1(-std::abs(jx) / p.excavation_m);
    sigma *= 1 - p.excavated_y * -std::expm1(-jy / p.excavation_m);
    const Shares e = shear_shares(p, jx, jy, kx, ky);
    const double area = r * p.wheel.width_m * share * arc;
    const double s = std::sin(theta), c = std::cos(theta);
    const double cohesive = area * cohesion, frictional = area * sigma * tan_phi;
    sum.fx_c += cohesive * e.x * c;
    sum.fz_c += cohesive * e.x * s;
    sum.torque_c += cohesive * e.x * shear_r;
    sum.fu_c += cohesive * e.y;
    sum.fx_s += frictional * e.x * c - area * sigma * s;
    sum.fz_s += frictional * e.x * s + area * sigma * c;
    sum.torque_s += frictional * e.x * shear_r;
    sum.fu_s += frictional * e.y;
    const double h = std::max(0.0, r * (std::cos(theta) - std::cos(theta_f)));
    const double heaped = h + p.berm_m * h / depth_m;
    const double rb =
        d1 * (cohesion * heaped + d2 * p.soil.density_kgpm3 * p.gravity_mps2 * heaped * heaped / 2);
    flank += rb * (r - h * c) * arc;
  };
  const double front = theta_f - theta_m, rear = theta_m - theta_r;
  for (int i = 0; i < kNodes; ++i) {
    // Sidi's sine transformation: what is summed vanishes at both ends with its slope, for which
    // the midpoint rule is as good as any
    const double x = (i + 0.5) / kNodes, turn = 2 * std::numbers::pi * x;
    const double t = x - std::sin(turn) / (2 * std::numbers::pi);
    const double weight = (1 - std::cos(turn)) / kNodes;
    const double ahead = theta_m + t * front;
    add(ahead, ahead, weight * front);
    if (rear > 0) add(theta_r + t * rear, theta_f - t * front, weight * rear);
  }
  const double mobilised = -std::expm1(-shear_r * v.sideways * (theta_f - theta_r) / ky);
  sum.flank_n = share * mobilised * flank;
  return sum;
}

Sums integrate(const TruthPhysics& p, const Kinematics& v, double slip, double sinkage_m) {
  if (p.rut == 0) return strip(p, v, slip, sinkage_m, 1);
  Sums total;
  const double r = p.wheel.radius_m;
  for (int i = 0; i < kStrips; ++i) {
    const double e = (i + 0.5) / kStrips - 0.5;
    const double depth =
        std::clamp(sinkage_m * (1 + p.rut * profile_at(p.profile, e)), 1e-6 * r, r);
    const Sums s = strip(p, v, slip, depth, 1.0 / kStrips);
    total.fx_c += s.fx_c;
    total.fz_c += s.fz_c;
    total.torque_c += s.torque_c;
    total.fu_c += s.fu_c;
    total.fx_s += s.fx_s;
    total.fz_s += s.fz_s;
    total.torque_s += s.torque_s;
    total.fu_s += s.fu_s;
    total.flank_n += s.flank_n;
  }
  if (p.inner_flank) {
    const double edge = std::min(sinkage_m * (1 + p.rut * profile_at(p.profile, 0.5)), r);
    total.flank_n = strip(p, v, slip, edge, 1).flank_n;
  }
  return total;
}

/// The smallest sinkage at which the soil carries the load.
std::optional<double> carrying_sinkage(const TruthPhysics& p, const Kinematics& v, double slip) {
  const double r = p.wheel.radius_m;
  const auto missing_n = [&](double h) {
    const Sums sum = integrate(p, v, slip, h);
    return sum.fz_c + sum.fz_s - p.at.load_n;
  };
  double low = 0, high = 1e-4 * r, at_low = -p.at.load_n, at_high = missing_n(high);
  while (at_high < 0) {
    low = high;
    at_low = at_high;
    if (low == r) return std::nullopt;
    high = std::min(1.5 * high, r);
    at_high = missing_n(high);
  }
  // false position that halves the end which stays (Illinois)
  for (int i = 0; i < 100 && high - low > 1e-10 * r; ++i) {
    const double middle = (low * at_high - high * at_low) / (at_high - at_low);
    const double there = missing_n(middle);
    if (std::abs(there) < 1e-9 * p.at.load_n) return middle;
    if (there < 0) {
      low = middle;
      at_low = there;
      at_high /= 2;
    } else {
      high = middle;
      at_high = there;
      at_low /= 2;
    }
  }
  return (low + high) / 2;
}

/// Torque of the soil on both flanks: shear strength over the sunk segment, the soil's own weight
/// pressing at rest, summed over depth.
double flank_torque_nm(const TruthPhysics& p, double sinkage_m) {
  const double r = p.wheel.radius_m;
  const double at_rest = 1 - std::sin(p.soil.friction_angle_rad);
  double torque = 0;
  constexpr int kLayers = 30;
  const double step = sinkage_m / kLayers;
  for (int i = 0; i < kLayers; ++i) {
    const double below = (i + 0.5) * step;   // under the ground's level
    const double z = r - sinkage_m + below;  // under the axle
    const double half = std::sqrt(std::max(0.0, r * r - z * z));
    const double stress = p.soil.cohesion_pa + at_rest * p.soil.density_kgpm3 * p.gravity_mps2 *
                                                   below * std::tan(p.soil.friction_angle_rad);
    torque += 2 * 2 * half * step * stress * std::hypot(z, half / 2);
  }
  return p.flank * torque;
}

}  // namespace

std::optional<TruthChannels> truth_channels(const TruthPhysics& p) {
  const double slip = p.at.slip_ratio, r = p.wheel.radius_m;
  const Kinematics v = kinematics(slip, p.at.slip_angle_rad);
  const bool at_rest = p.variant == WheelVariant::kYoshida2004;
  const auto h0 = at_rest ? carrying_sinkage(p, {}, 0) : carrying_sinkage(p, v, slip);
  if (!h0) return std::nullopt;
  double h = *h0;
  if (at_rest) h += p.soil.c0_m * std::max(slip, 0.0);
  h = h * p.sinkage_factor + p.sinkage_added_m;
  if (!(h > 0 && h < 0.95 * r)) return std::nullopt;
  const Sums sum = integrate(p, v, slip, h);
  double q = 1;
  if (h != *h0 || at_rest) q = (p.at.load_n - sum.fz_c) / sum.fz_s;
  if (!(q > 0)) return std::nullopt;
  const double side = p.at.slip_angle_rad > 0 ? 1 : (p.at.slip_angle_rad < 0 ? -1 : 0);
  const double inner = h * (1 + p.rut * profile_at(p.profile, 0.5));
  const double outer = std::max(0.0, h * (1 + p.rut * profile_at(p.profile, -0.5)));
  const double shown = p.added_sinkage_m;
  return TruthChannels{.fx_n = sum.fx_c + q * sum.fx_s + p.added_fx_n,
                       .fy_n = side * (sum.fu_c + q * sum.fu_s + sum.flank_n) + p.added_fy_n,
                       .torque_nm = sum.torque_c + q * sum.torque_s + p.added_torque_nm +
                                    (p.flank == 0 ? 0 : flank_torque_nm(p, h)),
                       .sinkage_m = h + shown,
                       .rut_left_m = (side >= 0 ? outer : inner) + shown,
                       .rut_right_m = (side >= 0 ? inner : outer) + shown};
}

}  // namespace regoplan::challenge
