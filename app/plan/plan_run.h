#pragma once

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
};

/// Plans, shows progress, writes the result files and prints what came out.
/// \throws InputError
ExitStatus run_plan(const Scenario& scenario, const PlanOutput& output);

}  // namespace regoplan
