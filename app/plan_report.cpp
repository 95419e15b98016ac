#include "app/plan_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/plan_report_data.h"
#include "app/report_assets.h"
#include "app/report_page.h"

namespace regoplan {
namespace {

/// A name of files as words: `tip_over` as "tip over".
std::string words(std::string_view file_name) {
  std::string text(file_name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// A number as text, "unknown" where there is none.
std::string number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "unknown";
}

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string place(double x_m, double y_m, double time_s) {
  return fmt::format("x = {} m, y = {} m, t = {} s", number(x_m, 1), number(y_m, 1),
                     number(time_s, 1));
}

std::string with_stop(std::string sentence) {
  if (!sentence.empty() && sentence.back() != '.') sentence += '.';
  return sentence;
}

/// How likely the best path holds, in view of what is not known of the soils.
std::string soil_sentence(const PlanningProblem& problem, const Candidate& best) {
  return fmt::format(
      "Over {} draws of the soils within their uncertainty, the best path keeps every limit in {} "
      "of them; its margin falls below {} in 5 % of them.",
      problem.search.soil_draws,
      std::isfinite(best.probability_feasible)
          ? fmt::format("{:.0f} %", 100 * best.probability_feasible)
          : "an unknown share",
      number(best.margin_p05, 2));
}

std::string what_if_sentence(const WhatIf& what_if) {
  std::string sentence = fmt::format("What if: {}? ", what_if.question);
  if (what_if.feasible)
    return sentence +
           fmt::format("Still feasible, with a margin of {}.", number(what_if.margin_min, 2));
  return sentence + fmt::format("Rejected{} at {}.",
                                what_if.reason ? " for " + words(name(*what_if.reason)) : "",
                                place(what_if.x_m, what_if.y_m, what_if.time_s));
}

/// What the search mostly ran into; empty where it rejected nothing.
std::string rejection_sentence(const PlanResult& result) {
  const auto total =
      std::accumulate(result.rejected.begin(), result.rejected.end(), std::int64_t{0});
  if (total == 0) return "";
  const auto most = std::max_element(result.rejected.begin(), result.rejected.end());
  const auto reason = static_cast<Rejection>(most - result.rejected.begin());
  const double share = static_cast<double>(*most) / static_cast<double>(total);
  return fmt::format("The search rejected {} states, most often for {} ({:.0f} %).", total,
                     words(name(reason)), 100 * share);
}

std::vector<std::string> lead_sentences(const PlanningProblem& problem, const PlanResult& result) {
  std::vector<std::string> sentences;
  if (result.interrupted)
    sentences.emplace_back("The search was interrupted: this is what it had found by then.");
  if (result.status == PlanStatus::kFeasible && !result.reason.empty())
    sentences.push_back(with_stop(result.reason));
  if (result.certificate) sentences.push_back("Shown by: " + with_stop(*result.certificate));
  if (!result.candidates.empty())
    sentences.push_back(soil_sentence(problem, result.candidates.front()));
  for (const WhatIf& what_if : result.what_ifs) sentences.push_back(what_if_sentence(what_if));
  if (!result.overturned.empty())
    sentences.push_back(fmt::format(
        "{} that the search had found failed the independent replay and {} not counted.",
        counted(result.overturned.size(), "path"), result.overturned.size() == 1 ? "is" : "are"));
  if (std::string sentence = rejection_sentence(result); !sentence.empty())
    sentences.push_back(std::move(sentence));
  return sentences;
}

}  // namespace

std::string plan_headline(const PlanResult& result) {
  switch (result.status) {
    case PlanStatus::kInfeasible:
      return with_stop("Infeasible: " +
                       (result.reason.empty() ? "no reason was given" : result.reason));
    case PlanStatus::kUndecided:
      return with_stop("Undecided: " + (result.reason.empty()
                                            ? "no path was verified within the budget"
                                            : result.reason));
    case PlanStatus::kFeasible:
      break;
  }
  if (result.candidates.empty()) return "Feasible.";
  const Candidate& best = result.candidates.front();
  return fmt::format("Feasible: {}; the best keeps a stability margin of {} ({} binds at {}).",
                     counted(result.candidates.size(), "verified path"),
                     number(best.verified.margin_min, 2), words(name(best.limiting.margin)),
                     place(best.limiting.x_m, best.limiting.y_m, best.limiting.time_s));
}

std::string plan_report(const PlanningProblem& problem, const PlanResult& result) {
  const StartState& start = problem.start;
  const Goal& goal = problem.goal;
  return render(
      {.title = fmt::format("Plan for {} from ({:.1f}, {:.1f}) to ({:.1f}, {:.1f})",
                            problem.vehicle.name, start.x_m, start.y_m, goal.x_m, goal.y_m),
       .headline = plan_headline(result),
       .lead = lead_sentences(problem, result),
       .body_html = report_assets::kPlanHtml,
       .script = report_assets::kPlanScript,
       .data_json = json_for_html(plan_report_data(problem, result))});
}

}  // namespace regoplan
