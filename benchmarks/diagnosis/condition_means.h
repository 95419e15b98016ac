#pragma once

#include "benchmarks/diagnosis/soil_fit.h"

namespace regoplan::challenge {

/// Means over the replicates of each condition, with what the baselines need beside them.
struct ConditionMeans {
  std::vector<FitRow> rows;                   ///< sigma: of the mean
  std::vector<double> replicates;             ///< of each row
  std::array<double, kChannelCount> noise{};  ///< of one run, pooled over all replicates
  std::array<double, kChannelCount> noise_dof{};
};

/// Replicates: slip ratio within .01, slip angle within .5 deg, load within 15 %, all else equal.
ConditionMeans condition_means(const Recording& recording, const DiagnosisSetup& setup);

}  // namespace regoplan::challenge
