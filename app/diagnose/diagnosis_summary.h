#pragma once

#include <string>

#include "app/diagnose/diagnosis_files.h"

namespace regoplan {

/// A diagnosis on a terminal: the finding, where, how likely what, how the fit improves, what to
/// measure next.
std::string diagnosis_summary(const DiagnosisRun& run);

}  // namespace regoplan
