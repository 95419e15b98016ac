// The stress integrals of Yoshida & Ishigami (2004), "Steering Characteristics of a Rigid Wheel for
// Exploration on Loose Soil". Where the paper's print misleads, the text used is named:
//   (3)      printed from theta_f to theta_r; used from theta_r to theta_f (sign)
//   (4)      "for theta_m < theta < theta_r" printed; theta_m < theta < theta_f used (typing slip)
//   (8)(11)  1 - s printed for every s; the velocity ratio q_v used, which is 1 - s only in driving
//   (13)(16) rho printed as a weight; rho g used (dimensions)
//   (17)     c missing before h(theta); c h used, as in (16) (dimensions)
//   (16)(17) Fs printed independent of beta; the mobilisation factor M added, so that Fy vanishes
//            at beta = 0 and at s = 1, as the paper itself states
//   (14)     h enters only Fs in print; here it also sets theta_f, without which Fy has no peak
//            near s = 0.3 (Fig. 6)
#include "terramech/wheel_contact.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "terramech/vector_math.h"

// One build serves every x86-64: the integrals are compiled for the plain instruction set, for AVX2
// and for AVX-512, and chosen when the program is loaded.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define REGOPLAN_VECTOR_CLONES \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define REGOPLAN_VECTOR_CLONES
#endif

namespace regoplan::wheel_contact {
namespace {

/// Nodes t in (0, 1), graded by theta = theta_f - (theta_f - theta_m) t^2 towards the entry and
/// likewise towards the exit, where stress and shear have their corners. Holds t^2 and 2 t w.
template <int kNodes>
struct GradedNodes {
  alignas(64) std::array<double, kNodes> t2;
  alignas(64) std::array<double, kNodes> weight;

  GradedNodes() {
    using Gauss = boost::math::quadrature::gauss<double, kNodes>;
    for (std::size_t i = 0; i < kNodes / 2; ++i) {
      const double x = Gauss::abscissa()[i];
      const double w = Gauss::weights()[i] / 2;
      const std::size_t low = kNodes / 2 - 1 - i;
      const std::size_t high = kNodes / 2 + i;
      const double t_low = (1 - x) / 2;
      const double t_high = (1 + x) / 2;
      t2[low] = t_low * t_low;
      t2[high] = t_high * t_high;
      weight[low] = 2 * t_low * w;
      weight[high] = 2 * t_high * w;
    }
  }
};

template <int kNodes>
const GradedNodes<kNodes>& graded_nodes() {
  static const GradedNodes<kNodes> nodes;
  return nodes;
}

/// Angle, its sine and cosine and the displacement geometry at the nodes of one side.
template <int kNodes>
struct Side {
  alignas(64) std::array<double, kNodes> sin_theta;
  alignas(64) std::array<double, kNodes> cos_theta;
  alignas(64) std::array<double, kNodes> arc;      // theta_f - theta
  alignas(64) std::array<double, kNodes> advance;  // sin theta_f - sin theta
};

/// Normal stress sigma at Q = 1 at the nodes, eq. (4); the rear nodes mirror the front ones, so
/// that it is the same on both sides, eq. (5).
template <int kNodes>
struct Contact {
  Side<kNodes> front, rear;
  alignas(64) std::array<double, kNodes> sigma_pa;
};

template <int kNodes>
[[gnu::always_inline]] inline Contact<kNodes> lay_out(const Ground& ground, const Angles& angles) {
  const GradedNodes<kNodes>& nodes = graded_nodes<kNodes>();
  const double theta_f = angles.theta_f_rad;
  const double theta_r = angles.theta_r_rad;
  const double front_arc = theta_f - angles.theta_m_rad;
  const double rear_arc = angles.theta_m_rad - theta_r;
  const double sin_f = std::sin(theta_f), cos_f = std::cos(theta_f);
  const double sin_r = std::sin(theta_r), cos_r = std::cos(theta_r);
  const double scale = ground.stress_scale_pa;
  const double n = ground.soil.n;

  Contact<kNodes> contact;
  for (std::size_t i = 0; i < kNodes; ++i) {
    // theta = theta_f - d: differences to theta_f come without cancellation
    const double d = front_arc * nodes.t2[i];
    const double s = vector_math::sin(d / 2);
    const double c = vector_math::cos(d / 2);
    const double sin_d = 2 * s * c;
    const double versin_d = 2 * s * s;
    contact.front.arc[i] = d;
    contact.front.advance[i] = sin_f * versin_d + cos_f * sin_d;
    contact.front.sin_theta[i] = sin_f - contact.front.advance[i];
    const double rise = sin_f * sin_d - cos_f * versin_d;  // cos theta - cos theta_f
    contact.front.cos_theta[i] = cos_f + rise;
    contact.sigma_pa[i] = rise;
  }
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double d = rear_arc * nodes.t2[i];
    const double s = vector_math::sin(d / 2);
    const double c = vector_math::cos(d / 2);
    const double sin_d = 2 * s * c;
    const double versin_d = 2 * s * s;
    contact.rear.arc[i] = theta_f - theta_r - d;
    contact.rear.sin_theta[i] = sin_r + (cos_r * sin_d - sin_r * versin_d);
    contact.rear.cos_theta[i] = cos_r - (sin_r * sin_d + cos_r * versin_d);
    contact.rear.advance[i] = sin_f - contact.rear.sin_theta[i];
  }
  if (n == 1) {
    for (std::size_t i = 0; i < kNodes; ++i) contact.sigma_pa[i] *= scale;
  } else {
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double rise = contact.sigma_pa[i] < 1e-300 ? 1e-300 : contact.sigma_pa[i];
      contact.sigma_pa[i] = scale * vector_math::exp(n * vector_math::log(rise));
    }
  }
  return contact;
}

