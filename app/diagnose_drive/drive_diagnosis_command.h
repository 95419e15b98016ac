#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command/command.h"
#include "app/diagnose_drive/drive_diagnosis_files.h"
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
  std::string page = "report.html";  ///< name of the page in the folder
  bool json = false;
  bool quiet = false;
};

/// Reads the drives and diagnoses them on the map of a scenario; tells what was found in them.
DriveDiagnosisRun diagnosed(const DriveDiagnosisCommand& command);

/// Writes what came of it, with the corrected map where there is one.
void write_drive_diagnosis(const DriveDiagnosisRun& run, const ResultFolder& folder);

/// Diagnoses whole drives on the map of a scenario.
/// \returns 0: consistent or explained
ExitStatus run_drive_diagnosis(const DriveDiagnosisCommand& command);

}  // namespace regoplan
