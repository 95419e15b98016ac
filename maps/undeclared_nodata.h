#pragma once

#include <string>

#include "maps/terrain_map.h"

namespace regoplan {

/// Refuses heights that are really the mark of cells without height (-9999, ...), where the file
/// does not say so: one of the usual marks, farther from all other heights than these differ among
/// themselves, and than 100 m.
/// \param scale, offset_m that were applied to what the file stores
/// \throws InputError naming the mark, a cell of it and the remedy
void check_for_undeclared_nodata(const ElevationRaster& raster, double scale, double offset_m,
                                 const std::string& file);

}  // namespace regoplan
