#pragma once

#include "app/diagnose/recording_file.h"

namespace regoplan {

/// Whether two recordings hold the same runs, in whatever order their rows and columns stand, and
/// under whatever names.
bool are_same_runs(const RecordingFile& a, const RecordingFile& b);

}  // namespace regoplan
