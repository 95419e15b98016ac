#pragma once

#include <string>
#include <vector>

#include "maps/terrain_map.h"

namespace regoplan {

/// The soils that come with the program: those of the demo's map, and `simulant_2004`, the Lunar
/// Regolith Simulant of Yoshida & Ishigami (2004) in consistent units.
/// \param demo_soils the soils file of the demo
std::vector<MapSoil> preset_soils(const std::string& demo_soils);

}  // namespace regoplan
