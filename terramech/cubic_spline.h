#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace regoplan::cubic_spline {

/// Weights of the four coefficients that reach into the interval of t, from `first` on.
struct Weights {
  std::size_t first = 0;
  std::array<double, 4> value{}, slope{};  ///< slope: by t
};

/// Uniform cubic B-spline on t in [0, 1] with `intervals` intervals.
[[gnu::always_inline]] inline Weights weights(double t, std::size_t intervals) {
  const double n = static_cast<double>(intervals);
  const double x = t * n;
  const auto i = static_cast<std::size_t>(x < n - 1 ? x : n - 1);
  const double f = x - static_cast<double>(i);
  const double g = 1 - f;
  const double f2 = f * f, g2 = g * g;
  return {.first = i,
          .value = {g2 * g / 6, 2.0 / 3 - f2 * (1 - f / 2), 2.0 / 3 - g2 * (1 - g / 2), f2 * f / 6},
          .slope = {-g2 / 2 * n, f * (1.5 * f - 2) * n, -g * (1.5 * g - 2) * n, f2 / 2 * n}};
}

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
