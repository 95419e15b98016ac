#pragma once

#include <array>
#include <string>

#include "maps/height_reading.h"
#include "maps/terrain_map.h"

class GDALRasterBand;
class OGRSpatialReference;

namespace regoplan {

/// Heights are in metres, or somebody says what a unit of the file is worth.
/// \param crs of the raster, null where it has none
/// \throws InputError naming the unit and the remedy: feet, centimetres, ... as the band or a
/// vertical CRS states them; a picture whose steps may be anything
void check_height_unit(GDALRasterBand& band, const OGRSpatialReference* crs,
                       const HeightReading& reading, const std::string& file);

/// A raster, for remedies that can be copied.
struct RasterInWords {
  std::string file;
  std::string resampling;  ///< that suits its cells, as gdalwarp calls it
};

/// A planar CRS is in metres.
/// \param transform, frame of the raster; of the frame columns and rows count
/// \throws InputError naming the unit and the remedy
void check_crs_unit(const OGRSpatialReference& crs, const std::array<double, 6>& transform,
                    const GridFrame& frame, const RasterInWords& raster);

}  // namespace regoplan
