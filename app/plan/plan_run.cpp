#include "app/plan/plan_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>

#include "app/command/kept_page_notice.h"
#include "app/command/progress_line.h"
#include "app/io/interrupt.h"
#include "app/io/quantity_text.h"
#include "app/plan/plan_files.h"
#include "app/plan/plan_report.h"
#include "planner/plan.h"

namespace regoplan {
namespace {

/// The time of an answer is counted from here, the reading of the map included.
const std::chrono::steady_clock::time_point kProgramStart = std::chrono::steady_clock::now();

/// A path at once, before anything is ranked.
std::string verified_line(const Candidate& candidate, double since_start_s) {
  return fmt::format("after {:.1f} s: verified {}path of {}, {:.1f} m in {:.1f} s, margin {:.3f}\n",
                     since_start_s, candidate.improvement ? "improved " : "", candidate.planner,
                     candidate.length_m, candidate.duration_s, candidate.margin_min);
}

std::string candidate_row(const Candidate& candidate) {
  const auto& spread = candidate.spread;
  return fmt::format(
      "{:>4} {:>12} {:>9.1f} {:>10.1f} {:>9} {:>10} {:>10.3f} {:>11} {:>9}\n", candidate.rank,
      candidate.planner, candidate.length_m, candidate.duration_s, energy_text(candidate.energy_j),
      spread ? fmt::format("{:.3f}", spread->p05) : std::string(kNotKnown), candidate.margin_min,
      name(candidate.limiting.margin),
      !spread ? std::string(kNotKnown)
      : spread->draws == 0
          ? "no need"
          : fmt::format("{:.0f}/{}", spread->feasible.share * spread->draws, spread->draws));
}

/// Where the time before the search went, where that is more than a tenth of what the answer may
/// take: else empty.
std::string before_search_line(const PlanResult& result, const Search& search) {
  constexpr double kShare = 0.1;
  double whole_s = 0;
  std::vector<std::string> steps;
  for (const TimedStep& timed : result.before_search) {
    whole_s += timed.time_s;
    steps.push_back(fmt::format("{} {:.1f} s", timed.step, timed.time_s));
  }
  if (!search.time_s || whole_s <= kShare * *search.time_s) return "";
  return fmt::format("Of {:g} s, {:.1f} s went before the search: {}.\n", *search.time_s, whole_s,
                     fmt::join(steps, ", "));
}

/// That the planner that was asked for found nothing that counts; else empty.
std::string other_planner_line(const PlanResult& result, const Search& search) {
  if (result.candidates.empty() || search.planner == "auto") return "";
  const std::string& planner = result.candidates.front().planner;
  if (planner == search.planner) return "";
  return fmt::format("The searches by {} found none; a brief one by {} did.\n", search.planner,
                     planner);
}

std::string summary(const PlanResult& result, const PlanningProblem& problem) {
  std::string text = plan_headline(result, problem.limits) + "\n";
  if (result.interrupted) text = "Interrupted. " + text;
  text += other_planner_line(result, problem.search);
  text += before_search_line(result, problem.search);
  if (const auto gap = duration_gap(result)) {
    text += fmt::format(
        "No path of this problem is faster than {:.1f} s; gap of the fastest: {:.0f} %.\n",
        *result.least_duration_s, 100 * *gap);
  }
  if (!result.candidates.empty()) {
    text += fmt::format("{:>4} {:>12} {:>9} {:>10} {:>9} {:>10} {:>10} {:>11} {:>9}\n", "rank",
                        "planner", "length_m", "duration_s", "energy", "margin_p05", "margin_min",
                        "limited by", "draws ok");
  }
  for (const Candidate& candidate : result.candidates) text += candidate_row(candidate);
  if (const std::string ties = tie_sentence(result.candidates); !ties.empty()) text += ties + "\n";
  std::string rejected;
  for (int i = 0; i < kRejectionCount; ++i) {
    const auto count = result.rejected.at(static_cast<std::size_t>(i));
    if (count == 0) continue;
    rejected += fmt::format("{}{} {}", rejected.empty() ? "" : ", ",
                            name(static_cast<Rejection>(i)), count);
  }
  return text + fmt::format("rejected states: {}\n", rejected.empty() ? "none" : rejected);
}

std::string again_notice(const PlanOrigin& origin) {
  const std::vector<std::string> changed = changes_since(*origin.again, origin.inputs);
  return fmt::format("repeats {}: {}", origin.again->file.string(),
                     changed.empty()
                         ? "its inputs are as they were"
                         : fmt::format("changed since then: {}", fmt::join(changed, ", ")));
}

/// The rasters of a plan with paths that its time did not suffice for; empty where all are there.
std::string missing_rasters_notice(const PlanResult& result) {
  if (result.interrupted || result.candidates.empty()) return "";
  if (result.rasters && !result.rasters->probability.empty()) return "";
  return fmt::format(
      "no time was left for {}: more time (--time, planner.time_s) makes them",
      result.rasters ? "probability.tif" : "margin.tif, supply.tif and probability.tif");
}

ExitStatus status_of(const PlanResult& result) {
  if (result.interrupted) return kInterrupted;
  return result.status == PlanStatus::kFeasible ? kYes : kNo;
}

}  // namespace

PlanRun run_plan(const Scenario& scenario, const PlanOutput& output) {
  require_results_fit(output.folder, plan_file_names(scenario.problem));
  notify_of_kept_page(output.folder, "plan", output.quiet);
  for (const std::string& notice : scenario.notices) notify(notice, output.quiet);
  const PlanOrigin origin{.inputs = digests_of(scenario.inputs), .again = output.again};
  if (origin.again) notify(again_notice(origin), output.quiet);
  ProgressLine line(output.quiet);
  const auto say = [&](const std::string& text) {
    if (output.quiet || output.json) return;
    line.wipe();
    fmt::print("{}", text);
    std::fflush(stdout);
  };
  PlanResult result =
      plan(scenario.problem,
           {.on_progress = [&](const PlanProgress& progress) { line.show(progress); },
            .on_verified = [&](const Candidate& path,
                               double since_start_s) { say(verified_line(path, since_start_s)); },
            .on_answer = [&](const PlanResult& answer) { say(summary(answer, scenario.problem)); },
            .stop = stop_on_interrupt(),
            .started = output.started.value_or(kProgramStart)});
  line.wipe();
  write_plan_files(scenario.problem, result, output.folder, origin);
  if (output.json) {
    fmt::print("{}", plan_json(scenario.problem, result, origin, output.folder.path));
  }
  const std::string missing = missing_rasters_notice(result);
  if (!missing.empty()) notify(missing, output.quiet);
  say(fmt::format("report: {}\n", (output.folder.path / "report.html").string()));
  const ExitStatus status = status_of(result);
  return {.status = status, .result = std::move(result)};
}

}  // namespace regoplan
