#pragma once

#include "app/diagnose/diagnosis_files.h"

namespace regoplan {

/// A hand-made diagnosis of twelve runs with a claim, as files and report know it.
DiagnosisRun claimed_diagnosis();

/// The same runs, consistent with the model.
DiagnosisRun consistent_diagnosis();

/// The same runs, unexplained: the corrected model has a correction without a name.
DiagnosisRun unexplained_diagnosis();

/// The same runs, interrupted before there was a verdict.
DiagnosisRun interrupted_diagnosis();

}  // namespace regoplan
