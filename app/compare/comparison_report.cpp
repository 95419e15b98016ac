#include "app/compare/comparison_report.h"

#include <fmt/format.h>

#include <cmath>

#include "app/page/report_assets.h"
#include "app/page/report_page.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

/// Every so manieth point, so that a page of many paths stays small.
Json path_json(const std::optional<ComparedPath>& path) {
  if (!path) return nullptr;
  constexpr std::size_t kMost = 400;
  const std::size_t count = path->x_m.size(), stride = count / kMost + 1;
  Json points = Json::array();
  double way_m = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0)
      way_m += std::hypot(path->x_m[i] - path->x_m[i - 1], path->y_m[i] - path->y_m[i - 1]);
    if (i % stride != 0 && i + 1 != count) continue;
    points.push_back(
        {path->x_m[i], path->y_m[i], way_m, path->margin.empty() ? Json() : Json(path->margin[i])});
  }
  return points;
}

/// A page goes to others: it names a result, not where it lies.
std::string short_name(const ComparedResult& result) {
  const std::filesystem::path folder = absolute(result.file).parent_path().filename();
  return (folder / result.file.filename()).generic_string();
}

Json metrics_json(ResultKind kind) {
  Json metrics = Json::array();
  for (const ComparedMetric& metric : metrics_of(kind)) {
    metrics.push_back({{"key", metric.key},
                       {"words", metric.words},
                       {"unit", metric.unit},
                       {"more_is_better", metric.better == ComparedMetric::Better::kMore}});
  }
  return metrics;
}

}  // namespace

std::string comparison_report(const ComparedResult& a, const ComparedResult& b,
                              const Comparison& comparison) {
  Json data = comparison_json(a, b, comparison);
  data["kind"] = "comparison";
  data["of"] = name(a.kind);
  data["sampled"] = sampled(a.kind);
  data["a"]["file"] = short_name(a);
  data["b"]["file"] = short_name(b);
  data["metrics"] = metrics_json(a.kind);
  for (std::size_t i = 0; i < comparison.pairs.size(); ++i) {
    const ComparedPair& pair = comparison.pairs[i];
    data["entries"][i]["paths"] = {{"a", pair.a ? path_json(pair.a->path) : Json()},
                                   {"b", pair.b ? path_json(pair.b->path) : Json()}};
  }
  return render({.command = "compare",
                 .title = fmt::format("Two results: {}", name(a.kind)),
                 .headline = comparison_headline(a, b, comparison),
                 .lead = {"A: " + short_name(a), "B: " + short_name(b)},
                 .body_html = report_assets::kCompareHtml,
                 .script = report_assets::kCompareScript,
                 .data_json = json_for_html(nlohmann::json(data))});
}

}  // namespace regoplan