template <int kNodes>
[[gnu::always_inline]] inline Integrals integrate_at(const Ground& ground, const Angles& angles,
                                                     const Ratios& ratios) {
  const GradedNodes<kNodes>& nodes = graded_nodes<kNodes>();
  const Contact<kNodes> contact = lay_out<kNodes>(ground, angles);
  const double r = ground.wheel.radius_m;
  const double kx = ground.soil.kx0_m + ground.soil.kx1_m * ratios.beta_abs_rad;
  const double rim = ratios.rim * r / kx;
  const double axle = ratios.axle * r / kx;

  Integrals sum;
  for (const Side<kNodes>* side : {&contact.front, &contact.rear}) {
    double ec = 0, es = 0, ee = 0, sec = 0, ses = 0, see = 0, ss = 0, sc = 0;
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double w = nodes.weight[i];
      const double ws = w * contact.sigma_pa[i];
      const double cos_theta = side->cos_theta[i];
      const double sin_theta = side->sin_theta[i];
      const double j = rim * side->arc[i] - axle * side->advance[i];  // j_x / k_x, eq. (8)
      const double grown = 1 - vector_math::exp(-std::abs(j));
      const double e = j < 0 ? -grown : grown;  // eq. (7)
      ec += w * e * cos_theta;
      es += w * e * sin_theta;
      ee += w * e;
      sec += ws * e * cos_theta;
      ses += ws * e * sin_theta;
      see += ws * e;
      ss += ws * sin_theta;
      sc += ws * cos_theta;
    }
    const double arc = side == &contact.front ? angles.theta_f_rad - angles.theta_m_rad
                                              : angles.theta_m_rad - angles.theta_r_rad;
    const double rb = r * ground.wheel.width_m * arc;
    const double c = ground.soil.cohesion_pa;
    const double tan_phi = ground.tan_phi;
    sum.fx_cohesion_n += rb * c * ec;
    sum.fx_stress_n += rb * (tan_phi * sec - ss);
    sum.fz_cohesion_n += rb * c * es;
    sum.fz_stress_n += rb * (tan_phi * ses + sc);
    sum.torque_cohesion_nm += rb * r * c * ee;
    sum.torque_stress_nm += rb * r * tan_phi * see;
  }
  return sum;
}

template <int kNodes>
[[gnu::always_inline]] inline double shear_side_force_n(const Ground& ground, const Angles& angles,
                                                        const Ratios& ratios, double q) {
  const GradedNodes<kNodes>& nodes = graded_nodes<kNodes>();
  const Contact<kNodes> contact = lay_out<kNodes>(ground, angles);
  const double r = ground.wheel.radius_m;
  const double ky = ground.soil.ky0_m + ground.soil.ky1_m * ratios.beta_abs_rad;
  const double lateral = ratios.lateral * r / ky;
  const double c = ground.soil.cohesion_pa;
  const double q_tan_phi = q * ground.tan_phi;
  double front = 0, rear = 0;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double w = nodes.weight[i] * (c + contact.sigma_pa[i] * q_tan_phi);
    front += w * (1 - vector_math::exp(-lateral * contact.front.arc[i]));  // eqs. (10)(11)
    rear += w * (1 - vector_math::exp(-lateral * contact.rear.arc[i]));
  }
  return r * ground.wheel.width_m *
         (front * (angles.theta_f_rad - angles.theta_m_rad) +
          rear * (angles.theta_m_rad - angles.theta_r_rad));  // eq. (12)
}

