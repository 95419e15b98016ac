#pragma once

#include <optional>
#include <string>

#include "app/diagnose/recording_file.h"

namespace regoplan {

/// Leaves out runs that repeat an earlier one under another name: load, slip, slip angle, pass,
/// speed and every measured value are the same number. As replicates they would tell less noise
/// than there is. Two channels and more have to say so with three significant digits, and more
/// often than channels agree by themselves: what sensors of few steps read alike are replicates.
/// \returns what is told of it
std::optional<std::string> leave_out_copies(RecordingFile& file);

}  // namespace regoplan
