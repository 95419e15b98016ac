#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace regoplan::drives {

/// Solves a small linear system by elimination.
template <std::size_t kSize>
std::array<double, kSize> solved(std::array<std::array<double, kSize + 1>, kSize> rows) {
  for (std::size_t i = 0; i < kSize; ++i) {
    std::size_t best = i;
    for (std::size_t k = i + 1; k < kSize; ++k) {
      if (std::abs(rows[k][i]) > std::abs(rows[best][i])) best = k;
    }
    std::swap(rows[i], rows[best]);
    for (std::size_t k = 0; k < kSize; ++k) {
      if (k == i) continue;
      const double share = rows[k][i] / rows[i][i];
      for (std::size_t column = i; column <= kSize; ++column) {
        rows[k][column] -= share * rows[i][column];
      }
    }
  }
  std::array<double, kSize> answer{};
  for (std::size_t i = 0; i < kSize; ++i) answer[i] = rows[i][kSize] / rows[i][i];
  return answer;
}

}  // namespace regoplan::drives
