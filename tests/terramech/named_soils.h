#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "terramech/parameters/vehicle.h"
#include "terramech/wheel/wheel_model.h"

/// The soils that the tests and benchmarks speak of by name, and those that come with the program.
namespace regoplan::named_soils {

inline constexpr double kRadian_deg = std::numbers::pi / 180;
inline constexpr double kMoon_mps2 = 1.62, kMars_mps2 = 3.72, kEarth_mps2 = 9.80665;

/// Lunar Regolith Simulant with its authors' numbers of 2007 (Ishigami et al., J. Field Robotics).
inline Soil simulant_2007() {
  return {.cohesion_pa = 800,
          .friction_angle_rad = 37.2 * kRadian_deg,
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
          .ky1_m = 0.020};
}

/// The same soil in Table I of Yoshida & Ishigami 2004, in consistent units.
inline Soil simulant_2004() {
  return {.cohesion_pa = 800,
          .friction_angle_rad = 37.2 * kRadian_deg,
          .kc = 1.79e6,
          .kphi = 1.95e6,
          .n = 1,
          .a0 = 0.40,
          .a1 = 0.15,
          .lambda = 0,
          .density_kgpm3 = 1600,
          .kx0_m = 0.004,
          .ky0_m = 0.045,
          .c0_m = 0.031};
}

/// A soil of the scenarios: what a0, a1, lambda, kx1 and ky1 are there is the simulant's.
struct ScenarioNumbers {
  double cohesion_pa, friction_angle_deg, kc, kphi, n, density_kgpm3, kx0_m, ky0_m;
};
inline Soil scenario_soil(const ScenarioNumbers& numbers) {
  Soil soil = simulant_2007();
  soil.cohesion_pa = numbers.cohesion_pa;
  soil.friction_angle_rad = numbers.friction_angle_deg * kRadian_deg;
  soil.kc = numbers.kc;
  soil.kphi = numbers.kphi;
  soil.n = numbers.n;
  soil.density_kgpm3 = numbers.density_kgpm3;
  soil.kx0_m = numbers.kx0_m;
  soil.ky0_m = numbers.ky0_m;
  return soil;
}

/// Regolith between craters, as the Apollo roving vehicles drove on (scenarios/demo).
inline Soil firm_regolith() {
  return scenario_soil({.cohesion_pa = 170,
                        .friction_angle_deg = 36,
                        .kc = 1400,
                        .kphi = 8.2e5,
                        .n = 1,
                        .density_kgpm3 = 1500,
                        .kx0_m = 0.018,
                        .ky0_m = 0.013});
}

/// Crater walls and ejecta (scenarios/demo).
inline Soil loose_regolith() {
  return scenario_soil({.cohesion_pa = 100,
                        .friction_angle_deg = 33,
                        .kc = 900,
                        .kphi = 4.5e5,
                        .n = 1,
                        .density_kgpm3 = 1350,
                        .kx0_m = 0.025,
                        .ky0_m = 0.018});
}

/// The weakest soil of the demo.
inline Soil soft_patch() {
  return scenario_soil({.cohesion_pa = 50,
                        .friction_angle_deg = 28,
                        .kc = 400,
                        .kphi = 1.2e5,
                        .n = 1,
                        .density_kgpm3 = 1250,
                        .kx0_m = 0.032,
                        .ky0_m = 0.025});
}

inline Soil martian_firm() {
  return scenario_soil({.cohesion_pa = 1500,
                        .friction_angle_deg = 36,
                        .kc = 1980,
                        .kphi = 3.06e6,
                        .n = 1.1,
                        .density_kgpm3 = 1500,
                        .kx0_m = 0.010,
                        .ky0_m = 0.013});
}

inline Soil martian_regolith() {
  return scenario_soil({.cohesion_pa = 1000,
                        .friction_angle_deg = 33,
                        .kc = 990,
                        .kphi = 1.528e6,
                        .n = 1.1,
                        .density_kgpm3 = 1400,
                        .kx0_m = 0.018,
                        .ky0_m = 0.013});
}

inline Soil martian_sand() {
  return scenario_soil({.cohesion_pa = 400,
                        .friction_angle_deg = 30,
                        .kc = 330,
                        .kphi = 5.1e5,
                        .n = 1.1,
                        .density_kgpm3 = 1300,
                        .kx0_m = 0.025,
                        .ky0_m = 0.013});
}

struct NamedSoil {
  std::string name;  ///< as in the scenario
  Soil soil;
  double gravity_mps2;
};

/// The soils of the scenarios, on the ground they belong to, and the simulant on Earth.
/// SoilSettings.TheSoilsOfTheTestsAreThoseOfTheScenarios compares them with the files.
inline std::vector<NamedSoil> shipped() {
  return {{"firm_regolith", firm_regolith(), kMoon_mps2},
          {"loose_regolith", loose_regolith(), kMoon_mps2},
          {"soft_patch", soft_patch(), kMoon_mps2},
          {"firm", martian_firm(), kMars_mps2},
          {"regolith", martian_regolith(), kMars_mps2},
          {"sand", martian_sand(), kMars_mps2},
          {"simulant", simulant_2007(), kEarth_mps2}};
}

/// The gravity that a preset was built for.
inline double home_gravity_mps2(const std::string& preset) {
  return preset == "lrv" ? kMoon_mps2 : preset == "curiosity" ? kMars_mps2 : kEarth_mps2;
}

struct NamedPair {
  std::string name;
  WheelModelSpec spec;
  double nominal_load_n;  ///< the vehicle's weight over its wheels
};

/// The wheel of every preset on every soil, where that lies.
inline std::vector<NamedPair> shipped_pairs() {
  std::vector<NamedPair> pairs;
  for (const NamedSoil& on : shipped()) {
    for (const std::string& preset : preset_vehicle_names()) {
      const Vehicle vehicle = preset_vehicle(preset);
      pairs.push_back(
          {.name = preset + " on " + on.name,
           .spec = {.wheel = vehicle.wheel, .soil = on.soil, .gravity_mps2 = on.gravity_mps2},
           .nominal_load_n =
               vehicle.mass_kg * on.gravity_mps2 / static_cast<double>(vehicle.wheels.size())});
    }
  }
  return pairs;
}

}  // namespace regoplan::named_soils
