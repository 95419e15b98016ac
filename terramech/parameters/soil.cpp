#include "terramech/parameters/soil.h"

#include <fmt/format.h>

#include <cmath>

#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

bool in_range(const SoilParameter& parameter, double file_value) {
  return std::isfinite(file_value) && file_value <= parameter.max &&
         (parameter.min_excluded ? file_value > parameter.min : file_value >= parameter.min);
}

bool maximum_stress_angle_stays_inside(const Soil& soil) {
  return soil.a0 - std::abs(soil.a1) > 0 && soil.a0 + std::abs(soil.a1) < 1;
}

}  // namespace

const std::array<SoilParameter, 14>& soil_parameters() {
  static const std::array<SoilParameter, 14> parameters{{
      {"cohesion_pa", &Soil::cohesion_pa, 1, 0, 1e6, false, false},
      {"friction_angle_deg", &Soil::friction_angle_rad, kDegree, 0, 60, false, false},
      {"kc", &Soil::kc, 1, -1e9, 1e9, false, false},
      {"kphi", &Soil::kphi, 1, 0, 1e12, true, false},
      {"n", &Soil::n, 1, 0.3, 2, false, false},
      {"a0", &Soil::a0, 1, 0, 1, true, false},
      {"a1", &Soil::a1, 1, -1, 1, false, false},
      {"lambda", &Soil::lambda, 1, 0, 1.5, false, false},
      {"density_kgpm3", &Soil::density_kgpm3, 1, 0, 10000, true, false},
      {"kx0_m", &Soil::kx0_m, 1, 0, 10, true, false},
      {"kx1_m", &Soil::kx1_m, 1, 0, 10, false, true},
      {"ky0_m", &Soil::ky0_m, 1, 0, 10, true, false},
      {"ky1_m", &Soil::ky1_m, 1, 0, 10, false, true},
      {"c0_m", &Soil::c0_m, 1, 0, 10, false, true},
  }};
  return parameters;
}

void validate(const Soil& soil) {
  for (const SoilParameter& parameter : soil_parameters()) {
    const double value = soil.*parameter.member / parameter.file_unit;
    if (!in_range(parameter, value)) {
      throw ValueError(std::string(parameter.name), value,
                       fmt::format("{}{} to {}", parameter.min_excluded ? "above " : "",
                                   parameter.min, parameter.max));
    }
  }
  if (!maximum_stress_angle_stays_inside(soil)) {
    throw ValueError("a1", soil.a1, "0 < a0 + a1 s < 1 for every slip s from -1 to 1");
  }
}

bool is_valid(const Soil& soil) {
  try {
    validate(soil);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool resists_sinkage(const Soil& soil, double wheel_width_m) {
  return soil.kc / wheel_width_m + soil.kphi > 0;
}

Soil draw(const UncertainSoil& soil, double wheel_width_m, std::mt19937_64& random) {
  Soil drawn = soil.mean;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    for (const SoilParameter& parameter : soil_parameters()) {
      const double mean = soil.mean.*parameter.member;
      const double deviation = soil.standard_deviation.*parameter.member;
      double& value = drawn.*parameter.member;
      value = mean;
      if (deviation == 0) continue;
      std::normal_distribution<double> normal(mean, deviation);
      for (int i = 0; i < 1000; ++i) {
        value = normal(random);
        if (in_range(parameter, value / parameter.file_unit)) break;
      }
    }
    if (maximum_stress_angle_stays_inside(drawn) && resists_sinkage(drawn, wheel_width_m)) {
      validate(drawn);
      return drawn;
    }
  }
  throw InputError(
      "a0, a1, kc, kphi: 1000 draws of the soil all leave 0 < a0 + a1 s < 1 or kc/width_m + kphi "
      "above 0");
}

}  // namespace regoplan
