#include "app/page/report_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "app/page/base64.h"

namespace regoplan {
namespace {

using nlohmann::json;

/// Little-endian.
std::string base64_of(const std::vector<std::uint16_t>& numbers) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * numbers.size());
  for (const std::uint16_t number : numbers) {
    bytes.push_back(static_cast<std::uint8_t>(number & 0xff));
    bytes.push_back(static_cast<std::uint8_t>(number >> 8));
  }
  return base64(bytes);
}

/// The grid of the small rasters: blocks of `factor` by `factor` cells of the elevation.
struct Blocks {
  GridFrame frame;
  int factor = 1;
};

Blocks blocks_of(const GridFrame& frame, int side_max) {
  Blocks blocks{.frame = frame};
  blocks.factor = (std::max(frame.columns, frame.rows) + side_max - 1) / side_max;
  blocks.frame.columns = (frame.columns + blocks.factor - 1) / blocks.factor;
  blocks.frame.rows = (frame.rows + blocks.factor - 1) / blocks.factor;
  blocks.frame.cell_width_m *= blocks.factor;
  blocks.frame.cell_height_m *= blocks.factor;
  return blocks;
}

/// Mean height of the known cells of a block; NaN where half of its cells or more are unknown.
double block_height_m(const ElevationRaster& elevation, int factor, int block_column,
                      int block_row) {
  const GridFrame& frame = elevation.frame;
  double sum_m = 0;
  int known = 0, all = 0;
  for (int row = block_row * factor; row < std::min((block_row + 1) * factor, frame.rows); ++row) {
    for (int column = block_column * factor;
         column < std::min((block_column + 1) * factor, frame.columns); ++column) {
      const float height_m =
          elevation
              .height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                        static_cast<std::size_t>(column)];
      ++all;
      if (!std::isfinite(height_m)) continue;
      ++known;
      sum_m += static_cast<double>(height_m);
    }
  }
  return 2 * known > all ? sum_m / known : std::numeric_limits<double>::quiet_NaN();
}

json elevation_json(const ElevationRaster& elevation, const Blocks& blocks) {
  std::vector<double> heights_m;
  for (int row = 0; row < blocks.frame.rows; ++row)
    for (int column = 0; column < blocks.frame.columns; ++column)
      heights_m.push_back(block_height_m(elevation, blocks.factor, column, row));

  double min_m = std::numeric_limits<double>::infinity(), max_m = -min_m;
  for (const double height_m : heights_m) {
    if (std::isnan(height_m)) continue;
    min_m = std::min(min_m, height_m);
    max_m = std::max(max_m, height_m);
  }
  const double steps_per_m = max_m > min_m ? 65534 / (max_m - min_m) : 0;
  std::vector<std::uint16_t> steps;
  steps.reserve(heights_m.size());
  for (const double height_m : heights_m)
    steps.push_back(std::isnan(height_m) ? std::uint16_t{0}
                                         : static_cast<std::uint16_t>(
                                               1 + std::lround((height_m - min_m) * steps_per_m)));
  return {{"min_m", min_m}, {"max_m", max_m}, {"base64", base64_of(steps)}};
}

/// Soils row by row from the north, from 1, 0 where none is known: a soil, how many cells it lasts,
/// the next. A page reads its data letter by letter before it draws anything.
json soil_runs(const TerrainMap& map, const Blocks& blocks) {
  const GridFrame& fine = map.elevation().frame;
  std::vector<int> runs;
  for (int row = 0; row < blocks.frame.rows; ++row) {
    const int fine_row = std::min(row * blocks.factor + blocks.factor / 2, fine.rows - 1);
    const double y_m = fine.north_m - (fine_row + 0.5) * fine.cell_height_m;
    for (int column = 0; column < blocks.frame.columns; ++column) {
      const int fine_column =
          std::min(column * blocks.factor + blocks.factor / 2, fine.columns - 1);
      const double x_m = fine.west_m + (fine_column + 0.5) * fine.cell_width_m;
      const std::optional<int> index = map.soil_index(x_m, y_m);
      const int soil = index ? *index + 1 : 0;
      if (runs.empty() || *(runs.end() - 2) != soil) runs.insert(runs.end(), {soil, 0});
      ++runs.back();
    }
  }
  return runs;
}

json soil_json(const MapSoil& soil) {
  json parameters = json::array();
  for (const SoilParameter& parameter : soil_parameters()) {
    parameters.push_back(
        {{"name", parameter.name},
         {"mean", soil.soil.mean.*parameter.member / parameter.file_unit},
         {"std", soil.soil.standard_deviation.*parameter.member / parameter.file_unit}});
  }
  return {{"name", soil.name}, {"source", soil.source}, {"parameters", parameters}};
}

/// Name of a CRS: the first quoted text of its WKT.
std::string crs_name(const std::string& wkt) {
  const std::size_t open = wkt.find('"');
  if (open == std::string::npos) return wkt;
  return wkt.substr(open + 1, wkt.find('"', open + 1) - open - 1);
}

double rounded_mm(double value_m) {
  return std::round(value_m * 1e3) / 1e3;
}

json rocks_json(std::vector<Rock> rocks, std::size_t most) {
  if (rocks.size() > most) {
    std::stable_sort(rocks.begin(), rocks.end(),
                     [](const Rock& a, const Rock& b) { return a.radius_m > b.radius_m; });
    rocks.resize(most);
  }
  json rows = json::array();
  for (const Rock& rock : rocks)
    rows.push_back({rounded_mm(rock.x_m), rounded_mm(rock.y_m), rounded_mm(rock.radius_m),
                    rounded_mm(rock.height_m)});
  return rows;
}

}  // namespace

json report_map(const TerrainMap& map, const ReportMapDetail& detail) {
  const GridFrame& frame = map.elevation().frame;
  const Blocks blocks = blocks_of(frame, detail.cells_a_side);
  json soils = json::array();
  for (const MapSoil& soil : map.soils()) soils.push_back(soil_json(soil));
  json classes = json::array();
  for (const auto& [code, soil] : map.catalogue().classes)
    classes.push_back(
        {{"code", code}, {"soil", map.soils().at(static_cast<std::size_t>(soil)).name}});
  const std::optional<int> unmapped = map.catalogue().unmapped;
  return {{"crs", crs_name(frame.crs_wkt)},
          {"west_m", frame.west_m},
          {"east_m", frame.east_m()},
          {"south_m", frame.south_m()},
          {"north_m", frame.north_m},
          {"cell_width_m", frame.cell_width_m},
          {"cell_height_m", frame.cell_height_m},
          {"columns", frame.columns},
          {"rows", frame.rows},
          {"raster",
           {{"columns", blocks.frame.columns},
            {"rows", blocks.frame.rows},
            {"cell_width_m", blocks.frame.cell_width_m},
            {"cell_height_m", blocks.frame.cell_height_m},
            {"cells_averaged", blocks.factor},
            {"elevation", elevation_json(map.elevation(), blocks)},
            {"soil_runs", soil_runs(map, blocks)}}},
          {"soils", soils},
          {"classes", classes},
          {"unmapped",
           unmapped ? map.soils().at(static_cast<std::size_t>(*unmapped)).name : "forbidden"},
          {"rocks_total", map.rocks().size()},
          {"rocks", rocks_json(map.rocks(), detail.rocks)}};
}

}  // namespace regoplan
