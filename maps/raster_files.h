#pragma once

#include <string>
#include <vector>

#include "maps/height_reading.h"
#include "maps/rock_files.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// Reads band 1 of any raster of local files that GDAL knows (others: `maps/network_rasters.h`), or
/// a table of points (`read_grid_table`); scale and offset of the band are applied where `reading`
/// gives none. Nodata, masked and NaN cells become NaN: unknown. \throws InputError naming the
/// file, what is wrong with it and the remedy: missing, not a raster, rotated or south-up, a CRS in
/// degrees or feet, heights in feet or of a picture, no numbers, no known cell, a height that
/// cannot be one (beyond 1000 km), a nodata value that is not declared, more cells than the memory
/// holds, a VRT that names files outside of its folder
ElevationRaster read_elevation(const std::string& file, const HeightReading& reading = {});

/// Reads band 1 of any raster of integers that GDAL knows, whatever number type holds them; nodata,
/// masked and NaN cells become `ClassRaster::kNoData`.
/// \throws InputError as above, and where a cell is not an integer
ClassRaster read_classes(const std::string& file);

/// Brings a class raster to the CRS of the elevation it goes with: one without CRS takes the
/// elevation's. \returns a notice for the person, empty where there is nothing to say
/// \throws InputError where the two CRS differ, or the rasters do not overlap
std::string adopt_crs(ClassRaster& classes, const GridFrame& elevation,
                      const std::string& classes_file);

/// Write GeoTIFF, whole or not at all. \throws InputError where the file cannot be written
void write_elevation(const ElevationRaster& elevation, const std::string& file);
void write_classes(const ClassRaster& classes, const std::string& file);

/// Rasters of one grid in one file, each with a name for people; NaN where nothing is known.
struct RasterBand {
  std::string description;
  std::vector<float> values;  ///< row by row from the north
};
void write_bands(const GridFrame& frame, const std::vector<RasterBand>& bands,
                 const std::string& file);

}  // namespace regoplan
