#include "terramech/parameters/wheel.h"

#include <cmath>

#include "terramech/basics/input_error.h"

namespace regoplan {

void validate(const Wheel& wheel) {
  constexpr double kLargest_m = 100;
  for (const auto& [name, value] :
       {std::pair{"radius_m", wheel.radius_m}, std::pair{"width_m", wheel.width_m}}) {
    if (!(value > 0 && value <= kLargest_m)) throw ValueError(name, value, "above 0 to 100");
  }
}

}  // namespace regoplan
