#pragma once

#include <string>

#include "app/diagnose/diagnosis_files.h"

namespace regoplan {

/// The finding in one sentence; the verdict in words where the diagnosis was interrupted before it
/// had one.
std::string diagnosis_headline(const DiagnosisRun& run);

/// A diagnosis for people: one self-contained HTML page from the finding down to the numbers:
/// where model and recording differ, maps of the residuals before and after, curves on held-out
/// runs, candidates, soil numbers, fit, the next experiment.
std::string diagnosis_report(const DiagnosisRun& run);

}  // namespace regoplan
