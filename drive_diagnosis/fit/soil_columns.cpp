#include "drive_diagnosis/fit/soil_columns.h"

#include <array>
#include <optional>
#include <utility>

namespace regoplan {

SoilColumns soil_columns(const WindowComparison& comparison,
                         const std::vector<std::size_t>& numbers, const WindowQuestion& here,
                         const Eigen::MatrixXd& base, const std::stop_token& stop) {
  const std::size_t windows = comparison.size();
  std::vector<std::pair<std::size_t, WindowQuestion>> asked;
  std::vector<std::array<std::size_t, 2>> of;  // number and stretch
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    for (std::size_t w = 0; w < windows; ++w) {
      WindowQuestion question = here;
      WindowZone& stretch = question.zones.emplace_back(WindowZone{
          .begins = static_cast<double>(w), .ends = static_cast<double>(w + 1), .soil = kAsMapped});
      stretch.numbers.at(numbers[k]) = 1;
      for (const std::size_t near : comparison.touching_in_run(w, stretch)) {
        asked.emplace_back(near, question);
        of.push_back({k, w});
      }
    }
  }
  const std::vector<std::optional<Eigen::VectorXd>> there = comparison.predicted_each(asked, stop);
  SoilColumns columns(numbers.size(), std::vector<Eigen::MatrixXd>(windows, 0 * base));
  for (std::size_t n = 0; n < asked.size(); ++n) {
    if (!there[n]) continue;
    const auto near = static_cast<Eigen::Index>(asked[n].first);
    columns[of[n][0]][of[n][1]].row(near) = there[n]->transpose() - base.row(near);
  }
  return columns;
}

}  // namespace regoplan
