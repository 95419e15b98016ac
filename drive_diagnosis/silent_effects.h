#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drive_diagnosis/drive_diagnosis.h"

namespace regoplan {

/// Says what nobody should expect these drives to show, and the drive that would.
void say_what_is_silent(const DriveSetup& setup, const std::vector<DriveRecording>& drives,
                        DriveDiagnosis& result);

/// What comes nearest to a claim beside those made, where fewer than one of twenty sound drives
/// would show as much by chance; nothing where none does.
std::optional<std::string> nearest_text(const DriveDiagnosis& result);

}  // namespace regoplan
