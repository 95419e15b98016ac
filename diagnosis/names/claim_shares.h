#pragma once

#include <vector>

#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/scoring.h"
#include "diagnosis/names/calibrated_recording.h"

namespace regoplan {

/// Measures what each claim adds to those before it, without a remainder, and what each member of a
/// class would in its place. No share is measured where what is left of a misfit on held-out
/// conditions cannot be shared: the calibrated model does not exceed its noise there.
/// \param scored every candidate, from which claims are taken one by one
/// \param fit of all claims together
void measure_shares(const CalibratedRecording& calibrated, const std::vector<ScoredId>& scored,
                    const CandidateFit& fit, int threads, std::vector<Claim>& claims);

}  // namespace regoplan
