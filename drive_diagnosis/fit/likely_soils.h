#pragma once

#include <optional>
#include <vector>

#include "drive_diagnosis/comparison/window_prediction.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// A soil that may well lie where the map says another.
struct LikelySoil {
  SoilNumbers numbers{};     ///< by which it differs from the map's
  std::optional<int> here;   ///< the map's soil; nothing: any
  std::optional<int> there;  ///< the soil of the map that lies there; nothing: none of them
};

/// Soils of the map, where another is said to be that was driven on; and one that is weaker or
/// stronger in all that carries and holds.
/// \param driven_on of each soil of the map
std::vector<LikelySoil> likely_soils(const TerrainMap& map, const std::vector<bool>& driven_on);

/// Ways in which soils differ from each other, each as far as one standard deviation among them,
/// for a soil of which nothing is known yet: less bearing, cohesion, friction and density, and
/// larger shear moduli, in this order.
std::vector<SoilNumbers> differences_among_soils(const UncertainSoil& soil);

/// A soil whose numbers are so many standard deviations off, and known to so many of them.
UncertainSoil estimated_soil(const UncertainSoil& said, const SoilNumbers& numbers,
                             const SoilNumbers& stds);

/// The map's soils, those that were driven on as they are estimated.
/// \param numbers, stds of each soil; no numbers: none is off
std::vector<MapSoil> estimated_soils(std::vector<MapSoil> soils, std::vector<SoilNumbers> numbers,
                                     const std::vector<SoilNumbers>& stds,
                                     const std::vector<bool>& driven_on);

}  // namespace regoplan
