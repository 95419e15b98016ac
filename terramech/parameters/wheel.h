#pragma once

namespace regoplan {

/// A rigid cylindrical wheel.
struct Wheel {
  double radius_m = 0;
  double width_m = 0;
};

/// \throws ValueError naming the field that is not a positive finite length
void validate(const Wheel& wheel);

}  // namespace regoplan
