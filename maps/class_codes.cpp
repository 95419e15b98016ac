#include "maps/class_codes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace regoplan {
namespace {

bool is_listed(const TerrainMap& map, std::int32_t code) {
  return std::ranges::any_of(map.catalogue().classes,
                             [code](const auto& listed) { return listed.first == code; });
}

}  // namespace

std::vector<UnlistedCode> unlisted_codes(const TerrainMap& map) {
  if (!map.classes()) return {};
  std::map<std::int32_t, std::size_t> cells;
  for (const std::int32_t code : map.classes()->code) ++cells[code];
  std::vector<UnlistedCode> unlisted;
  for (const auto& [code, count] : cells) {
    if (code != ClassRaster::kNoData && !is_listed(map, code)) unlisted.push_back({code, count});
  }
  std::ranges::stable_sort(unlisted, std::greater{}, &UnlistedCode::cells);
  return unlisted;
}

std::string why_no_soil(const TerrainMap& map, double x_m, double y_m) {
  const std::optional<ClassRaster>& classes = map.classes();
  if (!classes || !covers(classes->frame, x_m, y_m)) {
    return "it lies outside the raster of soil classes, and the soils give no soil of unmapped "
           "ground (remedy: unmapped: NAME)";
  }
  const std::int32_t code = classes->code[cell_at(classes->frame, x_m, y_m)];
  if (code == ClassRaster::kNoData) {
    return "the raster of soil classes has no class there (nodata), and the soils give no soil of "
           "unmapped ground (remedy: unmapped: NAME)";
  }
  if (is_listed(map, code)) return fmt::format("class {} is forbidden", code);
  std::vector<std::int32_t> listed;
  std::ranges::transform(map.catalogue().classes, std::back_inserter(listed),
                         [](const auto& known) { return known.first; });
  return fmt::format(
      "the soil classes hold the code {} there, in {} of {} cells, and the soils do not list it "
      "(classes: {}; remedy: add {}: NAME to classes, or unmapped: NAME)",
      code, std::ranges::count(classes->code, code), classes->code.size(), fmt::join(listed, ", "),
      code);
}

}  // namespace regoplan
