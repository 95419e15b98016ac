#pragma once

#include <string>
#include <vector>

#include "diagnosis/bed/condensed_recording.h"

namespace regoplan {

/// What no soil can do, whatever its numbers: Fx, torque and sinkage that differ between slip
/// angles of opposite sign, a side force straight ahead, more drawbar power than the axle gives
/// (T w < Fx v). A sentence for each that the noise does not explain.
std::vector<std::string> instrument_checks(const CondensedRecording& recording);

}  // namespace regoplan
