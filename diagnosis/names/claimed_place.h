#pragma once

#include <vector>

#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/candidate_fit.h"

namespace regoplan {

/// Where the claims of a fit lie by what they say themselves, strongest first: the time in which
/// a drift or a gain that changes does at least half of what it does at most, the stretch of a soil
/// zone. The effect is what the claim adds there to the channel in which it shows most; its p_value
/// is that of so much by noise alone.
std::vector<MismatchRegion> claimed_places(const FitProblem& problem, const CandidateFit& fit);

}  // namespace regoplan
