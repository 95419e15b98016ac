#pragma once

#include <vector>

#include "diagnosis/names/calibrated_recording.h"

namespace regoplan {

/// Of every run from what test and references share, and what a fit makes of it.
std::vector<RunDifference> run_differences(const CalibratedRecording& calibrated,
                                           const CandidateFit& fit);

}  // namespace regoplan
