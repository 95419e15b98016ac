#pragma once

#include <chrono>
#include <optional>

#include "app/command/command.h"
#include "app/io/staged_files.h"
#include "app/settings/earlier_plan.h"
#include "app/settings/scenario_settings.h"

namespace regoplan {

struct PlanOutput {
  ResultFolder folder;
  bool json = false;                      ///< plan.json to standard output as well
  std::optional<EarlierPlan> again = {};  ///< the plan that this one repeats
  bool quiet = false;                     ///< neither notices, progress nor the table of candidates
  /// Since when the time of an answer is counted; nothing: since the program started.
  std::optional<std::chrono::steady_clock::time_point> started = {};
};

struct PlanRun {
  ExitStatus status = kNo;
  PlanResult result;
};

/// Plans, shows progress, writes the result files and prints what came out.
/// \throws InputError
PlanRun run_plan(const Scenario& scenario, const PlanOutput& output);

}  // namespace regoplan
