#pragma once

#include <optional>

#include "drive_diagnosis/recording/drive_recording.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Tells of a drive whose positions do not go as far in its time as something else says that it
/// drove: its rims, where the vehicle is known and wheel speeds are recorded, or else its sensor of
/// speed. Such a drive has its time or its positions in another unit (milliseconds, kilometres,
/// feet). Held against each other over stretches of the drive. Slip and bends make positions go
/// less far, down to a vehicle that is stuck: less is suspected only where it is about a
/// thousandth, a millionth or a thousandth of a millionth, the same on nearly all stretches, and
/// beyond what fixes scatter by. More is suspected from 2.5 times on: speeds in knots make 1.9.
/// \param drive as it was read: mending positions takes what moves too fast for an error of a fix
std::optional<DriveFinding> doubtful_track_unit(const DriveRecording& drive,
                                                const Vehicle* vehicle);

/// Takes the samples out of a drive that cannot be used; it has no windows then.
void leave_samples_out(DriveRecording& drive);

}  // namespace regoplan
