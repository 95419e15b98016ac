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
#include "terramech/wheel/wheel_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "terramech/basics/graded_nodes.h"
#include "terramech/basics/vector_clones.h"
#include "terramech/basics/vector_math.h"
#include "terramech/wheel/mechanism_contact.h"

namespace regoplan::wheel_contact {
namespace {

using vector_math::Eight;
using vector_math::Vec;

/// Normal stress at Q = 1 where cos(theta) exceeds cos(theta_f) by `rise`, eq. (4), over its scale.
template <class Numbers>
[[gnu::always_inline]] inline Numbers normal_stress(double n, Numbers rise) {
  using N = vector_math::Number<Numbers>;
  if (n == 1) return rise;
  constexpr N kNone = sizeof(N) == sizeof(float) ? N(1e-37) : N(1e-300);
  const Numbers positive = rise < kNone ? Numbers{} + kNone : rise;
  return vector_math::exp(N(n) * vector_math::log(positive));
}

/// Sums over the nodes of one side of theta_m, per unit of arc.
template <class Numbers>
struct Sums {
  using N = vector_math::Number<Numbers>;
  Numbers cohesion_x{}, cohesion_z{}, cohesion_t{};
  Numbers stress_x{}, stress_z{}, stress_t{};

  /// \param shear the mobilised share of the shear limit, signed, eq. (7)
  [[gnu::always_inline]] void add(Numbers weight, Numbers weighted_sigma, Numbers shear, N tan_phi,
                                  Numbers sin_theta, Numbers cos_theta) {
    const Numbers cohesive = weight * shear;
    cohesion_x += cohesive * cos_theta;
    cohesion_z += cohesive * sin_theta;
    cohesion_t += cohesive;
    const Numbers frictional = weighted_sigma * (tan_phi * shear);
    stress_x += frictional * cos_theta - weighted_sigma * sin_theta;
    stress_z += frictional * sin_theta + weighted_sigma * cos_theta;
    stress_t += frictional;
  }
};

/// sgn(j) (1 - exp(-|j|)), eq. (7), of a displacement counted in shear moduli.
template <class Numbers>
[[gnu::always_inline]] inline Numbers mobilised(Numbers j) {
  using N = vector_math::Number<Numbers>;
  return vector_math::with_sign(N(1) - vector_math::exp(-vector_math::abs(j)), j);
}

/// \tparam Numbers doubles, or floats where 1e-6 will do
template <std::size_t kNodes, class Numbers>
[[gnu::always_inline]] inline Integrals integrate_at(const Ground& ground, const Contact& at,
                                                     const Ratios& ratios) {
  using N = vector_math::Number<Numbers>;
  const GradedNodes<kNodes, Numbers>& nodes = graded_nodes<kNodes, Numbers>();
  const double r = ground.wheel.radius_m;
  const double kx = ground.soil.kx0_m + ground.soil.kx1_m * ratios.beta_abs_rad;
  const N rim = N(ratios.rim * r / kx), axle = N(ratios.axle * r / kx);
  const N front_arc = N(at.theta_f_rad - at.theta_m_rad);
  const N rear_arc = N(at.theta_m_rad - at.theta_r_rad);
  const N whole_arc = N(at.theta_f_rad - at.theta_r_rad);
  const N sin_f = N(at.sin_f), cos_f = N(at.cos_f), sin_r = N(at.sin_r), cos_r = N(at.cos_r);
  const N tan_phi = N(ground.tan_phi);

  Sums<Numbers> front, rear;
  for (std::size_t i = 0; i < nodes.kVectors; ++i) {
    const Numbers weight = nodes.weight[i];
    // theta = theta_f - d: differences to theta_f come without cancellation
    const Numbers d = front_arc * nodes.t3[i];
    const auto down = vector_math::turn(d);
    const Numbers advance = sin_f * down.versin + cos_f * down.sin;  // sin theta_f - sin theta
    const Numbers rise = sin_f * down.sin - cos_f * down.versin;     // cos theta - cos theta_f
    // eq. (5): the rear nodes mirror the front ones, so the stress is the same
    const Numbers weighted_sigma = weight * normal_stress(ground.soil.n, rise);
    front.add(weight, weighted_sigma, mobilised(rim * d - axle * advance), tan_phi, sin_f - advance,
              cos_f + rise);

    const Numbers e = rear_arc * nodes.t3[i];
    const auto up = vector_math::turn(e);
    const Numbers sin_theta = sin_r + (cos_r * up.sin - sin_r * up.versin);
    const Numbers cos_theta = cos_r - (sin_r * up.sin + cos_r * up.versin);
    rear.add(weight, weighted_sigma, mobilised(rim * (whole_arc - e) - axle * (sin_f - sin_theta)),
             tan_phi, sin_theta, cos_theta);
  }
  const double area = r * ground.wheel.width_m;
  using Part = Numbers Sums<Numbers>::*;
  const auto resultant = [&](double factor, Part x, Part z, Part t) {
    const auto both = [&](Part part) {
      return factor * vector_math::sum(front_arc * (front.*part) + rear_arc * (rear.*part));
    };
    return Resultant{.fx_n = both(x), .fz_n = both(z), .torque_nm = r * both(t)};
  };
  using S = Sums<Numbers>;
  return {
      .cohesion =
          resultant(area * ground.soil.cohesion_pa, &S::cohesion_x, &S::cohesion_z, &S::cohesion_t),
      .stress = resultant(area * ground.stress_scale_pa, &S::stress_x, &S::stress_z, &S::stress_t)};
}

/// |Fy| = Fu + M Fs, eqs. (9)(12), with Fs given.
template <std::size_t kNodes, class Numbers>
[[gnu::always_inline]] inline double side_force_at(const Ground& ground, const Contact& at,
                                                   const Ratios& ratios, double q,
                                                   double bulldozing_n) {
  using N = vector_math::Number<Numbers>;
  const GradedNodes<kNodes, Numbers>& nodes = graded_nodes<kNodes, Numbers>();
  const double r = ground.wheel.radius_m;
  const double ky = ground.soil.ky0_m + ground.soil.ky1_m * ratios.beta_abs_rad;
  const N lateral = N(ratios.lateral * r / ky);
  const N front_arc = N(at.theta_f_rad - at.theta_m_rad);
  const N rear_arc = N(at.theta_m_rad - at.theta_r_rad);
  const N whole_arc = N(at.theta_f_rad - at.theta_r_rad);
  const N cohesion_pa = N(ground.soil.cohesion_pa);
  const N friction_pa = N(q * ground.tan_phi * ground.stress_scale_pa);
  Numbers total{};
  for (std::size_t i = 0; i < nodes.kVectors; ++i) {
    const Numbers d = front_arc * nodes.t3[i];
    const auto down = vector_math::turn(d);
    const Numbers sigma =
        normal_stress(ground.soil.n, N(at.sin_f) * down.sin - N(at.cos_f) * down.versin);
    const Numbers limit = nodes.weight[i] * (cohesion_pa + sigma * friction_pa);  // eq. (10)
    const Numbers e = rear_arc * nodes.t3[i];
    total +=
        limit * (front_arc * (N(1) - vector_math::exp(-lateral * d)) +
                 rear_arc * (N(1) - vector_math::exp(-lateral * (whole_arc - e))));  // eq. (11)
  }
  const Numbers whole = Numbers{} + whole_arc;
  const double mobilisation = 1 - double{vector_math::exp(-lateral * whole)[0]};
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

REGOPLAN_VECTOR_CLONES Integrals integrate_fast_8(const Ground& ground, const Contact& contact,
                                                  const Ratios& ratios) {
  return integrate_at<8, Eight>(ground, contact, ratios);
}
REGOPLAN_VECTOR_CLONES Integrals integrate_fast_24(const Ground& ground, const Contact& contact,
                                                   const Ratios& ratios) {
  return integrate_at<24, Eight>(ground, contact, ratios);
}
REGOPLAN_VECTOR_CLONES Integrals integrate_20(const Ground& ground, const Contact& contact,
                                              const Ratios& ratios) {
  return integrate_at<20, Vec>(ground, contact, ratios);
}
REGOPLAN_VECTOR_CLONES Integrals integrate_40(const Ground& ground, const Contact& contact,
                                              const Ratios& ratios) {
  return integrate_at<40, Vec>(ground, contact, ratios);
}
REGOPLAN_VECTOR_CLONES double side_force_fast_n(const Ground& ground, const Contact& contact,
                                                const Ratios& ratios, double q,
                                                double bulldozing_n) {
  return side_force_at<16, Eight>(ground, contact, ratios, q, bulldozing_n);
}
REGOPLAN_VECTOR_CLONES double side_force_exact_n(const Ground& ground, const Contact& contact,
                                                 const Ratios& ratios, double q,
                                                 double bulldozing_n) {
  return side_force_at<24, Vec>(ground, contact, ratios, q, bulldozing_n);
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

double entry_angle_rad(double sinkage_m, double radius_m) {
  return 2 * std::asin(std::sqrt(sinkage_m / (2 * radius_m)));
}

double sinkage_at_m(double theta_f_rad, double radius_m) {
  return 2 * radius_m * std::pow(std::sin(theta_f_rad / 2), 2);
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
  constexpr double kSharp = 6;
  const bool nearly_locked = ratios.axle > kNearlyLocked || ratios.rim < 1;
  const bool shear_turns = ratios.axle > ratios.rim && ratios.axle * contact.cos_f < ratios.rim;
  // Deep, that corner is too sharp for nodes that do not know it.
  const bool sharp = accuracy == WheelAccuracy::kExact ||
                     ratios.axle * ground.wheel.radius_m >
                         kSharp * (ground.soil.kx0_m + ground.soil.kx1_m * ratios.beta_abs_rad);
  if (shear_turns && contact.cos_f < kDeepCosine && sharp) {
    return integrate_with_law(ground, contact, ratios, {}, accuracy).plane;
  }
  if (accuracy == WheelAccuracy::kExact) {
    return shear_turns || nearly_locked || contact.cos_f < kAlmostSunkCosine
               ? integrate_40(ground, contact, ratios)
               : integrate_20(ground, contact, ratios);
  }
  return nearly_locked || (shear_turns && contact.cos_f < kDeepCosine) ||
                 contact.cos_f < kAlmostSunkCosine
             ? integrate_fast_24(ground, contact, ratios)
             : integrate_fast_8(ground, contact, ratios);
}

double side_force_n(const Ground& ground, const Contact& contact, const Ratios& ratios,
                    double stress_scale_q, WheelAccuracy accuracy) {
  constexpr double kNoLateralMotion = 1e-100;
  if (ratios.lateral < kNoLateralMotion) return 0;
  const double bulldozing_n = bulldozing_integral_n(ground, contact);
  return accuracy == WheelAccuracy::kFast
             ? side_force_fast_n(ground, contact, ratios, stress_scale_q, bulldozing_n)
             : side_force_exact_n(ground, contact, ratios, stress_scale_q, bulldozing_n);
}

double bulldozing_force_n(const Ground& ground, const Contact& contact, const Ratios& ratios) {
  const double ky = ground.soil.ky0_m + ground.soil.ky1_m * ratios.beta_abs_rad;
  const double mobilisation = -std::expm1(-ground.wheel.radius_m * ratios.lateral *
                                          (contact.theta_f_rad - contact.theta_r_rad) / ky);
  return mobilisation * bulldozing_integral_n(ground, contact);
}

}  // namespace regoplan::wheel_contact
