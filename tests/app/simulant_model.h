#pragma once

namespace regoplan {

/// A model file: the lunar simulant and wheel of Ishigami et al. 2007.
inline constexpr const char* kSimulantModel = R"(model: ishigami2007
wheel: {radius_m: 0.09, width_m: 0.10}
gravity_mps2: 9.80665
soil_name: simulant
soil:
  cohesion_pa: 800
  friction_angle_deg: 37.2
  kc: 1.37e3
  kphi: 8.14e5
  n: 1
  a0: .40
  a1: .15
  lambda: .9
  density_kgpm3: 1600
  kx0_m: .036
  kx1_m: .043
  ky0_m: .013
  ky1_m: .020
mechanisms: []
)";

}  // namespace regoplan
