#pragma once

#include <optional>
#include <vector>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/recording/run_scatter.h"

namespace regoplan {

/// Scatter of one run, as the difference of two recordings at like conditions tells it: what a
/// surface of second order in slip ratio and slip angle, of first in the logarithm of the load,
/// leaves of it. What the model leaves out of both cancels in the difference, which the scatter
/// between neighbouring conditions of either counts as noise; what differs and is no such surface
/// is counted, so it errs on the cautious side. Conditions are alike where the root of the summed
/// squares of their distances in slip ratio over 0.03, slip angle over 0.03 rad and logarithm of
/// the load over 0.1 is below 1, and pass and speed are the same. Each run is of one pair at most.
/// \return by channel of both beds; nothing with fewer than 6 pairs beyond what the surface takes
std::vector<std::optional<RunScatter>> scatter_of_difference(const CondensedRecording& test,
                                                             const CondensedRecording& reference);

}  // namespace regoplan
