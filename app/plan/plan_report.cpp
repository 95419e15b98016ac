#include "app/plan/plan_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/page/plan_report_data.h"
#include "app/page/report_assets.h"
#include "app/page/report_page.h"
#include "app/page/tie_sentence.h"
#include "planner/verdict/ranking.h"

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

/// What the margin says that places without a steady drive count as; empty where none is shown.
std::string broken_margin_sentence(const MarginSpread& spread) {
  const std::string shown = number(MarginSpread::kBroken, 2);
  if (spread.p05 <= MarginSpread::kBroken) {
    return fmt::format(
        " A margin of {} stands for a place where the soil of that draw bears no steady drive at "
        "all.",
        shown);
  }
  if (spread.p05_low <= MarginSpread::kBroken) {
    return fmt::format(
        " Its lower end of {} says that so many draws do not rule out soils that bear no steady "
        "drive at all.",
        shown);
  }
  return "";
}

/// How likely the best path holds, in view of what is not known of the soils.
std::string soil_sentence(const Candidate& best) {
  if (!best.spread) return "How its margin spreads over the soils' uncertainty was not drawn.";
  const MarginSpread& spread = *best.spread;
  if (spread.draws == 0) {
    return "Every number of the soils is known exactly: there was nothing to draw.";
  }
  return fmt::format(
      "Over {} draws of the soils within their uncertainty, the best path keeps its margins in "
      "{:.0f} % of them (95 % interval of the share: {:.0f} to {:.0f} %); in 5 % of them its "
      "smallest margin is {} or less (95 % interval of that quantile: {} to {}).{}",
      spread.draws, 100 * spread.feasible.share, 100 * spread.feasible.low,
      100 * spread.feasible.high, number(spread.p05, 2), number(spread.p05_low, 2),
      number(spread.p05_high, 2), broken_margin_sentence(spread));
}

/// How far from the fastest path that there is.
std::string gap_sentence(const PlanResult& result) {
  const auto fastest_s = fastest_duration_s(result), gap = duration_gap(result);
  if (!gap) return "";
  return fmt::format(
      "The fastest of these paths takes {:.1f} s; no path of this problem is faster than {:.1f} s "
      "(gap {:.0f} %).",
      *fastest_s, *result.least_duration_s, 100 * *gap);
}

/// How sure the best path is, and with how much margin: over the draws of the soils first, as its
/// margin at the mean soils alone promises too much.
std::string best_words(const Candidate& best) {
  const std::string at_mean = number(best.verified.margin_min, 2);
  if (!best.spread) {
    return fmt::format("the best keeps a stability margin of {} at the mean soils", at_mean);
  }
  if (best.spread->draws == 0) {
    return fmt::format("the best keeps a stability margin of {} on soils that are known exactly",
                       at_mean);
  }
  const MarginSpread& spread = *best.spread;
  if (spread.p05 <= MarginSpread::kBroken) {
    return fmt::format(
        "the best holds in {:.0f} of {} draws of the soils; in 5 % of them or more the soil bears "
        "no steady drive along it (its stability margin is {} at the mean soils)",
        spread.feasible.share * spread.draws, spread.draws, at_mean);
  }
  return fmt::format(
      "the best holds in {:.0f} of {} draws of the soils, with a stability margin of {} or more in "
      "95 % of them ({} at the mean soils)",
      spread.feasible.share * spread.draws, spread.draws, number(spread.p05, 2), at_mean);
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

std::vector<std::string> lead_sentences(const PlanResult& result) {
  std::vector<std::string> sentences;
  if (result.interrupted)
    sentences.emplace_back("The search was interrupted: this is what it had found by then.");
  if (!result.candidates.empty() && !result.reason.empty())
    sentences.push_back(with_stop(result.reason));
  if (result.certificate && *result.certificate != result.reason) {
    sentences.push_back("Shown by: " + with_stop(*result.certificate));
  }
  if (!result.candidates.empty()) sentences.push_back(soil_sentence(result.candidates.front()));
  if (std::string sentence = tie_sentence(result.candidates); !sentence.empty())
    sentences.push_back(std::move(sentence));
  if (std::string sentence = gap_sentence(result); !sentence.empty())
    sentences.push_back(std::move(sentence));
  if (!result.doubtful_soils.empty()) {
    sentences.push_back(fmt::format(
        "More than one in twenty draws of {} would not bear the vehicle on its usual slopes: "
        "every other search kept off {}.",
        fmt::join(result.doubtful_soils, " and of "),
        result.doubtful_soils.size() == 1 ? "it" : "them"));
  }
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

std::string plan_headline(const PlanResult& result, const Limits& limits) {
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
  if (result.candidates.empty()) return with_stop("Feasible: " + result.reason);
  const Candidate& best = result.candidates.front();
  return fmt::format(
      "Feasible{}: {}; {}; {} binds at {}.",
      is_doubtful(best, limits) ? " at the mean soils, doubtful over their draws" : "",
      counted(result.candidates.size(), "verified path"), best_words(best),
      words(name(best.limiting.margin)),
      place(best.limiting.x_m, best.limiting.y_m, best.limiting.time_s));
}

std::string tie_sentence(const std::vector<Candidate>& ranked) {
  return tie_sentence(tied_ranks(ranked), [&](int rank) {
    const auto& spread = ranked.at(static_cast<std::size_t>(rank) - 1).spread;
    return spread && spread->draws > 0;
  });
}

std::string plan_report(const PlanningProblem& problem, const PlanResult& result) {
  const StartState& start = problem.start;
  const Goal& goal = problem.goal;
  return render(
      {.command = "plan",
       .title = fmt::format("Plan for {} from ({:.1f}, {:.1f}) to ({:.1f}, {:.1f})",
                            problem.vehicle.name, start.x_m, start.y_m, goal.x_m, goal.y_m),
       .headline = plan_headline(result, problem.limits),
       .lead = lead_sentences(result),
       .body_html = report_assets::kPlanHtml,
       .script = report_assets::kPlanScript,
       .data_json = json_for_html(plan_report_data(problem, result))});
}

}  // namespace regoplan