/// Int Rb (r - h cos) dtheta over the contact, eq. (17), in closed form: with C = cos theta,
/// h = r (C - C_f) where that is positive.
double bulldozing_integral_n(const Ground& ground, const Angles& angles) {
  const double r = ground.wheel.radius_m;
  const double c_f = std::cos(angles.theta_f_rad);
  const double from = std::max(angles.theta_r_rad, -angles.theta_f_rad);
  const double to = angles.theta_f_rad;
  // integrals of C^k, k = 0..4
  const auto primitive = [](double theta) {
    const double s = std::sin(theta), c = std::cos(theta);
    const double i2 = (theta + s * c) / 2;
    return std::array<double, 5>{theta, s, i2, s - s * s * s / 3, s * c * c * c / 4 + 0.75 * i2};
  };
  const std::array<double, 5> upper = primitive(to), lower = primitive(from);
  std::array<double, 5> i{};
  for (std::size_t k = 0; k < 5; ++k) i[k] = upper[k] - lower[k];
  const double h1 = i[1] - c_f * i[0];
  const double h2 = i[2] - 2 * c_f * i[1] + c_f * c_f * i[0];
  const double h2c = i[3] - 2 * c_f * i[2] + c_f * c_f * i[1];
  const double h3c = i[4] - 3 * c_f * i[3] + 3 * c_f * c_f * i[2] - c_f * c_f * c_f * i[1];
  return ground.bulldoze_d1 * (ground.soil.cohesion_pa * r * r * (h1 - h2c) +
                               ground.bulldoze_weight * r * r * r * (h2 - h3c));
}

REGOPLAN_VECTOR_CLONES Integrals integrate_fast(const Ground& ground, const Angles& angles,
                                                const Ratios& ratios) {
  return integrate_at<16>(ground, angles, ratios);
}

REGOPLAN_VECTOR_CLONES Integrals integrate_exact(const Ground& ground, const Angles& angles,
                                                 const Ratios& ratios) {
  return integrate_at<40>(ground, angles, ratios);
}

REGOPLAN_VECTOR_CLONES double shear_side_force_fast_n(const Ground& ground, const Angles& angles,
                                                      const Ratios& ratios, double q) {
  return shear_side_force_n<16>(ground, angles, ratios, q);
}

REGOPLAN_VECTOR_CLONES double shear_side_force_exact_n(const Ground& ground, const Angles& angles,
                                                       const Ratios& ratios, double q) {
  return shear_side_force_n<40>(ground, angles, ratios, q);
}

}  // namespace

Ground::Ground(const Wheel& wheel_, const Soil& soil_, double gravity_mps2)
    : wheel(wheel_), soil(soil_) {
  const double phi = soil.friction_angle_rad;
  const double xc = std::numbers::pi / 4 - phi / 2;  // eq. (15)
  const double cot_xc = 1 / std::tan(xc);
  tan_phi = std::tan(phi);
  stress_scale_pa = std::pow(wheel.radius_m, soil.n) * (soil.kc / wheel.width_m + soil.kphi);
  bulldoze_d1 = cot_xc + std::tan(xc + phi);
  const double d2 = cot_xc + cot_xc * cot_xc * tan_phi;
  bulldoze_weight = d2 * soil.density_kgpm3 * gravity_mps2 / 2;
}

Angles angles_at(const Ground& ground, double theta_f_rad, double slip) {
  // acos(1 - lambda h/r) with h/r = 1 - cos theta_f, without cancellation at small angles
  const double sin_half = std::sin(theta_f_rad / 2);
  const double exit_sin_half = std::sqrt(ground.soil.lambda) * sin_half;
  return {.theta_f_rad = theta_f_rad,
          .theta_r_rad = -2 * std::asin(std::min(exit_sin_half, 1.0)),
          .theta_m_rad = (ground.soil.a0 + ground.soil.a1 * slip) * theta_f_rad};
}

Integrals integrate(const Ground& ground, const Angles& angles, const Ratios& ratios,
                    WheelAccuracy accuracy) {
  return accuracy == WheelAccuracy::kFast ? integrate_fast(ground, angles, ratios)
                                          : integrate_exact(ground, angles, ratios);
}

double side_force_n(const Ground& ground, const Angles& angles, const Ratios& ratios,
                    double stress_scale_q, WheelAccuracy accuracy) {
  constexpr double kNoLateralMotion = 1e-100;
  if (ratios.lateral < kNoLateralMotion) return 0;
  const double fu = accuracy == WheelAccuracy::kFast
                        ? shear_side_force_fast_n(ground, angles, ratios, stress_scale_q)
                        : shear_side_force_exact_n(ground, angles, ratios, stress_scale_q);
  const double ky = ground.soil.ky0_m + ground.soil.ky1_m * ratios.beta_abs_rad;
  const double mobilisation = -std::expm1(-ground.wheel.radius_m * ratios.lateral *
                                          (angles.theta_f_rad - angles.theta_r_rad) / ky);
  return fu + mobilisation * bulldozing_integral_n(ground, angles);
}

}  // namespace regoplan::wheel_contact
