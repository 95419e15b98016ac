#include "planner/driving/path_margins.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace regoplan {
namespace {

/// Missing margins come first.
double in_order(double margin) {
  return std::isnan(margin) ? -std::numeric_limits<double>::infinity() : margin;
}

}  // namespace

std::size_t smallest_margin_index(const std::vector<TrajectoryPoint>& points) {
  const auto at = std::min_element(points.begin(), points.end(),
                                   [](const TrajectoryPoint& a, const TrajectoryPoint& b) {
                                     return in_order(a.margin) < in_order(b.margin);
                                   });
  return static_cast<std::size_t>(at - points.begin());
}

LimitingPlace limiting_place(const std::vector<TrajectoryPoint>& points) {
  const TrajectoryPoint& at = points[smallest_margin_index(points)];
  const double cornering = in_order(at.cornering_margin), tip_over = in_order(at.tip_over_margin);
  // Beyond the supply there is no traction either: that is cornering.
  const double traction = std::isnan(at.traction_margin) && cornering < 0
                              ? std::numeric_limits<double>::infinity()
                              : in_order(at.traction_margin);
  const MarginKind kind = cornering <= std::min(tip_over, traction) ? MarginKind::kCornering
                          : tip_over <= traction                    ? MarginKind::kTipOver
                                                                    : MarginKind::kTraction;
  return {.margin = kind, .x_m = at.x_m, .y_m = at.y_m, .time_s = at.time_s};
}

double margin_of_worst_tenth(const std::vector<TrajectoryPoint>& points) {
  struct Piece {
    double margin, length_m;
  };
  std::vector<Piece> pieces;
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double step =
        std::hypot(points[i + 1].x_m - points[i].x_m, points[i + 1].y_m - points[i].y_m);
    pieces.push_back({std::min(points[i].margin, points[i + 1].margin), step});
    length += step;
  }
  if (!(length > 0)) return points.front().margin;
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.margin < b.margin; });
  double left = length / 10, sum = 0;
  for (const Piece& piece : pieces) {
    const double share = std::min(left, piece.length_m);
    sum += share * piece.margin;
    left -= share;
    if (left <= 0) break;
  }
  return sum / (length / 10);
}

}  // namespace regoplan
