#pragma once

#include <string>
#include <vector>

#include "terramech/basics/angles.h"
#include "terramech/wheel/wheel_model.h"
#include "tests/terramech/named_soils.h"

/// Wheels on soils over which the laws of the wheel model are tested.
namespace regoplan::wheel_specs {

struct NamedSpec {
  std::string name;
  WheelModelSpec spec;
  double nominal_load_n;
};

/// The wheel of the authors' tests.
inline constexpr Wheel kTestWheel{.radius_m = 0.09, .width_m = 0.10};

inline WheelModelSpec ishigami2007() {
  return {.variant = WheelVariant::kIshigami2007,
          .wheel = kTestWheel,
          .soil = named_soils::simulant_2007()};
}

inline WheelModelSpec yoshida2004() {
  return {.variant = WheelVariant::kYoshida2004,
          .wheel = kTestWheel,
          .soil = named_soils::simulant_2004()};
}

inline WheelModelSpec with_exponent(WheelModelSpec spec, double n, double kphi, double lambda) {
  spec.soil.n = n;
  spec.soil.kc = 0;
  spec.soil.kphi = kphi;
  spec.soil.lambda = lambda;
  return spec;
}

/// A wheel of about the size of the Apollo rover's on numbers typical of lunar soil.
inline WheelModelSpec lunar_rover() {
  return {.variant = WheelVariant::kIshigami2007,
          .wheel = {.radius_m = 0.41, .width_m = 0.23},
          .soil = {.cohesion_pa = 170,
                   .friction_angle_rad = 35 * kDegree,
                   .kc = 1400,
                   .kphi = 8.2e5,
                   .n = 1,
                   .a0 = 0.40,
                   .a1 = 0.15,
                   .lambda = 0.1,
                   .density_kgpm3 = 1600,
                   .kx0_m = 0.018,
                   .ky0_m = 0.018},
          .gravity_mps2 = 1.62};
}

/// Both variants, over the range of the sinkage exponent and of the rear contact.
inline std::vector<NamedSpec> all() {
  const WheelModelSpec base = ishigami2007();
  return {{"ishigami2007", base, 60},
          {"n=0.3", with_exponent(base, 0.3, 4e4, 0.5), 60},
          {"n=0.5", with_exponent(base, 0.5, 9.969e4, 0), 60},
          {"n=0.8", with_exponent(base, 0.8, 3e5, 1.5), 60},
          {"n=2", with_exponent(base, 2, 1e8, 0.9), 60},
          {"lunar_rover", lunar_rover(), 290},
          {"yoshida2004", yoshida2004(), 64.7},
          {"yoshida2004 n=0.5", with_exponent(yoshida2004(), 0.5, 4e6, 0), 64.7}};
}

}  // namespace regoplan::wheel_specs
