#include "app/evaluate/evaluation_data.h"

#include <cmath>

#include "app/evaluate/evaluation_words.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr std::size_t kDrawnPointsMax = 200;

/// A margin at the mean soils, and what it is over their draws; null where the path has none.
nlohmann::json spread_data(std::string_view of, const PathEvaluation& e,
                           double PathMargins::*at_mean, Quantiles SoilSpread::*over_draws) {
  nlohmann::json data{
      {"margin", of}, {"at_mean", nullptr}, {"p05", nullptr}, {"p50", nullptr}, {"p95", nullptr}};
  if (!e.spread) return data;
  const Quantiles& drawn = (*e.spread).*over_draws;
  data.update({{"at_mean", e.margins.*at_mean},
               {"p05", drawn.p05},
               {"p50", drawn.p50},
               {"p95", drawn.p95}});
  return data;
}

nlohmann::json probability_data(const std::optional<SoilSpread>& spread) {
  if (!spread) return {{"share", nullptr}, {"low", nullptr}, {"high", nullptr}};
  const Probability& holds = spread->feasible;
  return {{"share", holds.share}, {"low", holds.low}, {"high", holds.high}};
}

/// Null where the path has no margins.
nlohmann::json limiting_data(const PathEvaluation& e) {
  if (!e.spread) return {{"x_m", nullptr}, {"y_m", nullptr}};
  return {{"x_m", e.limiting.x_m}, {"y_m", e.limiting.y_m}};
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
  nlohmann::json data{
      {"rank", e.rank},
      {"name", short_name(path)},
      {"feasible", e.feasible},
      {"spreads",
       {spread_data("cornering", e, &PathMargins::cornering, &SoilSpread::cornering),
        spread_data("tip_over", e, &PathMargins::tip_over, &SoilSpread::tip_over),
        spread_data("traction", e, &PathMargins::traction, &SoilSpread::traction)}},
      {"probability", probability_data(e.spread)},
      {"limiting", limiting_data(e)},
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
