#pragma once

#include "terramech/basics/value_range.h"

namespace regoplan {

/// Of any body's surface, with room for centrifuges; what lies beyond is a slip of the pen.
inline constexpr ValueRange kGravity_mps2{.min = 0, .max = 100, .min_excluded = true};

}  // namespace regoplan
