#include "app/evaluate/evaluation_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "app/evaluate/evaluation_data.h"
#include "app/evaluate/evaluation_sections.h"
#include "app/evaluate/evaluation_words.h"
#include "app/page/plan_report_data.h"
#include "app/page/report_assets.h"
#include "app/page/report_page.h"

namespace regoplan {
namespace {

std::optional<MarginSpread> margin_spread_of(const std::optional<SoilSpread>& spread) {
  if (!spread) return std::nullopt;
  return MarginSpread{.draws = spread->draws,
                      .p05 = spread->margin.p05,
                      .p05_low = spread->margin_p05_interval.low,
                      .p05_high = spread->margin_p05_interval.high,
                      .p50 = spread->margin.p50,
                      .p50_low = spread->margin_p50_interval.low,
                      .p50_high = spread->margin_p50_interval.high,
                      .feasible = spread->feasible};
}

/// An evaluation as the picture and the charts of plans know it.
Candidate as_candidate(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double margin_min = e.spread ? e.margin_min : kNone;
  return {.rank = e.rank,
          .planner = short_name(path),
          .points = e.points,
          .length_m = e.length_m,
          .duration_s = e.duration_s,
          .energy_j = e.tracking.energy_j,
          .margin_min = margin_min,
          .margin_worst_tenth = e.spread ? e.margin_worst_tenth : kNone,
          .spread = margin_spread_of(e.spread),
          .limiting = e.limiting,
          .verified = {.passed = e.feasible,
                       .reason = e.refusal ? sentence(*e.refusal) : "",
                       .margin_min = margin_min,
                       .deviation_max_m = e.tracking.deviation_max_m}};
}

/// A mark where a path is refused, as pictures of plans know it; nothing where the reason is none
/// of a state.
std::optional<RejectedState> as_mark(const Refusal& refusal) {
  if (static_cast<int>(refusal.reason) >= kRejectionCount) return std::nullopt;
  return RejectedState{.reason = refusal.reason,
                       .x_m = refusal.x_m,
                       .y_m = refusal.y_m,
                       .exceeded = refusal.exceeded,
                       .while_stopping = refusal.while_stopping};
}

nlohmann::json picture_data(const PlanningProblem& problem, const EvaluationResult& result) {
  PlanResult picture{
      .status = result.status(), .seed = result.settings.seed, .interrupted = result.interrupted};
  for (const EvaluatedPath& path : result.paths) {
    if (path.plane) continue;
    const PathEvaluation& e = path.evaluation;
    if (e.refusal) {
      if (const auto mark = as_mark(*e.refusal)) picture.rejected_states.push_back(*mark);
    }
    (e.feasible ? picture.candidates : picture.overturned).push_back(as_candidate(path));
  }
  return plan_report_data(problem, picture);
}

}  // namespace

std::string evaluation_headline(const EvaluationResult& result) {
  const std::string by_then = result.interrupted ? "Interrupted; by then: " : "";
  if (result.paths.empty()) return by_then + "Nothing was evaluated.";
  const auto feasible = std::ranges::count_if(
      result.paths, [](const EvaluatedPath& path) { return path.evaluation.feasible; });
  const EvaluatedPath& best = result.paths.front();
  const PathEvaluation& e = best.evaluation;
  if (feasible == 0) {
    return by_then + fmt::format("None of {} feasible at the mean soils; first: {} fails for {}.",
                                 result.paths.size(), short_name(best), sentence(*e.refusal));
  }
  return by_then +
         fmt::format(
             "{} of {} feasible at the mean soils; the best, {}, keeps a stability margin "
             "of {:.2f} there ({}).",
             feasible, result.paths.size(), short_name(best), e.margin_min, limiting_text(e));
}

std::string evaluation_report(const PlanningProblem& problem, const EvaluationResult& result) {
  const bool with_map =
      std::ranges::any_of(result.paths, [](const EvaluatedPath& path) { return !path.plane; });
  std::string body = side_by_side_html(result);
  if (with_map) body += report_assets::kEvaluationHtml;
  body += courses_html(result) + method_html(result);
  nlohmann::json data = with_map ? picture_data(problem, result) : nlohmann::json::object();
  data["kind"] = with_map ? "evaluation" : "manoeuvres";
  data["margin_min"] = problem.limits.margin_min;
  data["courses"] = courses_data(result);
  std::vector<std::string> lead;
  if (result.interrupted) lead.emplace_back("Interrupted: this is what was evaluated by then.");
  if (std::string ties = tie_sentence(result); !ties.empty()) lead.push_back(std::move(ties));
  return render(
      {.command = "evaluate",
       .title = fmt::format("Evaluation for {}", problem.vehicle.name),
       .headline = evaluation_headline(result),
       .lead = lead,
       .body_html = body,
       .script = with_map ? report_assets::kEvaluationScript : report_assets::kManoeuvresScript,
       .data_json = json_for_html(data)});
}

}  // namespace regoplan
