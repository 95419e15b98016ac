#pragma once

#include "benchmarks/diagnosis/outcome.h"

namespace regoplan::challenge {

/// What simpler methods say of the same recording, each by itself:
/// - `calibration_only`: soil numbers within their priors, then a lack-of-fit F test at 1 %; never
///   names.
/// - `bic`: the same mechanisms as the diagnosis, one at a time, without a discrepancy; the lowest
///   Bayesian information criterion wins, probabilities are its weights.
/// - `residual_gp`: a Gaussian process on the residuals of the calibration; "unexplained" where its
///   evidence beats none by 3 nats; never names.
/// - `sparse_regression`: sequentially thresholded least squares of the residuals on products of
///   slip, slip angle and load (SINDy); "unexplained" where a term survives; never names.
/// Held-out figures leave out one slip angle at a time, or one band of slip where there are fewer
/// than three.
std::vector<Outcome> baseline_outcomes(const Recording& recording, const DiagnosisSetup& setup);

}  // namespace regoplan::challenge
