#include "app/evaluate/evaluation_data.h"

#include <cmath>

#include "app/evaluate/evaluation_words.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr std::size_t kDrawnPointsMax = 200;

/// A margin at the mean soils, and what it is over their draws.
nlohmann::json spread_data(std::string_view of, double at_mean, const Quantiles& over_draws) {
  return {{"margin", of},
          {"at_mean", at_mean},
          {"p05", over_draws.p05},
          {"p50", over_draws.p50},
          {"p95", over_draws.p95}};
}

nlohmann::json line_data(const std::vector<TrajectoryPoint>& points) {
  nlohmann::json x_m = nlohmann::json::array(), y_m = x_m, yaw_deg = x_m, margin = x_m;
  const auto in_mm = [](double value_m) { return std::round(1e3 * value_m) / 1e3; };
  const std::size_t count = std::min(points.size(), kDrawnPointsMax);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t last = points.size() - 1;
    const TrajectoryPoint& point = points[count > 1 ? k * last / (count - 1) : 0];
    x_m.push_back(in_mm(point.x_m));
    y_m.push_back(in_mm(point.y_m));
    yaw_deg.push_back(std::round(10 * degrees(point.yaw_rad)) / 10);
    margin.push_back(std::round(1e3 * point.margin) / 1e3);
  }
  return {{"x_m", x_m}, {"y_m", y_m}, {"yaw_deg", yaw_deg}, {"margin", margin}};
}

nlohmann::json course_data(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  nlohmann::json data{{"rank", e.rank},
                      {"name", short_name(path)},
                      {"feasible", e.feasible},
                      {"spreads",
                       {spread_data("cornering", e.margins.cornering, e.spread.cornering),
                        spread_data("tip_over", e.margins.tip_over, e.spread.tip_over),
                        spread_data("traction", e.margins.traction, e.spread.traction)}},
                      {"probability",
                       {{"share", e.spread.feasible.share},
                        {"low", e.spread.feasible.low},
                        {"high", e.spread.feasible.high}}},
                      {"limiting", {{"x_m", e.limiting.x_m}, {"y_m", e.limiting.y_m}}},
                      {"line", line_data(e.points)},
                      {"refused", nullptr},
                      {"plane", nullptr}};
  if (e.refusal)
    data["refused"] = {
        {"reason", name(e.refusal->reason)}, {"x_m", e.refusal->x_m}, {"y_m", e.refusal->y_m}};
  if (path.plane)
    data["plane"] = {{"slope_deg", degrees(path.plane->slope_rad)},
                     {"uphill_deg", degrees(path.plane->uphill_rad)},
                     {"on_the_spot", path.plane->on_the_spot}};
  return data;
}

}  // namespace

nlohmann::json courses_data(const EvaluationResult& result) {
  nlohmann::json courses = nlohmann::json::array();
  for (const EvaluatedPath& path : result.paths) courses.push_back(course_data(path));
  return courses;
}

}  // namespace regoplan
