#pragma once

#include <string>

#include "diagnosis/findings/findings.h"

namespace regoplan {

/// The unit that a channel may have been told in, where a `sensor_gain` is that unit's factor, as
/// "lbf"; empty where it is none's. It is met within 3 %, by a gain that is known to 5 % of it.
std::string unit_of_gain(const Claim& claim);

}  // namespace regoplan
