#include "terramech/mechanism_contact.h"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace regoplan::wheel_contact {
namespace {

/// Mobilised shares of the shear limit along x and y (y: opposing the lateral motion).
struct Shares {
  double x, y;
};

/// Wong's hump, as a share of the peak that it reaches at j = k.
double hump(double j_over_k, double residual) {
  const double a = 1 / (residual * (1 - 1 / std::numbers::e)) - 1;
  return residual * (1 + a * std::exp(1 - j_over_k)) * -std::expm1(-j_over_k);
}

/// \param jx, jy displacement over shear modulus, \param vx, vy slip velocity over rim speed
Shares shares(ShearLaw law, double jx, double jy, double vx, double vy, double residual) {
  const double j = std::hypot(jx, jy);
  switch (law) {
    case ShearLaw::kSeparate:
      return {std::copysign(-std::expm1(-std::abs(jx)), jx), -std::expm1(-jy)};
    case ShearLaw::kHump:
      return {std::copysign(hump(std::abs(jx), residual), jx), hump(jy, residual)};
    case ShearLaw::kAlongDisplacement:
      if (j == 0) return {0, 0};
      return {-std::expm1(-j) * jx / j, -std::expm1(-j) * jy / j};
    case ShearLaw::kAlongSlipVelocity: {
      const double v = std::hypot(vx, vy);
      if (v == 0) return {0, 0};
      return {-std::expm1(-j) * vx / v, -std::expm1(-j) * vy / v};
    }
  }
  return {0, 0};
}

}  // namespace

LawIntegrals integrate_with_law(const Ground& ground, const Contact& contact, const Ratios& ratios,
                                ShearLaw law, double residual) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const double r = ground.wheel.radius_m;
  const double kx = ground.soil.kx0_m + ground.soil.kx1_m * ratios.beta_abs_rad;
  const double ky = ground.soil.ky0_m + ground.soil.ky1_m * ratios.beta_abs_rad;
  const double front_arc = contact.theta_f_rad - contact.theta_m_rad;
  const double rear_arc = contact.theta_m_rad - contact.theta_r_rad;
  LawIntegrals sum;
  const auto add = [&](double theta, double sigma, double weight) {
    const double arc = contact.theta_f_rad - theta;
    const double jx = r / kx * (ratios.rim * arc - ratios.axle * (contact.sin_f - std::sin(theta)));
    const double jy = r / ky * ratios.lateral * arc;
    const double vx = ratios.rim - ratios.axle * std::cos(theta);
    const Shares share = shares(law, jx, jy, vx, ratios.lateral, residual);
    const double area = r * ground.wheel.width_m * weight;
    const double cohesive = area * ground.soil.cohesion_pa;
    const double normal = area * sigma;
    const double frictional = normal * ground.tan_phi;
    const double s = std::sin(theta), c = std::cos(theta);
    sum.plane.cohesion =
        sum.plane.cohesion +
        Resultant{cohesive * share.x * c, cohesive * share.x * s, cohesive * share.x * r};
    sum.plane.stress = sum.plane.stress + Resultant{frictional * share.x * c - normal * s,
                                                    frictional * share.x * s + normal * c,
                                                    frictional * share.x * r};
    sum.fu_cohesion_n += cohesive * share.y;
    sum.fu_stress_n += frictional * share.y;
  };
  const auto node = [&](double t, double w) {
    const double t3 = t * t * t, weight = 3 * t * t * w / 2;
    const double theta = contact.theta_f_rad - front_arc * t3;
    const double rise = std::max(std::cos(theta) - contact.cos_f, 0.0);
    const double sigma = ground.stress_scale_pa * std::pow(rise, ground.soil.n);
    add(theta, sigma, weight * front_arc);
    add(contact.theta_r_rad + rear_arc * t3, sigma, weight * rear_arc);
  };
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    const double x = Gauss::abscissa()[i], w = Gauss::weights()[i];
    node((1 + x) / 2, w);
    if (x > 0) node((1 - x) / 2, w);
  }
  return sum;
}

}  // namespace regoplan::wheel_contact
