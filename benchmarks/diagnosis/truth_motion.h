#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/diagnosis/truth_wheel.h"

/// How a wheel moves, in the terms in which the truths' forms are stated.
namespace regoplan::challenge {

inline constexpr double kDegree = std::numbers::pi / 180;

/// Slip ratio of a driven wheel, else 0.
inline double driving(const TruthPhysics& p) {
  return std::max(p.at.slip_ratio, 0.0);
}
/// Size of the slip ratio of a braked wheel, else 0.
inline double braking(const TruthPhysics& p) {
  return std::max(-p.at.slip_ratio, 0.0);
}
/// Size of the slip angle.
inline double beta_rad(const TruthPhysics& p) {
  return std::abs(p.at.slip_angle_rad);
}

}  // namespace regoplan::challenge
