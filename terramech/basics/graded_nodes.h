#pragma once

#include <array>
#include <boost/math/quadrature/gauss.hpp>

#include "terramech/basics/vector_math.h"

namespace regoplan::wheel_contact {

/// Gauss-Legendre nodes t in (0, 1) for integrals over an arc, graded by t^3 towards the end of the
/// contact, where stress and shear have their corners (n < 1, a locked wheel, beta near 90 deg).
/// Holds t^3 and 3 t^2 w.
template <std::size_t kNodes, class Numbers>
struct GradedNodes {
  using Number = vector_math::Number<Numbers>;
  static constexpr std::size_t kLanes = sizeof(Numbers) / sizeof(Number);
  static constexpr std::size_t kVectors = kNodes / kLanes;
  static_assert(kVectors * kLanes == kNodes);
  std::array<Numbers, kVectors> t3;
  std::array<Numbers, kVectors> weight;

  GradedNodes() {
    using Gauss = boost::math::quadrature::gauss<double, kNodes>;
    for (std::size_t i = 0; i < kNodes; ++i) {
      const bool upper = i >= kNodes / 2;
      const std::size_t half = upper ? i - kNodes / 2 : kNodes / 2 - 1 - i;
      const double t = (1 + (upper ? 1 : -1) * Gauss::abscissa()[half]) / 2;
      t3[i / kLanes][i % kLanes] = static_cast<Number>(t * t * t);
      weight[i / kLanes][i % kLanes] = static_cast<Number>(3 * t * t * Gauss::weights()[half] / 2);
    }
  }
};

template <std::size_t kNodes, class Numbers>
const GradedNodes<kNodes, Numbers>& graded_nodes() {
  static const GradedNodes<kNodes, Numbers> nodes;
  return nodes;
}

}  // namespace regoplan::wheel_contact
