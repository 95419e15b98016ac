#pragma once

#include <string>
#include <vector>

#include "diagnosis/fit/scoring.h"
#include "diagnosis/names/calibrated_recording.h"

namespace regoplan {

/// Names, of physics and of sensors, without which a soil number would have to lie far from its
/// tests (3 prior standard deviations), and that do as well with that number near to them: at most
/// three, the likeliest first. Where no number lies so far, names that gain more over other soil
/// numbers than names do by chance, and were not proven.
std::vector<std::string> suspects_of(const CalibratedRecording& calibrated,
                                     const std::vector<ScoredId>& scored);

}  // namespace regoplan
