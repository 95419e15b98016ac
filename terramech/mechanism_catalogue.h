#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "terramech/mechanism_effects.h"

/// The forms of all mechanisms, by what they change. Each states its formula, its source and the
/// usual range of its parameters; `proxy` marks a simple stand-in of our own for effects that the
/// literature describes in words or by experiment.
namespace regoplan::mechanism_catalogue {

using Parameters = std::array<double, 4>;

struct Definition {
  MechanismForm form;
  Effects (*act)(Effects, const Parameters&, const WheelState&);
};

inline double driving(const WheelState& at) {
  return std::max(at.slip, 0.0);
}
inline double braking(const WheelState& at) {
  return std::max(-at.slip, 0.0);
}

std::vector<Definition> of_sinkage();
std::vector<Definition> of_shear();
std::vector<Definition> of_soil();
std::vector<Definition> of_wheel();

}  // namespace regoplan::mechanism_catalogue
