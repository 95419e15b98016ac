#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "terramech/mechanisms/mechanism_effects.h"

/// The forms of all mechanisms, by what they change. Each states its formula, its source and the
/// usual range of its parameters; `proxy` marks a simple stand-in of our own for effects that the
/// literature describes in words or by experiment.
namespace regoplan::mechanism_catalogue {

using Parameters = FormParameters;

struct Definition {
  MechanismForm form;
  Effects (*act)(Effects, const Parameters&, const WheelState&);
};

/// Of a law whose curvature nobody knows.
inline constexpr MechanismParameter kExponent{
    .name = "p", .low = .5, .high = 2, .typical = 1, .least = .4, .most = 10};

inline double driving(const WheelState& at) {
  return std::max(at.slip, 0.0);
}
inline double braking(const WheelState& at) {
  return std::max(-at.slip, 0.0);
}

/// Slip velocity of the rim through the soil over the larger of rim and travel speed, in [0, 1]
/// straight ahead: |s| there, sin(beta) at a free-rolling rim.
inline double slip_velocity(const WheelState& at) {
  const double tangent = std::tan(std::min(at.beta_abs_rad, 1.5));
  const double rim = at.slip < 0 ? 1 + at.slip : 1;
  const double along = at.slip < 0 ? 1 : 1 - at.slip;
  const double travel = along * std::hypot(1, tangent);
  return std::hypot(rim - along, along * tangent) / std::max(rim, travel);
}

std::vector<Definition> of_sinkage();
std::vector<Definition> of_shear();
std::vector<Definition> of_soil();
std::vector<Definition> of_wheel();
std::vector<Definition> of_flanks_and_rim();

}  // namespace regoplan::mechanism_catalogue
