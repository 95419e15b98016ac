#pragma once

#include <string>

#include "app/diagnose_drive/drive_diagnosis_files.h"

namespace regoplan {

/// The finding in one sentence.
std::string drive_diagnosis_headline(const DriveDiagnosisRun& run);

/// A diagnosis of drives for people: one self-contained HTML page.
std::string drive_diagnosis_report(const DriveDiagnosisRun& run);

}  // namespace regoplan
