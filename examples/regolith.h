#pragma once

#include <numbers>

#include "terramech/parameters/soil.h"

/// Firm lunar regolith, as the numbers of a soil are given: SI units and radians.
inline regoplan::Soil firm_regolith() {
  return {.cohesion_pa = 170,
          .friction_angle_rad = 35 * std::numbers::pi / 180,
          .kc = 1400,
          .kphi = 8.2e5,
          .n = 1,
          .a0 = 0.40,
          .a1 = 0.15,
          .lambda = 0.9,
          .density_kgpm3 = 1600,
          .kx0_m = 0.018,
          .ky0_m = 0.013,
          .ky1_m = 0.020};
}
