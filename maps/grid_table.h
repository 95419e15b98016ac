#pragma once

#include <string>

#include "maps/height_reading.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// Whether a file is a table of points by its name: it ends in .csv or .xyz.
bool is_grid_table(const std::string& file);

/// Reads a table of evenly spaced points, as spreadsheets and GIS export rasters: a row a point
/// with x, y and height (`x_m, y_m, z_m`, `easting, northing, elevation`, ... in a header line, or
/// without one in this order; further columns are left aside), cells apart by comma, semicolon, tab
/// or spaces, rows in any order. The points are the centres of the cells; a point that is missing,
/// or whose height is empty or nan, is unknown ground. Points may lie beside the grid by a
/// twentieth of its spacing.
/// \throws InputError naming file, line and value: what is no number, a point off the grid, a point
/// given twice
ElevationRaster read_grid_table(const std::string& file, const HeightReading& reading);

}  // namespace regoplan
