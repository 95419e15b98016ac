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
#include <cmath>
#include <numbers>

#include "terramech/graded_nodes.h"
#include "terramech/vector_clones.h"
#include "terramech/vector_math.h"

namespace regoplan::wheel_contact {
namespace {

using vector_math::Vec;

/// Normal stress at Q = 1 where cos(theta) exceeds cos(theta_f) by `rise`, eq. (4).
[[gnu::always_inline]] inline Vec normal_stress_pa(const Ground& ground, Vec rise) {
  if (ground.soil.n == 1) return ground.stress_scale_pa * rise;
  const Vec positive = rise < 1e-300 ? Vec{} + 1e-300 : rise;
  return ground.stress_scale_pa * vector_math::exp(ground.soil.n * vector_math::log(positive));
}

/// Sums over the nodes of one side of theta_m, per unit of arc.
struct Sums {
  Vec cohesion_x{}, cohesion_z{}, cohesion_t{};
  Vec stress_x{}, stress_z{}, stress_t{};

  /// \param shear the mobilised share of the shear limit, signed, eq. (7)
  [[gnu::always_inline]] void add(Vec weight, Vec weighted_sigma, Vec shear, double tan_phi,
                                  Vec sin_theta, Vec cos_theta) {
    const Vec cohesive = weight * shear;
    cohesion_x += cohesive * cos_theta;
    cohesion_z += cohesive * sin_theta;
    cohesion_t += cohesive;
    const Vec frictional = weighted_sigma * (tan_phi * shear);
    stress_x += frictional * cos_theta - weighted_sigma * sin_theta;
    stress_z += frictional * sin_theta + weighted_sigma * cos_theta;
    stress_t += frictional;
  }
};

/// sgn(j) (1 - exp(-|j|)), eq. (7), of a displacement counted in shear moduli.
[[gnu::always_inline]] inline Vec mobilised(Vec j) {
  return vector_math::with_sign(1.0 - vector_math::exp(-vector_math::abs(j)), j);
}

template <std::size_t kNodes>
[[gnu::always_inline]] inline Integrals integrate_at(const Ground& ground, const Contact& at,
                                                     const Ratios& ratios) {
  const GradedNodes<kNodes>& nodes = graded_nodes<kNodes>();
  const double r = ground.wheel.radius_m;
  const double kx = ground.soil.kx0_m + ground.soil.kx1_m * ratios.beta_abs_rad;
  const double rim = ratios.rim * r / kx;
  const double axle = ratios.axle * r / kx;
  const double front_arc = at.theta_f_rad - at.theta_m_rad;
  const double rear_arc = at.theta_m_rad - at.theta_r_rad;
  const double whole_arc = at.theta_f_rad - at.theta_r_rad;

  Sums front, rear;
  for (std::size_t i = 0; i < nodes.kVectors; ++i) {
    const Vec weight = nodes.weight[i];
    // theta = theta_f - d: differences to theta_f come without cancellation
    const Vec d = front_arc * nodes.t3[i];
    const vector_math::Turn down = vector_math::turn(d);
    const Vec advance = at.sin_f * down.versin + at.cos_f * down.sin;  // sin theta_f - sin theta
    const Vec rise = at.sin_f * down.sin - at.cos_f * down.versin;     // cos theta - cos theta_f
    // eq. (5): the rear nodes mirror the front ones, so the stress is the same
    const Vec weighted_sigma = weight * normal_stress_pa(ground, rise);
    front.add(weight, weighted_sigma, mobilised(rim * d - axle * advance), ground.tan_phi,
              at.sin_f - advance, at.cos_f + rise);

    const Vec e = rear_arc * nodes.t3[i];
    const vector_math::Turn up = vector_math::turn(e);
    const Vec sin_theta = at.sin_r + (at.cos_r * up.sin - at.sin_r * up.versin);
    const Vec cos_theta = at.cos_r - (at.sin_r * up.sin + at.cos_r * up.versin);
    rear.add(weight, weighted_sigma,
             mobilised(rim * (whole_arc - e) - axle * (at.sin_f - sin_theta)), ground.tan_phi,
             sin_theta, cos_theta);
  }
  const double b = ground.wheel.width_m;
  const auto resultant = [&](const Vec Sums::*x, const Vec Sums::*z, const Vec Sums::*t) {
    const auto both = [&](const Vec Sums::*part) {
      return r * b * vector_math::sum(front_arc * (front.*part) + rear_arc * (rear.*part));
    };
    return Resultant{.fx_n = both(x), .fz_n = both(z), .torque_nm = r * both(t)};
  };
  return {.cohesion = ground.soil.cohesion_pa *
                      resultant(&Sums::cohesion_x, &Sums::cohesion_z, &Sums::cohesion_t),
          .stress = resultant(&Sums::stress_x, &Sums::stress_z, &Sums::stress_t)};
}

/// |Fy| = Fu + M Fs, eqs. (9)(12), with Fs given.
template <std::size_t kNodes>
[[gnu::always_inline]] inline double side_force_at(const Ground& ground, const Contact& at,
                                                   const Ratios& ratios, double q,
                                                   double bulldozing_n) {
  const GradedNodes<kNodes>& nodes = graded_nodes<kNodes>();
  const double r = ground.wheel.radius_m;
  const double ky = ground.soil.ky0_m + ground.soil.ky1_m * ratios.beta_abs_rad;
  const double lateral = ratios.lateral * r / ky;
  const double front_arc = at.theta_f_rad - at.theta_m_rad;
  const double rear_arc = at.theta_m_rad - at.theta_r_rad;
  const double whole_arc = at.theta_f_rad - at.theta_r_rad;
  Vec total{};
  for (std::size_t i = 0; i < nodes.kVectors; ++i) {
    const Vec d = front_arc * nodes.t3[i];
    const vector_math::Turn down = vector_math::turn(d);
    const Vec sigma = normal_stress_pa(ground, at.sin_f * down.sin - at.cos_f * down.versin);
    const Vec limit =
        nodes.weight[i] * (ground.soil.cohesion_pa + sigma * (q * ground.tan_phi));  // eq. (10)
    const Vec e = rear_arc * nodes.t3[i];
    total += limit * (front_arc * (1.0 - vector_math::exp(-lateral * d)) +
                      rear_arc * (1.0 - vector_math::exp(-lateral * (whole_arc - e))));  // eq. (11)
  }
  const Vec whole = Vec{} + whole_arc;
  const double mobilisation = 1 - vector_math::exp(-lateral * whole)[0];
  return r * ground.wheel.width_m * vector_math::sum(total) + mobilisation * bulldozing_n;
}

/// Int Rb (r - h cos) dtheta over the contact, eq. (17), in closed form: with C = cos theta,
/// h = r (C - C_f) where that is positive.
double bulldozing_integral_n(const Ground& ground, const Contact& at) {
  const double r = ground.wheel.radius_m;
  const double c_f = at.cos_f;
  // integrals of C^k, k = 0..4
  const auto primitive = [](double theta, double s, double c) {
    const double i2 = (theta + s * c) / 2;
    return std::array<double, 5>{theta, s, i2, s - s * s * s / 3, s * c * c * c / 4 + 0.75 * i2};
  };
  const bool rear_is_higher = at.theta_r_rad < -at.theta_f_rad;
  const std::array<double, 5> upper = primitive(at.theta_f_rad, at.sin_f, at.cos_f);
  const std::array<double, 5> lower = rear_is_higher
                                          ? primitive(-at.theta_f_rad, -at.sin_f, at.cos_f)
                                          : primitive(at.theta_r_rad, at.sin_r, at.cos_r);
  std::array<double, 5> i{};
  for (std::size_t k = 0; k < 5; ++k) i[k] = upper[k] - lower[k];
  const double h1 = i[1] - c_f * i[0];
  const double h2 = i[2] - 2 * c_f * i[1] + c_f * c_f * i[0];
  const double h2c = i[3] - 2 * c_f * i[2] + c_f * c_f * i[1];
  const double h3c = i[4] - 3 * c_f * i[3] + 3 * c_f * c_f * i[2] - c_f * c_f * c_f * i[1];
  return ground.bulldoze_cohesion_pa * r * r * (h1 - h2c) +
         ground.bulldoze_weight * r * r * r * (h2 - h3c);
}

REGOPLAN_VECTOR_CLONES Integrals integrate_8(const Ground& ground, const Contact& contact,
                                             const Ratios& ratios) {
  return integrate_at<8>(ground, contact, ratios);
}
REGOPLAN_VECTOR_CLONES Integrals integrate_12(const Ground& ground, const Contact& contact,
                                              const Ratios& ratios) {
  return integrate_at<12>(ground, contact, ratios);
}
REGOPLAN_VECTOR_CLONES Integrals integrate_20(const Ground& ground, const Contact& contact,
                                              const Ratios& ratios) {
  return integrate_at<20>(ground, contact, ratios);
}
REGOPLAN_VECTOR_CLONES Integrals integrate_40(const Ground& ground, const Contact& contact,
                                              const Ratios& ratios) {
  return integrate_at<40>(ground, contact, ratios);
}
REGOPLAN_VECTOR_CLONES double side_force_12_n(const Ground& ground, const Contact& contact,
                                              const Ratios& ratios, double q, double bulldozing_n) {
  return side_force_at<12>(ground, contact, ratios, q, bulldozing_n);
}
REGOPLAN_VECTOR_CLONES double side_force_24_n(const Ground& ground, const Contact& contact,
                                              const Ratios& ratios, double q, double bulldozing_n) {
  return side_force_at<24>(ground, contact, ratios, q, bulldozing_n);
}

}  // namespace

Ground::Ground(const Wheel& wheel_, const Soil& soil_, double gravity_mps2)
    : wheel(wheel_), soil(soil_) {
  const double phi = soil.friction_angle_rad;
  const double xc = std::numbers::pi / 4 - phi / 2;  // eq. (15)
  const double cot_xc = 1 / std::tan(xc);
  tan_phi = std::tan(phi);
  sqrt_lambda = std::sqrt(soil.lambda);
  stress_scale_pa = std::pow(wheel.radius_m, soil.n) * (soil.kc / wheel.width_m + soil.kphi);
  const double d1 = cot_xc + std::tan(xc + phi);
  bulldoze_cohesion_pa = d1 * soil.cohesion_pa;
  const double d2 = cot_xc + cot_xc * cot_xc * tan_phi;
  bulldoze_weight = d1 * d2 * soil.density_kgpm3 * gravity_mps2 / 2;
}

Contact contact_at(const Ground& ground, double theta_f_rad, double slip) {
  // h/r = 2 z^2 with z = sin(theta_f/2); acos(1 - lambda h/r) = 2 asin(sqrt(lambda) z): neither
  // cancels at small angles
  const double z = std::sin(theta_f_rad / 2);
  const double z_exit = std::min(ground.sqrt_lambda * z, 1.0);
  return {.theta_f_rad = theta_f_rad,
          .theta_r_rad = -2 * std::asin(z_exit),
          .theta_m_rad = (ground.soil.a0 + ground.soil.a1 * slip) * theta_f_rad,
          .sin_f = 2 * z * std::sqrt(1 - z * z),
          .cos_f = 1 - 2 * z * z,
          .sin_r = -2 * z_exit * std::sqrt(1 - z_exit * z_exit),
          .cos_r = 1 - 2 * z_exit * z_exit};
}

Integrals integrate(const Ground& ground, const Contact& contact, const Ratios& ratios,
                    WheelAccuracy accuracy) {
  // Where the shear has corners it takes more nodes: almost locked, it grows within a sliver at the
  // entry; braking lightly, jx starts forward and turns back, and eq. (7) has a corner at jx = 0.
  constexpr double kNearlyLocked = 12, kDeepCosine = 0.7, kAlmostSunkCosine = 0.5;
  const bool nearly_locked = ratios.axle > kNearlyLocked || ratios.rim < 1;
  const bool shear_turns = ratios.axle > ratios.rim && ratios.axle * contact.cos_f < ratios.rim;
  if (accuracy == WheelAccuracy::kExact) {
    return shear_turns || nearly_locked || contact.cos_f < kAlmostSunkCosine
               ? integrate_40(ground, contact, ratios)
               : integrate_20(ground, contact, ratios);
  }
  if ((shear_turns && contact.cos_f < kDeepCosine) || contact.cos_f < kAlmostSunkCosine)
    return integrate_20(ground, contact, ratios);
  return nearly_locked ? integrate_12(ground, contact, ratios)
                       : integrate_8(ground, contact, ratios);
}

double side_force_n(const Ground& ground, const Contact& contact, const Ratios& ratios,
                    double stress_scale_q, WheelAccuracy accuracy) {
  constexpr double kNoLateralMotion = 1e-100;
  if (ratios.lateral < kNoLateralMotion) return 0;
  const double bulldozing_n = bulldozing_integral_n(ground, contact);
  return accuracy == WheelAccuracy::kFast
             ? side_force_12_n(ground, contact, ratios, stress_scale_q, bulldozing_n)
             : side_force_24_n(ground, contact, ratios, stress_scale_q, bulldozing_n);
}

double bulldozing_force_n(const Ground& ground, const Contact& contact, const Ratios& ratios) {
  const double ky = ground.soil.ky0_m + ground.soil.ky1_m * ratios.beta_abs_rad;
  const double mobilisation = -std::expm1(-ground.wheel.radius_m * ratios.lateral *
                                          (contact.theta_f_rad - contact.theta_r_rad) / ky);
  return mobilisation * bulldozing_integral_n(ground, contact);
}

}  // namespace regoplan::wheel_contact
