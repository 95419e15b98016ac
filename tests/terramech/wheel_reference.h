#pragma once

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "terramech/wheel/wheel_model.h"

/// The wheel model written the naive way, from the equations alone and sharing no code with the
/// library: adaptive Gauss-Kronrod quadrature, a scan for the smallest rising root, and a
/// bracketing root finder. The tests' judge and the benchmark's baseline.
namespace regoplan::wheel_reference {

struct Result {
  double fx_n = 0, fy_n = 0, torque_nm = 0, sinkage_m = 0;
  bool carried = false;
};

class Reference {
 public:
  explicit Reference(const WheelModelSpec& spec, double tolerance = 1e-11)
      : spec_(spec), tolerance_(tolerance) {}

  /// A wheel that rolls forward, slip ratio in (-1, 1], slip angle in [-pi/2, pi/2].
  Result forces(double load_n, double slip, double beta_rad, int scan_steps = 60) const {
    const double q_v = slip >= 0 ? 1 - slip : 1 / (1 + slip);
    const State state{slip, q_v, q_v * std::tan(std::abs(beta_rad)), std::abs(beta_rad)};
    if (spec_.variant == WheelVariant::kIshigami2007) {
      const auto theta_f = root(load_n, state, scan_steps);
      if (!theta_f) return {};
      return at(*theta_f, 1, state, beta_rad);
    }
    const auto at_rest = root(load_n, State{0, 1, 0, 0}, scan_steps);
    if (!at_rest) return {};
    const double r = spec_.wheel.radius_m;
    const double h = r * (1 - std::cos(*at_rest)) + spec_.soil.c0_m * std::max(slip, 0.0);
    if (h >= r) return {};
    const double theta_f = std::acos(1 - h / r);
    const double cohesion_part = fz(theta_f, 0, state);
    const double q = (load_n - cohesion_part) / (fz(theta_f, 1, state) - cohesion_part);
    if (!(q >= 0)) return {};
    return at(theta_f, q, state, beta_rad);
  }

  /// The vertical force at an entry angle, for looking at its roots.
  double fz_n(double theta_f, double slip, double beta_rad) const {
    const double q_v = slip >= 0 ? 1 - slip : 1 / (1 + slip);
    return fz(theta_f, 1, State{slip, q_v, 0, std::abs(beta_rad)});
  }

 private:
  struct State {
    double slip, q_v, u, beta_rad;
  };

  double theta_r(double theta_f) const {
    return -std::acos(std::max(-1.0, 1 - spec_.soil.lambda * (1 - std::cos(theta_f))));
  }
  double theta_m(double theta_f, const State& state) const {
    return (spec_.soil.a0 + spec_.soil.a1 * state.slip) * theta_f;
  }

  double sigma(double theta, double theta_f, const State& state) const {
    const double m = theta_m(theta_f, state), back = theta_r(theta_f);
    const double star = theta >= m ? theta : theta_f - (theta - back) / (m - back) * (theta_f - m);
    const double rise = std::max(0.0, std::cos(star) - std::cos(theta_f));
    return std::pow(spec_.wheel.radius_m, spec_.soil.n) *
           (spec_.soil.kc / spec_.wheel.width_m + spec_.soil.kphi) * std::pow(rise, spec_.soil.n);
  }

  double tau_x(double theta, double theta_f, double q, const State& state) const {
    const double kx = spec_.soil.kx0_m + spec_.soil.kx1_m * state.beta_rad;
    const double jx = spec_.wheel.radius_m *
                      (theta_f - theta - state.q_v * (std::sin(theta_f) - std::sin(theta)));
    const double limit = spec_.soil.cohesion_pa +
                         q * sigma(theta, theta_f, state) * std::tan(spec_.soil.friction_angle_rad);
    return std::copysign(limit * -std::expm1(-std::abs(jx) / kx), jx);
  }

