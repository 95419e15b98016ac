#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "terramech/wheel_model.h"

/// Wheels on soils over which the laws of the wheel model are tested.
namespace regoplan::wheel_specs {

inline constexpr double kDegree = std::numbers::pi / 180;

struct NamedSpec {
  std::string name;
  WheelModelSpec spec;
  double nominal_load_n;
};

/// The authors' wheel on Lunar Regolith Simulant with their numbers of 2007.
inline WheelModelSpec ishigami2007() {
  return {.variant = WheelVariant::kIshigami2007,
          .wheel = {.radius_m = 0.09, .width_m = 0.10},
          .soil = {.cohesion_pa = 800,
                   .friction_angle_rad = 37.2 * kDegree,
                   .kc = 1.37e3,
                   .kphi = 8.14e5,
                   .n = 1,
                   .a0 = 0.40,
                   .a1 = 0.15,
                   .lambda = 0.9,
                   .density_kgpm3 = 1600,
                   .kx0_m = 0.036,
                   .kx1_m = 0.043,
                   .ky0_m = 0.013,
                   .ky1_m = 0.020}};
}

/// The paper's own Table I in consistent units.
inline WheelModelSpec yoshida2004() {
  return {.variant = WheelVariant::kYoshida2004,
          .wheel = {.radius_m = 0.09, .width_m = 0.10},
          .soil = {.cohesion_pa = 800,
                   .friction_angle_rad = 37.2 * kDegree,
                   .kc = 1.79e6,
                   .kphi = 1.95e6,
                   .n = 1,
                   .a0 = 0.40,
                   .a1 = 0.15,
                   .lambda = 0,
                   .density_kgpm3 = 1600,
                   .kx0_m = 0.004,
                   .ky0_m = 0.045,
                   .c0_m = 0.031}};
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
