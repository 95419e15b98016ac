#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command/command.h"
#include "app/io/staged_files.h"

namespace regoplan {

/// What `diagnose` is told of whole drives.
struct DriveDiagnosisCommand {
  std::vector<std::string> drives;
  std::string scenario;
  std::optional<std::string> setup;
  std::optional<std::string> columns;
  ResultFolder folder;
  std::uint64_t seed = 1;
  int threads = 2;
  bool json = false;
  bool quiet = false;
};

/// Diagnoses whole drives on the map of a scenario.
/// \returns 0: consistent or explained
ExitStatus run_drive_diagnosis(const DriveDiagnosisCommand& command);

}  // namespace regoplan
