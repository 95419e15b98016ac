#pragma once

#include "planner/evaluation/path_tracking.h"
#include "planner/evaluation/spot_turn.h"

namespace regoplan {

/// What one evaluation takes on. Whoever makes a course checks it against these before anything is
/// allocated for its stations or driven.
inline constexpr double kCourseLengthMax_m = 5e4;  ///< a hundred thousand stations
inline constexpr double kDriveStepsMax = 1e6;

/// How many steps driving takes at the commanded speeds; not finite where it never ends.
double drive_steps(const ReferencePath& path);
double drive_steps(const SpotTurn& turn, const Vehicle& vehicle);

/// The longest time that driving may take at this top speed.
double drive_time_max_s(double speed_max_mps);

}  // namespace regoplan
