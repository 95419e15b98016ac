#include "app/plan_run.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/interrupt.h"
#include "app/plan_files.h"
#include "app/plan_report.h"
#include "app/progress_line.h"
#include "planner/plan.h"

namespace regoplan {
namespace {

std::string summary(const PlanResult& result) {
  std::string text = plan_headline(result) + "\n";
  if (result.certificate) text += "certificate: " + *result.certificate + "\n";
  if (!result.candidates.empty()) {
    text += fmt::format("{:>4} {:>8} {:>9} {:>9} {:>10} {:>10} {:>10} {:>11} {:>8}\n", "rank",
                        "planner", "length_m", "duration_s", "energy_kj", "margin_min",
                        "margin_p05", "limited by", "feasible");
  }
  for (const Candidate& candidate : result.candidates) {
    text += fmt::format(
        "{:>4} {:>8} {:>9.1f} {:>10.1f} {:>9.1f} {:>10.3f} {:>10.3f} {:>11} {:>7.0f}%\n",
        candidate.rank, candidate.planner, candidate.length_m, candidate.duration_s,
        candidate.energy_j / 1000, candidate.margin_min, candidate.margin_p05,
        name(candidate.limiting.margin), 100 * candidate.probability_feasible);
  }
  std::string rejected;
  for (int i = 0; i < kRejectionCount; ++i) {
    const auto count = result.rejected.at(static_cast<std::size_t>(i));
    if (count == 0) continue;
    rejected += fmt::format("{}{} {}", rejected.empty() ? "" : ", ",
                            name(static_cast<Rejection>(i)), count);
  }
  return text + fmt::format("rejected states: {}\n", rejected.empty() ? "none" : rejected);
}

ExitStatus status_of(const PlanResult& result) {
  if (result.interrupted) return kInterrupted;
  return result.status == PlanStatus::kFeasible ? kYes : kNo;
}

}  // namespace

ExitStatus run_plan(const Scenario& scenario, const PlanOutput& output) {
  require_writable_folder(output.folder);
  for (const std::string& notice : scenario.notices) notify(notice, output.quiet);
  const std::stop_token stop = stop_on_interrupt();
  PlanResult result;
  {
    ProgressLine line(output.quiet);
    result = plan(
        scenario.problem, [&line](const PlanProgress& progress) { line.show(progress); }, stop);
  }
  write_plan_files(scenario.problem, result, output.folder);
  if (output.json) {
    fmt::print("{}", plan_json(scenario.problem, result));
  } else if (!output.quiet) {
    fmt::print("{}report: {}\n", summary(result), (output.folder / "report.html").string());
  }
  return status_of(result);
}

}  // namespace regoplan
