#pragma once

#include <string>
#include <vector>

#include "app/diagnose/modelled_recording.h"

namespace regoplan {

/// Axes turned round: a sentence for each force or torque that opposes the model wherever that is
/// clear.
/// \throws InputError for sinkage above the soil, and for a slip ratio of the other sign
std::vector<std::string> doubtful_signs(const ModelledRecording& recording);

}  // namespace regoplan
