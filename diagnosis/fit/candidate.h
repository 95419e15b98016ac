#pragma once

#include <optional>
#include <vector>

#include "diagnosis/bed/wheel_bed.h"
#include "diagnosis/fit/effect.h"

namespace regoplan {

/// What is wrong, if anything, and from which soil.
struct Hypothesis {
  std::vector<Effect> effects;
};

/// The soil at x with the factors of effects that have a shear modulus of their own.
Soil soil_of(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
             const Hypothesis& candidate, const Eigen::VectorXd& x);

/// The mechanism with its numbers at x (the effect's own coordinates).
Mechanism mechanism_at(const Effect& effect, const Eigen::VectorXd& x);

/// Model values of a candidate; x holds the soil's coordinates, then each effect's.
std::optional<Eigen::VectorXd> predict(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
                                       const Hypothesis& candidate, const Eigen::VectorXd& x);

}  // namespace regoplan
