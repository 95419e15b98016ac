#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/diagnose_drive/drive_diagnosis_files.h"

namespace regoplan {

/// The finding in one sentence.
std::string drive_diagnosis_headline(const DriveDiagnosisRun& run);

/// Why nothing could be decided and the drive that would decide, in two sentences; nothing where
/// something was decided.
std::optional<std::string> what_would_decide(const DriveDiagnosis& diagnosis);

/// Of each soil that was driven on and is not handed back, why it stays as the map has it.
std::vector<std::string> withheld_texts(const DriveDiagnosisRun& run);

/// A diagnosis of drives for people: one self-contained HTML page.
std::string drive_diagnosis_report(const DriveDiagnosisRun& run);

}  // namespace regoplan
