#include "maps/undeclared_nodata.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/warp_command.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

/// What programs write into cells that they know no height of.
constexpr std::array<double, 9> kMarks{-9999, -99999, -32768, -32767, -999,
                                       9999,  99999,  32767,  65535};

struct HeightRange {
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -std::numeric_limits<float>::infinity();
};

/// Of the known heights other than `left_out`.
HeightRange range_without(const std::vector<float>& heights_m, float left_out) {
  HeightRange range;
  for (const float height_m : heights_m) {
    if (std::isnan(height_m) || height_m == left_out) continue;
    range.lowest = std::min(range.lowest, height_m);
    range.highest = std::max(range.highest, height_m);
  }
  return range;
}

/// Whether no ground leads to this height from the others.
bool apart(float height_m, const HeightRange& others) {
  constexpr float kLeast_m = 100;
  if (!(others.lowest <= others.highest)) return false;
  const float away_m = std::max(others.lowest - height_m, height_m - others.highest);
  return away_m > std::max(kLeast_m, others.highest - others.lowest);
}

}  // namespace

void check_for_undeclared_nodata(const ElevationRaster& raster, double scale, double offset_m,
                                 const std::string& file) {
  const HeightRange all = range_without(raster.height_m, std::nanf(""));
  for (const double mark : kMarks) {
    const auto height_m = static_cast<float>(mark * scale + offset_m);
    // A mark lies beyond all heights.
    if (height_m != all.lowest && height_m != all.highest) continue;
    const HeightRange others = range_without(raster.height_m, height_m);
    if (!apart(height_m, others)) continue;
    const auto first = std::ranges::find(raster.height_m, height_m) - raster.height_m.begin();
    throw InputError(fmt::format(
        "{}: {} stands in {} cells (the first: column {}, row {}), and all others are {} to {} m "
        "high: it marks cells without height, and the file does not say so; remedy: regoplan map "
        "import --nodata {}, or gdal_translate -a_nodata {} {}",
        file, mark, std::ranges::count(raster.height_m, height_m), first % raster.frame.columns,
        first / raster.frame.columns, others.lowest, others.highest, mark, mark,
        from_and_to(file)));
  }
}

}  // namespace regoplan
