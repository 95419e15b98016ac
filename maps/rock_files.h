#pragma once

#include <string>
#include <vector>

#include "maps/rock_index.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// Reads `x_m, y_m, radius_m, height_m` with a header line, in any column order; other columns are
/// ignored.
/// \throws InputError naming file, line, column and value
std::vector<Rock> read_rocks(const std::string& file);

/// Rocks of which one lies on a map's extent at least, if there are any.
/// \throws InputError naming file, line, column and value
std::vector<Rock> read_rocks(const std::string& file, const GridFrame& map);

/// Writes every number so that it reads back exactly. \throws InputError where it cannot
void write_rocks(const std::vector<Rock>& rocks, const std::string& file);

}  // namespace regoplan
