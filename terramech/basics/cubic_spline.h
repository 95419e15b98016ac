#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace regoplan::cubic_spline {

/// Number of values at nodes, and of the coefficients that a spline through them has.
inline std::size_t nodes(std::size_t intervals) {
  return intervals + 1;
}
inline std::size_t coefficients(std::size_t intervals) {
  return intervals + 3;
}

/// Values on a grid [before][nodes][after] turned into coefficients [before][coefficients][after]
/// along the middle axis; not-a-knot at both ends. At least 3 intervals.
std::vector<double> interpolate(const std::vector<double>& values, std::size_t before,
                                std::size_t intervals, std::size_t after);

}  // namespace regoplan::cubic_spline
