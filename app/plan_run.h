#pragma once

#include "app/command.h"
#include "app/scenario_settings.h"
#include "app/staged_files.h"

namespace regoplan {

struct PlanOutput {
  ResultFolder folder;
  bool json = false;   ///< plan.json to standard output as well
  bool quiet = false;  ///< neither notices, progress nor the table of candidates
};

/// Plans, shows progress, writes the result files and prints what came out.
/// \throws InputError
ExitStatus run_plan(const Scenario& scenario, const PlanOutput& output);

}  // namespace regoplan
