#pragma once

#include <vector>

#include "diagnosis/diagnosis.h"

namespace regoplan {

/// What the base model lacks in both is shared; only the difference is diagnosed. A claim must hold
/// with the soil at the prior means, calibrated on the reference, and with the reference's sinkage
/// imposed (SharedBase). `consistent`: no difference beyond noise. `fit` and `share_explained` are
/// of the difference: `calibrated_rmse` is what the base model with the shared shortcomings leaves.
/// Test and references may be of different wheels (their setups say which).
/// \throws InputError for a recording with fewer than 3 conditions, or where test and references
/// have no channel in common
Diagnosis diagnose_difference(const Recording& test, const DiagnosisSetup& setup,
                              const std::vector<Reference>& references,
                              const DiagnosisOptions& options = {});

}  // namespace regoplan
