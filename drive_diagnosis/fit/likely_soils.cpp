#include "drive_diagnosis/fit/likely_soils.h"

#include <cmath>

#include "terramech/basics/angles.h"

namespace regoplan {

std::vector<LikelySoil> likely_soils(const TerrainMap& map, const std::vector<bool>& driven_on) {
  std::vector<LikelySoil> likely;
  const std::vector<MapSoil>& soils = map.soils();
  for (std::size_t here = 0; here < soils.size(); ++here) {
    if (!driven_on[here]) continue;
    for (std::size_t there = 0; there < soils.size(); ++there) {
      if (here == there) continue;
      likely.push_back({.numbers = deviations_between(soils[here].soil, soils[there].soil.mean),
                        .here = static_cast<int>(here),
                        .there = static_cast<int>(there)});
    }
  }
  constexpr double kWeaker = 3;
  likely.push_back({.numbers = weaker_by(kWeaker), .here = {}, .there = {}});
  return likely;
}

std::vector<SoilNumbers> differences_among_soils(const UncertainSoil& soil) {
  // Two decades of kphi (1e4 to 1e6) and of cohesion, from sands to loams (Wong 2008, table 2.3)
  // and of regoliths; friction of 24 to 47 deg on 19 sites of the Moon (Hovland & Mitchell 1973),
  // where also density goes from 1300 to 1900 kg/m3 (Carrier et al. 1991); shear moduli of 1 to 5
  // cm.
  constexpr double kBearing_log = 1.5, kCohesion_log = 1, kFriction_rad = 6 * kDegree;
  constexpr double kDensity_kgpm3 = 150, kShear_log = 0.4;
  std::vector<SoilNumbers> differences{bearing_by(soil, -kBearing_log)};
  const auto add = [&](const auto& change) {
    Soil other = soil.mean;
    change(other);
    differences.push_back(deviations_between(soil, other));
  };
  add([](Soil& other) { other.cohesion_pa *= std::exp(-kCohesion_log); });
  add([](Soil& other) { other.friction_angle_rad -= kFriction_rad; });
  add([](Soil& other) { other.density_kgpm3 -= kDensity_kgpm3; });
  add([](Soil& other) {  // looser soil shears further
    for (double Soil::*const modulus : {&Soil::kx0_m, &Soil::kx1_m, &Soil::ky0_m, &Soil::ky1_m}) {
      other.*modulus *= std::exp(kShear_log);
    }
  });
  return differences;
}

UncertainSoil estimated_soil(const UncertainSoil& said, const SoilNumbers& numbers,
                             const SoilNumbers& stds) {
  UncertainSoil soil{.mean = deviating(said, numbers)};
  const SoilNumbers spread = soil_spread(said);
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    double Soil::*const member = soil_parameters().at(k).member;
    const double before = said.mean.*member;
    const double std = stds.at(k) * spread.at(k);  // of its logarithm, where it is positive
    soil.standard_deviation.*member = before > 0 ? std * (soil.mean.*member) / before : std;
  }
  return soil;
}

std::vector<MapSoil> estimated_soils(std::vector<MapSoil> soils, std::vector<SoilNumbers> numbers,
                                     const std::vector<SoilNumbers>& stds,
                                     const std::vector<bool>& driven_on) {
  numbers.resize(soils.size());
  for (std::size_t i = 0; i < soils.size(); ++i) {
    if (!driven_on[i]) continue;
    SoilNumbers left = stds[i];
    const SoilNumbers told = told_spread(soils[i].soil);
    for (std::size_t k = 0; k < kSoilNumbers; ++k) {
      if (!(told.at(k) > 0)) left.at(k) = 0;  // what is told exactly stays so
    }
    soils[i].soil = estimated_soil(soils[i].soil, numbers[i], left);
  }
  return soils;
}

}  // namespace regoplan
