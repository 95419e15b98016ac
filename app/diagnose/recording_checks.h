#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/diagnose/recording_file.h"
#include "diagnosis/diagnosis.h"

namespace regoplan {

/// Holds a recording against the wheel model at the prior means by size and sign only: units that
/// are off by a power of ten, loads in kilograms, slip angles in radians, axes turned round, dead
/// channels. What no physics can give throws; what is merely odd comes back, a sentence each.
///
/// Sizes are those of nine tenths of the values: forces over the load, torque over load and radius
/// above 3 or below 0.002; sinkage and ruts above the radius or below a thousandth of it. Real
/// soils lie between by factors of five and more.
/// \throws InputError naming file, line, column, value, range and the unit that is suspected
std::vector<std::string> doubtful_values(const RecordingFile& recording,
                                         const DiagnosisSetup& setup);

/// Leaves out channels with fewer than four values, the rest empty, whose noise the setup does not
/// tell: the recording is judged by the others. \returns what is told of each
/// \throws InputError where no channel is left
std::vector<std::string> leave_out_nearly_empty(RecordingFile& recording,
                                                const DiagnosisSetup& setup);

/// Leaves out forces and torque where two of them and more follow the model divided by what a
/// kilogram weighs: whatever physics would be said to be missing would be that of a unit. One alone
/// stays, as an amplifier on another range would do that. \returns what is told of it
/// \throws InputError where no channel is left
std::optional<std::string> leave_out_kilograms(RecordingFile& recording,
                                               const DiagnosisSetup& setup);

}  // namespace regoplan
