#include "app/evaluate/evaluation_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/page/plan_report_data.h"
#include "app/page/report_assets.h"
#include "app/page/report_page.h"

namespace regoplan {
namespace {

std::string words(std::string_view file_name) {
  std::string text(file_name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string short_name(const EvaluatedPath& path) {
  return path.on_the_map ? std::filesystem::path(path.evaluation.name).filename().string()
                         : path.evaluation.name;
}

std::string limiting_text(const PathEvaluation& e) {
  std::string text = fmt::format("{} at ({:.1f}, {:.1f}), {:.1f} s", words(name(e.limiting.margin)),
                                 e.limiting.x_m, e.limiting.y_m, e.limiting.time_s);
  if (const auto& limit = e.cornering_limit) {
    text += fmt::format("; supply ends by {}{} at {:.0f} N", name(limit->limit),
                        limit->wheel.empty() ? "" : " of " + words(limit->wheel), limit->supply_n);
  }
  return text;
}

std::string influence_text(const SoilSpread& spread) {
  if (spread.draws > 0 && spread.influences.empty()) return "too few draws to tell";
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, spread.influences.size()); ++i) {
    const SoilInfluence& influence = spread.influences[i];
    if (influence.share < 0.01) break;
    text += fmt::format("{}{} of {} {:.0f} %", text.empty() ? "" : ", ", influence.parameter,
                        influence.soil, 100 * influence.share);
  }
  return text.empty() ? "soil numbers known" : text;
}

std::string cell(std::string_view text, bool number = false) {
  return fmt::format("<td{}>{}</td>", number ? " class=\"number\"" : "", html_escaped(text));
}

/// A cell of a sentence.
std::string wide_cell(std::string_view text) {
  return fmt::format("<td style=\"min-width:16em\">{}</td>", html_escaped(text));
}

std::string table_row(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  const SoilSpread& spread = e.spread;
  const auto quantiles = [](const Quantiles& q) {
    return fmt::format("{:.3f} / {:.3f} / {:.3f}", q.p05, q.p50, q.p95);
  };
  return "<tr>" + cell(fmt::format("{}", e.rank), true) + cell(short_name(path)) +
         (e.feasible ? cell("feasible") : wide_cell("not feasible: " + sentence(*e.refusal))) +
         cell(fmt::format("{:.3f}", e.margin_min), true) + wide_cell(limiting_text(e)) +
         cell(quantiles(spread.cornering), true) + cell(quantiles(spread.tip_over), true) +
         cell(quantiles(spread.traction), true) +
         cell(fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100 * spread.feasible.share,
                          100 * spread.feasible.low, 100 * spread.feasible.high),
              true) +
         wide_cell(influence_text(spread)) +
         cell(fmt::format("{:.2f} m", e.tracking.deviation_max_m), true) +
         cell(fmt::format("{:.1f} m", e.length_m), true) +
         cell(fmt::format("{:.1f} s", e.duration_s), true) +
         cell(fmt::format("{:.1f} kJ", e.tracking.energy_j / 1000), true) + "</tr>\n";
}

std::string table_html(const EvaluationResult& result) {
  std::string html =
      "<section><h2>Side by side</h2><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Table of the paths\"><table>\n<thead><tr>";
  for (const char* head :
       {"Rank", "Path", "Verdict", "Smallest margin", "Limited by", "Cornering 5/50/95 %",
        "Tip-over 5/50/95 %", "Traction 5/50/95 %", "P(margins hold), 95 % interval",
        "Soil number that decides", "Deviation", "Length", "Duration", "Energy"}) {
    html += fmt::format("<th scope=\"col\">{}</th>", html_escaped(head));
  }
  html += "</tr></thead><tbody>\n";
  for (const EvaluatedPath& path : result.paths) html += table_row(path);
  return html + "</tbody></table></div></section>\n";
}

std::string method_html(const EvaluationResult& result) {
  std::string html = "<section><h2>How this was decided</h2><ul>\n";
  const auto item = [&html](const std::string& text) {
    html += fmt::format("<li>{}</li>\n", html_escaped(text));
  };
  item(
      "Commanded path: at stations at most 0.5 m apart (a candidate: at the moments of its record) "
      "the demand of the steady manoeuvre is held against the supply of the direct wheel model.");
  item(
      "Driven path: the vehicle's dynamics track it in closed loop, slip, slip angle, sinkage, "
      "slope, obstacles and deviation limited at every step. Steering law: " +
      steering_law_text(result.settings.follower.law) + ".");
  item(
      "Feasible where both hold. P is the probability that the margins hold over what is known of "
      "the soils, speeds and curvatures held, with Wilson's interval; every path sees the same "
      "draws.");
  for (const EvaluatedPath& path : result.paths) {
    const SoilSpread& spread = path.evaluation.spread;
    if (spread.draws == 0) continue;
    const PathMargins& error = spread.surrogate_error;
    item(
        fmt::format("{}: {} draws at {} places, {} by the wheel model{}; a linear regression "
                    "explains {:.0f} % of the margin's variance.",
                    short_name(path), spread.draws, spread.places, spread.direct_draws,
                    spread.direct_draws == spread.draws
                        ? ""
                        : fmt::format(", the others by a quadratic surrogate less its largest "
                                      "overestimate on draws it was not made from (cornering "
                                      "{:.4f}, tip-over {:.4f}, traction {:.4f})",
                                      error.cornering, error.tip_over, error.traction),
                    100 * spread.explained));
  }
  return html + "</ul></section>\n";
}

/// An evaluation as the picture and the charts of plans know it.
Candidate as_candidate(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  return {.rank = e.rank,
          .planner = short_name(path),
          .points = e.points,
          .length_m = e.length_m,
          .duration_s = e.duration_s,
          .energy_j = e.tracking.energy_j,
          .margin_min = e.margin_min,
          .margin_worst_tenth = e.margin_worst_tenth,
          .spread = MarginSpread{.draws = e.spread.draws,
                                 .p05 = e.spread.margin.p05,
                                 .p05_low = e.spread.margin_p05_interval.low,
                                 .p05_high = e.spread.margin_p05_interval.high,
                                 .feasible = e.spread.feasible},
          .limiting = e.limiting,
          .verified = {.passed = e.feasible,
                       .reason = e.refusal ? sentence(*e.refusal) : "",
                       .margin_min = e.margin_min,
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
      .status = result.any_feasible() ? PlanStatus::kFeasible : PlanStatus::kInfeasible,
      .seed = result.settings.seed,
      .interrupted = result.interrupted};
  for (const EvaluatedPath& path : result.paths) {
    if (!path.on_the_map) continue;
    const PathEvaluation& e = path.evaluation;
    if (e.refusal) {
      if (const auto mark = as_mark(*e.refusal)) picture.rejected_states.push_back(*mark);
    }
    (e.feasible ? picture.candidates : picture.overturned).push_back(as_candidate(path));
  }
  nlohmann::json data = plan_report_data(problem, picture);
  data["kind"] = "evaluation";
  return data;
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
    return by_then + fmt::format("None of {} feasible; first: {} fails for {}.",
                                 result.paths.size(), short_name(best), sentence(*e.refusal));
  }
  return by_then +
         fmt::format("{} of {} feasible; the best, {}, keeps a stability margin of {:.2f} ({}).",
                     feasible, result.paths.size(), short_name(best), e.margin_min,
                     limiting_text(e));
}

std::string evaluation_report(const PlanningProblem& problem, const EvaluationResult& result) {
  const bool with_map =
      std::ranges::any_of(result.paths, [](const EvaluatedPath& path) { return path.on_the_map; });
  std::string body = table_html(result);
  if (with_map) body += report_assets::kEvaluationHtml;
  body += method_html(result);
  std::vector<std::string> lead;
  if (result.interrupted) lead.emplace_back("Interrupted: this is what was evaluated by then.");
  return render({.title = fmt::format("Evaluation for {}", problem.vehicle.name),
                 .headline = evaluation_headline(result),
                 .lead = lead,
                 .body_html = body,
                 .script = with_map ? report_assets::kEvaluationScript : std::string_view(),
                 .data_json = json_for_html(with_map ? picture_data(problem, result)
                                                     : nlohmann::json::object())});
}

}  // namespace regoplan
