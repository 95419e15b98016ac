#include "drive_diagnosis/fit/zone_borders.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace regoplan {

WindowSet windows_at_borders(const WindowComparison& comparison,
                             const std::vector<WindowZone>& zones) {
  std::vector<WindowZone> borders;
  for (const WindowZone& zone : zones) {
    for (const auto& [at, slant] :
         {std::pair{zone.begins, zone.begins_slant}, {zone.ends, zone.ends_slant}}) {
      const auto all = static_cast<double>(comparison.size());
      borders.push_back({.begins = std::max(0.0, at - kEdgeErr),
                         .ends = std::min(all, at + kEdgeErr),
                         .begins_slant = slant,
                         .ends_slant = slant});
    }
  }
  return comparison.touching(borders);
}

Eigen::MatrixXd border_std(const WindowComparison& comparison, const WindowQuestion& here,
                           const EdgesErr& err, const std::stop_token& stop) {
  const WindowSet windows = windows_at_borders(comparison, here.zones);
  std::vector<WindowQuestion> questions;
  for (std::size_t z = 0; z < here.zones.size(); ++z) {
    for (double WindowZone::*edge : {&WindowZone::begins, &WindowZone::ends}) {
      for (const double off : {err.windows, -err.windows}) {
        const double moved = here.zones[z].*edge + off;
        questions.push_back(here);
        questions.back().zones[z].*edge =
            std::clamp(moved, 0.0, static_cast<double>(comparison.size()));
      }
    }
    for (double WindowZone::*slant : {&WindowZone::begins_slant, &WindowZone::ends_slant}) {
      for (const double off : {err.angle_rad, -err.angle_rad}) {
        questions.push_back(here);
        questions.back().zones[z].*slant = std::tan(std::atan(here.zones[z].*slant) + off);
      }
    }
  }
  const std::vector<Eigen::MatrixXd> there = comparison.predicted(
      windows, questions, comparison.measured(), MotionsByWindow(comparison.size()), stop);
  Eigen::MatrixXd squares = 0 * comparison.measured();
  for (std::size_t n = 0; n < there.size(); n += 2) {
    squares += ((there[n] - there[n + 1]) / 2).cwiseAbs2();
  }
  return squares.cwiseSqrt();
}

}  // namespace regoplan
