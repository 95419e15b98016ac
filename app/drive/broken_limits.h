#pragma once

#include <nlohmann/json.hpp>

#include "driving/drive.h"
#include "planner/problem/limits.h"

namespace regoplan {

/// The largest number of the wheels by magnitude, signed; NaN where the wheels are not known.
double largest_of_wheels(const DriveMoment& moment, double WheelNow::*number);

/// The places of a drive where limits were broken, as maps of reports mark them: of each stretch
/// the worst row, and where the drive ended, if that was not where it should.
nlohmann::json broken_limits_json(const Limits& limits, const DriveResult& result);

}  // namespace regoplan
