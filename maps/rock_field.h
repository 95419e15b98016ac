#pragma once

#include <cstdint>
#include <vector>

#include "maps/terrain_map.h"

namespace regoplan {

/// Rocks to scatter over a surface.
struct RockFieldSettings {
  double coverage = 0;  ///< share of the area that rocks of these diameters cover
  double diameter_min_m = 0;
  double diameter_max_m = 0;
};

/// Scatters rocks that do not touch each other and lie wholly on the extent of `frame`.
///
/// Diameters: rocks above D cover the share k exp(-q D), q = 1.79 + 0.152/k (Golombek & Rapp 1997),
/// with the k that gives the coverage asked between the two diameters. Heights: half the diameter
/// on average (ibid.).
/// \param abundance how dense rocks lie around each cell of `frame`, relative, >= 0
/// \throws ValueError `rock_coverage` where no such distribution covers so much, or there is no
/// room
std::vector<Rock> scatter_rocks(const GridFrame& frame, const std::vector<float>& abundance,
                                const RockFieldSettings& settings, std::uint64_t seed);

}  // namespace regoplan