  /// Int f over the contact. The substitution theta = end -+ arc t^2 tames the corners at the ends.
  template <class F>
  double over_contact(double theta_f, const State& state, F f) const {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    const double m = theta_m(theta_f, state), back = theta_r(theta_f);
    const auto front = [&](double t) {
      return f(theta_f - (theta_f - m) * t * t) * 2 * t * (theta_f - m);
    };
    const auto rear = [&](double t) { return f(back + (m - back) * t * t) * 2 * t * (m - back); };
    return Rule::integrate(front, 0.0, 1.0, 12, tolerance_) +
           Rule::integrate(rear, 0.0, 1.0, 12, tolerance_);
  }

  double fz(double theta_f, double q, const State& state) const {
    return spec_.wheel.radius_m * spec_.wheel.width_m *
           over_contact(theta_f, state, [&](double theta) {
             return tau_x(theta, theta_f, q, state) * std::sin(theta) +
                    q * sigma(theta, theta_f, state) * std::cos(theta);
           });
  }

  std::optional<double> root(double load_n, const State& state, int steps) const {
    const double top = std::numbers::pi / 2, bottom = 1e-3;
    const Reference coarse(spec_, std::max(tolerance_, 1e-6));
    const auto excess = [&](double theta_f) { return fz(theta_f, 1, state) - load_n; };
    double low = bottom;
    for (int i = 1; i <= steps; ++i) {
      const double high = bottom * std::pow(top / bottom, static_cast<double>(i) / steps);
      if (coarse.fz(high, 1, state) >= load_n && excess(high) >= 0) {
        std::uintmax_t iterations = 100;
        const auto bracket = boost::math::tools::toms748_solve(
            excess, low, high, boost::math::tools::eps_tolerance<double>(48), iterations);
        return (bracket.first + bracket.second) / 2;
      }
      low = high;
    }
    return std::nullopt;
  }

  Result at(double theta_f, double q, const State& state, double beta_rad) const {
    const double r = spec_.wheel.radius_m, b = spec_.wheel.width_m;
    const double phi = spec_.soil.friction_angle_rad, c = spec_.soil.cohesion_pa;
    const double ky = spec_.soil.ky0_m + spec_.soil.ky1_m * state.beta_rad;
    const auto tau = [&](double theta) { return tau_x(theta, theta_f, q, state); };
    Result result;
    result.carried = true;
    result.fx_n =
        r * b * over_contact(theta_f, state, [&](double theta) {
          return tau(theta) * std::cos(theta) - q * sigma(theta, theta_f, state) * std::sin(theta);
        });
    result.torque_nm = r * r * b * over_contact(theta_f, state, tau);
    const double fu = r * b * over_contact(theta_f, state, [&](double theta) {
                        return (c + q * sigma(theta, theta_f, state) * std::tan(phi)) *
                               -std::expm1(-r * state.u * (theta_f - theta) / ky);
                      });
    const double xc = std::numbers::pi / 4 - phi / 2;
    const double cot = 1 / std::tan(xc);
    const double d1 = cot + std::tan(xc + phi), d2 = cot + cot * cot * std::tan(phi);
    const double fs = over_contact(theta_f, state, [&](double theta) {
      const double h = std::max(0.0, r * (std::cos(theta) - std::cos(theta_f)));
      return d1 * (c * h + d2 * spec_.soil.density_kgpm3 * spec_.gravity_mps2 * h * h / 2) *
             (r - h * std::cos(theta));
    });
    const double mobilised = -std::expm1(-r * state.u * (theta_f - theta_r(theta_f)) / ky);
    const double side = beta_rad > 0 ? 1 : beta_rad < 0 ? -1 : 0;
    result.fy_n = side * (fu + mobilised * fs);
    result.sinkage_m = r * (1 - std::cos(theta_f));
    return result;
  }

  WheelModelSpec spec_;
  double tolerance_;
};

}  // namespace regoplan::wheel_reference
