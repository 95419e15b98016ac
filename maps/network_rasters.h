#pragma once

namespace regoplan {

/// Whether rasters may be read over a network: off unless this is called, before the first raster
/// is read. What GDAL may do is a setting of the whole process.
void allow_network_rasters();

bool network_rasters_allowed();

}  // namespace regoplan
