#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command/command.h"
#include "app/io/staged_files.h"
#include "app/settings/scenario_settings.h"

namespace regoplan {

/// What shall be evaluated, and where the results go.
struct EvaluationRequest {
  std::vector<std::string> path_files;
  std::optional<std::string> manoeuvre_file;
  std::optional<double> speed_mps;  ///< in place of the scenario's largest
  std::optional<double> deviation_max_m;
  std::optional<std::string> follower;  ///< one of `follower_names()`; else `compensated`
  int soil_draws = 1000;
  ResultFolder folder;
  bool json = false;   ///< evaluation.json to standard output as well
  bool quiet = false;  ///< neither notices, progress nor the table
};

/// Evaluates, shows progress, writes the result files and prints what came out.
/// \throws InputError
ExitStatus run_evaluation(const Scenario& scenario, const EvaluationRequest& request);

}  // namespace regoplan
