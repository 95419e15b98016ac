#pragma once

#include <string>

class OGRSpatialReference;

namespace regoplan {

/// Whether coordinates of the one are those of the other, whatever the order of axes and the epoch.
bool is_same_crs(const OGRSpatialReference& a, const OGRSpatialReference& b);

/// A CRS as one word of a command: its code (`EPSG:32633`) where it reads back as the same CRS,
/// else as PROJ writes it, else as WKT.
std::string crs_word(const OGRSpatialReference& crs);

/// A line for a shell that brings a raster into another CRS.
/// \param target what `-t_srs` takes; empty where only rows and columns are turned
/// \param resampling `bilinear` of heights, `near` of codes
std::string warp_command(const std::string& file, const std::string& target,
                         const std::string& resampling);

/// A raster and what a command of GDAL makes of it, the last two words of a line for a shell: the
/// output is never the input, which GDAL would destroy, and a name that begins with a minus no
/// option.
std::string from_and_to(const std::string& file);

/// A text as one word of a line for a shell.
std::string shell_word(const std::string& text);

}  // namespace regoplan
