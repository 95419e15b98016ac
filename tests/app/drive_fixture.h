#pragma once

#include "app/drive/drive_files.h"

namespace regoplan {

/// A drive straight from the start to the goal of a problem, with something of everything: limits
/// broken, margins, sensors, a place where it ended. Made up; no physics.
DriveRecord made_up_drive(const PlanningProblem& problem, int rows);

}  // namespace regoplan
