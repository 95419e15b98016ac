#pragma once

#include "diagnosis/fit/candidate_fit.h"
#include "terramech/mechanisms/generic_correction.h"

namespace regoplan {

/// Settings of a discrepancy that describe what a fit leaves: the same scales in every channel, and
/// per channel the likeliest amplitude. Sides are mirrored: what is handed on is for level soil.
std::vector<std::size_t> remainder_settings(const FitProblem& problem, const CandidateFit& fit);

/// The mean of that discrepancy as a sum of bumps, one a condition.
/// \param share per channel, of what the mean gives
GenericCorrection unnamed_correction(const FitProblem& problem, const CandidateFit& fit,
                                     const std::vector<std::size_t>& settings,
                                     const std::vector<double>& share);

}  // namespace regoplan
