#include "maps/drawn_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "maps/smooth_noise.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/value_range.h"

namespace regoplan {
namespace {

double gaps_of(const DrawnRockRow& row) {
  const double length_m = std::hypot(row.to_x_m - row.from_x_m, row.to_y_m - row.from_y_m);
  return std::max(1.0, std::ceil(length_m / row.spacing_m - 1e-9));
}

/// Every feature is looked at for every cell; the noise of a cell costs as much as six.
void require_bounded_work(const DrawnTerrain& drawn) {
  constexpr double kVisitsMax = 5e8, kNoise = 6, kRocksMax = 1e6;
  const double cells = drawn.width_m * drawn.height_m / (drawn.cell_m * drawn.cell_m);
  const auto features = static_cast<double>(drawn.craters.size() + drawn.zones.size());
  const double cells_max = kVisitsMax / (kNoise + features);
  if (cells > cells_max) {
    throw InputError(
        fmt::format("{:.3g} cells are too many (allowed with {} craters and zones: {:.3g})", cells,
                    features, cells_max));
  }
  double rocks = 0;
  for (const DrawnRockRow& row : drawn.rock_rows) {
    require("rock_rows.spacing_m", row.spacing_m, kAbove0);
    rocks += 1 + gaps_of(row);
  }
  if (!(rocks <= kRocksMax)) {
    throw InputError(
        fmt::format("rock_rows: {:.3g} rocks are too many (allowed: {})", rocks, kRocksMax));
  }
}

void validate(const DrawnTerrain& drawn) {
  require("cell_m", drawn.cell_m, {.min = 0.01, .max = 100});
  require("width_m", drawn.width_m, {.min = 16 * drawn.cell_m, .max = 20000 * drawn.cell_m});
  require("height_m", drawn.height_m, {.min = 16 * drawn.cell_m, .max = 20000 * drawn.cell_m});
  for (const DrawnCrater& crater : drawn.craters) {
    require("craters.diameter_m", crater.diameter_m, kAbove0);
    require("craters.depth_m", crater.depth_m, {.min = 0, .max = crater.diameter_m});
    require("craters.rim_height_m", crater.rim_height_m, {.min = 0, .max = crater.depth_m});
  }
  if (drawn.dunes) {
    require("dunes.wavelength_m", drawn.dunes->wavelength_m, {.min = 4 * drawn.cell_m, .max = 1e6});
    require("dunes.height_m", drawn.dunes->height_m,
            {.min = 0, .max = drawn.dunes->wavelength_m / 3});
  }
  for (const DrawnZone& zone : drawn.zones) {
    require("zones.east_m", zone.east_m, {.min = zone.west_m});
    require("zones.north_m", zone.north_m, {.min = zone.south_m});
  }
  require_bounded_work(drawn);
}

double height_m(const DrawnCrater& crater, double x_m, double y_m) {
  const double distance = std::hypot(x_m - crater.x_m, y_m - crater.y_m) / (crater.diameter_m / 2);
  if (distance >= 1) return crater.rim_height_m / (distance * distance * distance);
  return crater.rim_height_m - crater.depth_m * (1 - distance * distance);
}

double height_m(const DrawnDunes& dunes, double x_m, double y_m) {
  constexpr double kWindwardShare = 2.0 / 3;
  const double along = x_m * std::cos(dunes.wind_rad) + y_m * std::sin(dunes.wind_rad);
  const double turns = along / dunes.wavelength_m;
  const double phase = turns - std::floor(turns);
  const double rise =
      phase < kWindwardShare ? phase / kWindwardShare : (1 - phase) / (1 - kWindwardShare);
  // Half a cosine up, half a cosine down: crest and trough are round.
  return dunes.height_m * (1 - std::cos(std::numbers::pi * rise)) / 2;
}

bool holds(const DrawnZone& zone, double x_m, double y_m) {
  return x_m >= zone.west_m && x_m <= zone.east_m && y_m >= zone.south_m && y_m <= zone.north_m;
}

std::vector<Rock> all_rocks(const DrawnTerrain& drawn) {
  std::vector<Rock> rocks = drawn.rocks;
  for (const DrawnRockRow& row : drawn.rock_rows) {
    const auto gaps = static_cast<int>(gaps_of(row));
    for (int i = 0; i <= gaps; ++i) {
      const double share = static_cast<double>(i) / gaps;
      rocks.push_back({.x_m = row.from_x_m + share * (row.to_x_m - row.from_x_m),
                       .y_m = row.from_y_m + share * (row.to_y_m - row.from_y_m),
                       .radius_m = row.radius_m,
                       .height_m = row.height_m});
    }
  }
  return rocks;
}

}  // namespace

SyntheticTerrain draw_terrain(const DrawnTerrain& drawn) {
  validate(drawn);
  const GridFrame frame{.columns = static_cast<int>(std::ceil(drawn.width_m / drawn.cell_m - 1e-9)),
                        .rows = static_cast<int>(std::ceil(drawn.height_m / drawn.cell_m - 1e-9)),
                        .west_m = 0,
                        .north_m = drawn.height_m,
                        .cell_width_m = drawn.cell_m,
                        .cell_height_m = drawn.cell_m};
  constexpr double kRoughnessWavelength_m = 8;
  const SmoothNoise noise(drawn.seed, kRoughnessWavelength_m);
  SyntheticTerrain terrain{.elevation = {.frame = frame, .height_m = {}},
                           .classes = {.frame = frame, .code = {}},
                           .rocks = all_rocks(drawn)};
  for (int row = 0; row < frame.rows; ++row) {
    const double y_m = frame.north_m - (row + 0.5) * drawn.cell_m;
    for (int column = 0; column < frame.columns; ++column) {
      const double x_m = (column + 0.5) * drawn.cell_m;
      double z_m = x_m * std::tan(drawn.slope_east_rad) + y_m * std::tan(drawn.slope_north_rad) +
                   drawn.roughness_m * noise(x_m, y_m);
      for (const DrawnCrater& crater : drawn.craters) z_m += height_m(crater, x_m, y_m);
      if (drawn.dunes) z_m += height_m(*drawn.dunes, x_m, y_m);
      int code = drawn.soil;
      for (const DrawnZone& zone : drawn.zones) {
        if (holds(zone, x_m, y_m)) code = zone.code;
      }
      terrain.elevation.height_m.push_back(static_cast<float>(z_m));
      terrain.classes.code.push_back(code);
    }
  }
  return terrain;
}

}  // namespace regoplan
