#include "drive_diagnosis/likely_soils.h"

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
    if (driven_on[i]) soils[i].soil = estimated_soil(soils[i].soil, numbers[i], stds[i]);
  }
  return soils;
}

}  // namespace regoplan
