#pragma once

#include <gdal_priv.h>

#include <string>
#include <string_view>

namespace regoplan {

/// While it lives GDAL keeps its remarks to itself; the last one goes into our message. The first
/// one prepares GDAL: only formats of local files, no network file systems, no Python in a VRT.
class QuietGdal {
 public:
  QuietGdal();
  ~QuietGdal();
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

[[noreturn]] void fail_raster(const std::string& file, std::string_view what);

/// `what`, and GDAL's own words where it has any.
[[noreturn]] void fail_with_gdal(const std::string& file, std::string_view what);

/// Opens a raster of numbers for reading. A VRT may name files of its own folder, and below, only.
/// \pre a QuietGdal lives
/// \throws InputError
GDALDatasetUniquePtr open_raster(const std::string& file);

}  // namespace regoplan
