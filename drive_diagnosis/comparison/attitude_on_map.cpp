#include "drive_diagnosis/comparison/attitude_on_map.h"

#include <cmath>

namespace regoplan {

bool attitude_follows_map(const WindowComparison& comparison, const Eigen::MatrixXd& as_said) {
  double of_both = 0, of_measured = 0, of_map = 0;
  for (Eigen::Index k = 0; k < as_said.cols(); ++k) {
    const std::string& channel = comparison.channels()[static_cast<std::size_t>(k)];
    if (channel != "pitch_rad" && channel != "roll_rad") continue;
    const Eigen::ArrayXd measured =
        comparison.measured().col(k).array() - comparison.measured().col(k).mean();
    const Eigen::ArrayXd said = as_said.col(k).array() - as_said.col(k).mean();
    of_both += (measured * said).sum();
    of_measured += measured.square().sum();
    of_map += said.square().sum();
  }
  constexpr double kFollows = 0.9;
  return of_both > kFollows * std::sqrt(of_measured * of_map);
}

}  // namespace regoplan
