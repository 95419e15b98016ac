#pragma once

#include <array>
#include <vector>

#include "benchmarks/diagnosis/challenge.h"
#include "benchmarks/diagnosis/outcome.h"

namespace regoplan::challenge {

/// One claim against the truth.
struct ScoredClaim {
  double probability = 0;
  bool right = false;  ///< its class contains a cause that no claim before it has named
};

/// One outcome against its truth.
struct Score {
  bool silent = false;          ///< consistent or parameters: no missing physics
  bool is_parameters = false;   ///< the verdict `parameters`
  bool unexplained = false;     ///< the verdict `unexplained`
  bool right = false;           ///< every cause in a claim of its own, and no claim without a cause
  bool exact = false;           ///< right, and each claim a single name
  bool all_causes = false;      ///< every cause in a claim of its own, whatever else is claimed
  bool wrong_name = false;      ///< a claim without a cause
  bool called_physics = false;  ///< a claim of which no id is an instrument's or accepted
  std::vector<ScoredClaim> claims;
  bool located = false;            ///< a region that begins at 8 deg of slip angle or beyond
  bool located_in_course = false;  ///< a region in time, order of the runs or place
  bool asks_for_ruts = false;      ///< a next experiment with rut depths
  /// Held-out root mean square error over the noise floor, the worst channel; NaN where not given.
  double corrected_ratio = 0, calibrated_ratio = 0;
  /// In some channel the corrected model predicts held-out runs worse than the calibrated one by
  /// more than two standard errors, of an RMSE over n rows taken as RMSE/sqrt(2 n).
  bool worse_than_calibrated = false;
};

Score score(const Truth& truth, const Outcome& outcome);

/// Wilson's interval of a share at 95 %; {0, 1} for no trials.
std::array<double, 2> wilson(int successes, int trials);

}  // namespace regoplan::challenge
