#include "app/settings/map_notices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "maps/class_codes.h"

namespace regoplan {
namespace {

std::string cell_text(const GridFrame& frame) {
  return fmt::format("{:.4g} x {:.4g} m", frame.cell_width_m, frame.cell_height_m);
}

/// Whether heights come in steps of a metre, as they do where they are counts of something.
bool in_whole_metres(const std::vector<float>& heights_m) {
  float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
  for (const float height_m : heights_m) {
    if (std::isnan(height_m)) continue;
    if (height_m != std::floor(height_m)) return false;
    lowest = std::min(lowest, height_m);
    highest = std::max(highest, height_m);
  }
  return lowest < highest;
}

/// How much of two intervals is common to both.
double shared_m(double from_m, double to_m, double other_from_m, double other_to_m) {
  return std::max(0.0, std::min(to_m, other_to_m) - std::max(from_m, other_from_m));
}

}  // namespace

std::vector<std::string> map_notices(const TerrainMap& map, const Vehicle& vehicle) {
  const GridFrame& frame = map.elevation().frame;
  const double cell_m = std::max(frame.cell_width_m, frame.cell_height_m);
  const double vehicle_m = vehicle.body.y_max_m - vehicle.body.y_min_m;
  std::vector<std::string> notices;
  if (cell_m > vehicle_m) {
    notices.push_back(fmt::format(
        "the elevation's cells of {} are wider than the {} ({:.4g} m): what lies between their "
        "centres is not judged; remedy: finer elevations, and rocks for what is known to stand "
        "there",
        cell_text(frame), vehicle.name, vehicle_m));
  }
  constexpr double kCoarse_m = 10;  // where a step of a metre is a slope of 6 deg
  if (cell_m < kCoarse_m && in_whole_metres(map.elevation().height_m)) {
    notices.push_back(fmt::format(
        "the elevation's heights are whole metres, in cells of {}: steps of {:.0f} deg; remedy, "
        "where they are counts of another unit: regoplan map import --scale METRES_A_UNIT",
        cell_text(frame), std::atan(1 / cell_m) * 57.29577951308232));
  }
  return notices;
}

std::string unlisted_classes_notice(const TerrainMap& map, const std::string& raster) {
  if (map.catalogue().unmapped) return "";
  const std::vector<UnlistedCode> unlisted = unlisted_codes(map);
  if (unlisted.empty()) return "";
  constexpr std::size_t kListed = 8;
  std::vector<std::string> codes;
  for (const UnlistedCode& found : unlisted) {
    if (codes.size() == kListed) break;
    codes.push_back(
        fmt::format("{} ({} {})", found.code, found.cells, found.cells == 1 ? "cell" : "cells"));
  }
  if (unlisted.size() > kListed) {
    codes.push_back(fmt::format("{} others", unlisted.size() - kListed));
  }
  return fmt::format(
      "{}: no soil is given for the {} {} of {} cells: their ground is forbidden; remedy: "
      "add {}: NAME to classes of the soils, or unmapped: NAME",
      raster, codes.size() == 1 ? "code" : "codes", fmt::join(codes, ", "),
      map.classes()->code.size(), unlisted.front().code);
}

std::string uncovered_notice(const TerrainMap& map, const std::string& raster) {
  if (!map.classes()) return "";
  const GridFrame &heights = map.elevation().frame, &classes = map.classes()->frame;
  const double covered_m2 =
      shared_m(heights.west_m, heights.east_m(), classes.west_m, classes.east_m()) *
      shared_m(heights.south_m(), heights.north_m, classes.south_m(), classes.north_m);
  const double whole_m2 =
      (heights.east_m() - heights.west_m) * (heights.north_m - heights.south_m());
  constexpr double kMargin = 0.02;
  const double uncovered = 1 - covered_m2 / whole_m2;
  if (uncovered < kMargin) return "";
  const SoilCatalogue& soils = map.catalogue();
  const std::string taken =
      soils.unmapped ? "taken for " + soils.soils[static_cast<std::size_t>(*soils.unmapped)].name
                     : "forbidden";
  return fmt::format("{}: covers {} of the map ({}); the other {:.0f} % are {}", raster,
                     extent_text(classes), extent_text(heights), 100 * uncovered, taken);
}

std::string rocks_off_map_notice(const TerrainMap& map, const std::string& source) {
  const GridFrame& frame = map.elevation().frame;
  constexpr std::size_t kListed = 8;
  std::size_t count = 0;
  std::vector<std::string> listed;
  for (const Rock& rock : map.rocks()) {
    // How far the nearest point of the map lies from the rock's centre.
    const double aside_m = std::max({frame.west_m - rock.x_m, rock.x_m - frame.east_m(), 0.0});
    const double along_m = std::max({frame.south_m() - rock.y_m, rock.y_m - frame.north_m, 0.0});
    if (std::hypot(aside_m, along_m) <= rock.radius_m) continue;
    if (++count > kListed) continue;
    listed.push_back(fmt::format("x_m {:.10g}, y_m {:.10g}, radius_m {:.4g}", rock.x_m, rock.y_m,
                                 rock.radius_m));
  }
  if (count == 0) return "";
  if (count > kListed) listed.push_back(fmt::format("{} others", count - kListed));
  return fmt::format("{}: {} of {} rocks {} wholly off the map ({}), where no path meets {}: {}",
                     source, count, map.rocks().size(), count == 1 ? "lies" : "lie",
                     extent_text(frame), count == 1 ? "it" : "them", fmt::join(listed, "; "));
}

}  // namespace regoplan
