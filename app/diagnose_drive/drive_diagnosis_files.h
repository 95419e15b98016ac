#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/diagnose_drive/drive_setup.h"
#include "app/diagnose_drive/verdict_flips.h"
#include "app/io/staged_files.h"

namespace regoplan {

/// A diagnosis of drives with all that it came from.
struct DriveDiagnosisRun {
  std::string scenario_file;
  std::vector<std::string> drive_ids;  ///< in the order given
  std::vector<std::string> drive_files;
  std::vector<std::int64_t> drive_rows;
  DriveSetupFile setup;
  std::uint64_t seed = 1;
  std::string page = "report.html";  ///< name of its page
  DriveDiagnosis diagnosis;
  std::vector<VerdictFlip> verdicts;  ///< where there is a corrected map
};

/// What diagnosis.json holds; numbers that are not finite become null. Same input, same text.
nlohmann::ordered_json drive_diagnosis_content(const DriveDiagnosisRun& run);
std::string drive_diagnosis_json(const DriveDiagnosisRun& run);

/// What was compared window by window: of the currents and of the vehicle's model.
std::vector<const ComparedChannel*> compared_channels(const DriveDiagnosis& diagnosis);

/// The diagnosis in a few lines for a terminal.
std::string drive_diagnosis_summary(const DriveDiagnosisRun& run);

/// Writes diagnosis.json, windows.csv and the page, all or none.
/// \throws InputError where the folder takes no files
void write_drive_diagnosis_files(const DriveDiagnosisRun& run, const ResultFolder& folder);
std::vector<std::string> drive_diagnosis_file_names(const std::string& page);

}  // namespace regoplan
