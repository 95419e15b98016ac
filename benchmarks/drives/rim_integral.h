#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "terramech/parameters/soil.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan::drives {

/// Nodes and weights on (-1, 1), by Newton's method on the Legendre polynomial.
template <int kNodes>
struct Quadrature {
  std::array<double, kNodes> node{}, weight{};
  Quadrature() {
    for (int i = 0; i < kNodes; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (kNodes + 0.5)), slope = 1;
      for (int round = 0; round < 50; ++round) {
        double below = 1, here = x;
        for (int k = 2; k <= kNodes; ++k) {
          const double next = ((2 * k - 1) * x * here - (k - 1) * below) / k;
          below = here;
          here = next;
        }
        slope = kNodes * (x * here - below) / (x * x - 1);
        x -= here / slope;
      }
      node.at(static_cast<std::size_t>(i)) = x;
      weight.at(static_cast<std::size_t>(i)) = 2 / ((1 - x * x) * slope * slope);
    }
  }
};

/// What the rim feels at a sinkage, per wheel.
struct Contact {
  double up = 0, along = 0, aside = 0, torque = 0;
};

/// One wheel in one state of motion; the sinkage is asked for.

class RimIntegral {
 public:
  RimIntegral(const Wheel& wheel, const Soil& soil, double gravity, double along, double left,
              double rim)
      : wheel_(wheel), soil_(soil), gravity_(gravity) {
    ratio_ = along / rim;  // of a rim that turns forward
    sideways_ = std::abs(left) / rim;
    beta_ = std::atan2(std::abs(left), std::abs(along));
    slip_ = rim > along ? (rim - along) / rim : (rim - along) / along;
    kx_ = soil.kx0_m + soil.kx1_m * beta_;
    ky_ = soil.ky0_m + soil.ky1_m * beta_;
    stiffness_ = std::pow(wheel.radius_m, soil.n) * (soil.kc / wheel.width_m + soil.kphi);
  }

  Contact at(double sinkage, bool whole = false) const {
    const double r = wheel_.radius_m;
    const double front = std::acos(1 - sinkage / r);
    const double rear = -std::acos(1 - std::min(soil_.lambda * sinkage / r, 2.0));
    const double peak = (soil_.a0 + soil_.a1 * slip_) * front;
    Contact sum;
    add(sum, rear, peak, front, rear, peak);
    add(sum, peak, front, front, rear, peak);
    if (!whole) return sum;
    const double mobilised = 1 - std::exp(-r * sideways_ * (front - rear) / ky_);
    sum.aside += mobilised * bulldozed(front, rear);
    return sum;
  }

 private:
  void add(Contact& sum, double from, double to, double front, double rear, double peak) const {
    static const Quadrature<8> rule;
    const double r = wheel_.radius_m, b = wheel_.width_m, half = (to - from) / 2;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double angle = (from + to) / 2 + half * rule.node[i];
      const double mirrored =
          angle >= peak ? angle : front - (angle - rear) / (peak - rear) * (front - peak);
      const double depth = std::max(std::cos(mirrored) - std::cos(front), 0.0);
      const double pressure = stiffness_ * (soil_.n == 1 ? depth : std::pow(depth, soil_.n));
      const double strength = soil_.cohesion_pa + pressure * std::tan(soil_.friction_angle_rad);
      const double jx = r * (front - angle - ratio_ * (std::sin(front) - std::sin(angle)));
      const double jy = r * sideways_ * (front - angle);
      const double tx = std::copysign(strength * -std::expm1(-std::abs(jx) / kx_), jx);
      const double ty = strength * -std::expm1(-jy / ky_);
      const double area = r * b * half * rule.weight[i];
      sum.up += area * (tx * std::sin(angle) + pressure * std::cos(angle));
      sum.along += area * (tx * std::cos(angle) - pressure * std::sin(angle));
      sum.aside += area * ty;
      sum.torque += area * r * tx;
    }
  }

  double bulldozed(double front, double rear) const {
    static const Quadrature<8> rule;
    const double phi = soil_.friction_angle_rad, wedge = std::numbers::pi / 4 - phi / 2;
    const double cot = 1 / std::tan(wedge);
    const double d1 = cot + std::tan(wedge + phi), d2 = cot + cot * cot / std::tan(phi);
    const double r = wheel_.radius_m;
    double sum = 0;
    // Where the rim is above the soil it pushes nothing: the rear part beyond the front's angle.
    const double from = std::max(rear, -front), half = (front - from) / 2;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double angle = (from + front) / 2 + half * rule.node[i];
      const double deep = std::max(r * (std::cos(angle) - std::cos(front)), 0.0);
      const double resistance =
          d1 * (soil_.cohesion_pa * deep + d2 * soil_.density_kgpm3 * gravity_ * deep * deep / 2);
      sum += half * rule.weight[i] * resistance * (r - deep * std::cos(angle));
    }
    return sum;
  }

  const Wheel& wheel_;
  const Soil& soil_;
  double gravity_, ratio_ = 1, sideways_ = 0, beta_ = 0, slip_ = 0, kx_ = 1, ky_ = 1;
  double stiffness_ = 0;
};

}  // namespace regoplan::drives
