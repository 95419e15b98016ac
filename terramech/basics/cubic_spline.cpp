#include "terramech/basics/cubic_spline.h"

#include <Eigen/Dense>

namespace regoplan::cubic_spline {

std::vector<double> interpolate(const std::vector<double>& values, std::size_t before,
                                std::size_t intervals, std::size_t after) {
  const std::size_t n = nodes(intervals), m = coefficients(intervals);
  const auto rows = static_cast<Eigen::Index>(m);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(rows, rows);
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    system(row, row) = 1.0 / 6;
    system(row, row + 1) = 2.0 / 3;
    system(row, row + 2) = 1.0 / 6;
  }
  // the third derivative is the same on either side of the first and of the last inner knot
  const std::array<double, 5> jump{-1, 4, -6, 4, -1};
  for (Eigen::Index k = 0; k < 5; ++k) {
    system(rows - 2, k) = jump[static_cast<std::size_t>(k)];
    system(rows - 1, rows - 5 + k) = jump[static_cast<std::size_t>(k)];
  }
  const Eigen::MatrixXd inverse = system.inverse();
  std::vector<double> result(before * m * after, 0);
  for (std::size_t a = 0; a < before; ++a) {
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double factor = inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        const double* from = &values[(a * n + j) * after];
        double* to = &result[(a * m + i) * after];
        for (std::size_t c = 0; c < after; ++c) to[c] += factor * from[c];
      }
    }
  }
  return result;
}

}  // namespace regoplan::cubic_spline
