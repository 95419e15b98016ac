#pragma once

#include <string>
#include <vector>

#include "maps/terrain_map.h"

namespace regoplan {

/// Reads band 1 of any raster that GDAL knows. Nodata and NaN cells become NaN: unknown.
/// \throws InputError naming the file and what is wrong with it: missing, not a raster, rotated or
/// south-up, a geographic CRS (degrees; names the remedy), not one band of numbers, no known cell
ElevationRaster read_elevation(const std::string& file);

/// Reads band 1 of any raster of integers that GDAL knows; nodata becomes `ClassRaster::kNoData`.
/// \throws InputError as above, and where a cell is not an integer
ClassRaster read_classes(const std::string& file);

/// Brings a class raster to the CRS of the elevation it goes with: one without CRS takes the
/// elevation's. \returns a notice for the person, empty where there is nothing to say
/// \throws InputError where the two CRS differ, or the rasters do not overlap
std::string adopt_crs(ClassRaster& classes, const GridFrame& elevation,
                      const std::string& classes_file);

/// Write GeoTIFF. \throws InputError where the file cannot be written
void write_elevation(const ElevationRaster& elevation, const std::string& file);
void write_classes(const ClassRaster& classes, const std::string& file);

/// Reads `x_m, y_m, radius_m, height_m` with a header line, in any column order.
/// \throws InputError naming file, line, column and value
std::vector<Rock> read_rocks(const std::string& file);
void write_rocks(const std::vector<Rock>& rocks, const std::string& file);

}  // namespace regoplan
