#pragma once

#include <numbers>

namespace regoplan {

/// Radians in a degree.
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace regoplan
