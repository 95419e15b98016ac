#include "maps/terrain_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <set>

#include "terramech/basics/input_error.h"

namespace regoplan {

namespace {

void check_frame(const GridFrame& frame, std::size_t cells, const char* raster) {
  const bool valid = frame.columns > 0 && frame.rows > 0 && std::isfinite(frame.west_m) &&
                     std::isfinite(frame.north_m) && std::isfinite(frame.cell_width_m) &&
                     frame.cell_width_m > 0 && std::isfinite(frame.cell_height_m) &&
                     frame.cell_height_m > 0;
  if (!valid) throw InputError(fmt::format("{}: a raster needs cells of positive size", raster));
  if (cells != static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows)) {
    throw InputError(fmt::format("{}: {} cells are not {} columns x {} rows", raster, cells,
                                 frame.columns, frame.rows));
  }
}

void check_elevation(const ElevationRaster& elevation) {
  check_frame(elevation.frame, elevation.height_m.size(), "elevation");
  bool known = false;
  for (const float height : elevation.height_m) {
    if (std::isinf(height)) throw InputError("elevation: an infinite height is no elevation");
    known = known || !std::isnan(height);
  }
  if (!known) throw InputError("elevation: no cell is known");
}

void check_catalogue(const SoilCatalogue& catalogue) {
  if (catalogue.soils.empty()) throw InputError("soils: no soil given");
  if (catalogue.soils.size() > INT16_MAX) {
    throw ValueError("soils", static_cast<double>(catalogue.soils.size()),
                     fmt::format("1 to {} soils", INT16_MAX));
  }
  const auto exists = [&](int soil) {
    return soil >= 0 && soil < static_cast<int>(catalogue.soils.size());
  };
  std::set<std::int32_t> codes;
  for (const auto& [code, soil] : catalogue.classes) {
    if (!exists(soil)) throw InputError(fmt::format("classes: code {} names no soil", code));
    if (!codes.insert(code).second) {
      throw InputError(fmt::format("classes: code {} is given twice", code));
    }
  }
  if (catalogue.unmapped && !exists(*catalogue.unmapped)) {
    throw InputError("unmapped: names no soil");
  }
}

/// The soil of each class cell; `unmapped` for codes that the catalogue does not list.
std::vector<std::int16_t> soil_of_cells(const ClassRaster& classes, const SoilCatalogue& catalogue,
                                        std::int16_t unmapped) {
  const std::map<std::int32_t, int> soil_of_code(catalogue.classes.begin(),
                                                 catalogue.classes.end());
  std::vector<std::int16_t> soils;
  soils.reserve(classes.code.size());
  std::int32_t last_code = ClassRaster::kNoData;
  std::int16_t last_soil = unmapped;
  for (const std::int32_t code : classes.code) {
    if (code != last_code) {
      const auto found = soil_of_code.find(code);
      last_code = code;
      last_soil = code == ClassRaster::kNoData || found == soil_of_code.end()
                      ? unmapped
                      : static_cast<std::int16_t>(found->second);
    }
    soils.push_back(last_soil);
  }
  return soils;
}

[[noreturn]] void throw_no_soil(const ClassRaster& classes, const SoilCatalogue& catalogue) {
  std::set<std::int32_t> found;
  for (const std::int32_t code : classes.code) {
    if (code != ClassRaster::kNoData && found.size() < 20) found.insert(code);
  }
  std::vector<std::int32_t> listed;
  for (const auto& [code, soil] : catalogue.classes) listed.push_back(code);
  throw InputError(
      fmt::format("soil classes: no cell has a soil: the raster holds the codes [{}], the soils "
                  "list the classes [{}]",
                  fmt::join(found, ", "), fmt::join(listed, ", ")));
}

struct Interval_m {
  double from, to;
};

/// The widest interval of whole millimetres that lies within another.
Interval_m within(double from_m, double to_m) {
  constexpr double kPerMetre = 1000;
  const auto to_millimetres = [](double value_m, double (*inwards)(double)) {
    const double nearest_m = std::round(value_m * kPerMetre) / kPerMetre;
    // A bound that is told in millimetres stays what it is, whatever 1000 times it is rounded to.
    return nearest_m == value_m ? value_m : inwards(value_m * kPerMetre) / kPerMetre + 0.0;
  };
  return {to_millimetres(from_m, std::ceil), to_millimetres(to_m, std::floor)};
}

}  // namespace

std::string extent_text(const GridFrame& frame) {
  const Interval_m x = within(frame.west_m, frame.east_m());
  const Interval_m y = within(frame.south_m(), frame.north_m);
  return fmt::format("x {} to {} m, y {} to {} m", x.from, x.to, y.from, y.to);
}

bool overlap(const GridFrame& a, const GridFrame& b) {
  return a.west_m < b.east_m() && b.west_m < a.east_m() && a.south_m() < b.north_m &&
         b.south_m() < a.north_m;
}

TerrainMap::TerrainMap(ElevationRaster elevation, std::optional<ClassRaster> classes,
                       SoilCatalogue soils, std::vector<Rock> rocks)
    : soils_(std::move(soils)) {
  check_elevation(elevation);
  check_catalogue(soils_);
  auto ground = std::make_shared<Ground>();
  if (classes) {
    check_frame(classes->frame, classes->code.size(), "soil classes");
    if (!overlap(elevation.frame, classes->frame)) {
      throw InputError(fmt::format("soil classes ({}) and elevation ({}) do not overlap",
                                   extent_text(classes->frame), extent_text(elevation.frame)));
    }
    if (soils_.unmapped) ground->soil_elsewhere = static_cast<std::int16_t>(*soils_.unmapped);
    ground->soil_of_cell = soil_of_cells(*classes, soils_, ground->soil_elsewhere);
    if (std::ranges::all_of(ground->soil_of_cell, [](auto soil) { return soil == kNoSoil; })) {
      throw_no_soil(*classes, soils_);
    }
  } else {
    if (soils_.soils.size() != 1) {
      throw InputError(fmt::format(
          "soils: {} soils without a raster of soil classes that says where (allowed: 1)",
          soils_.soils.size()));
    }
    ground->soil_elsewhere = 0;
  }
  ground->rocks = RockIndex(std::move(rocks));
  const std::vector<Rock>& placed = ground->rocks.rocks();
  const auto on_map = [&](const Rock& rock) { return covers(elevation.frame, rock.x_m, rock.y_m); };
  if (!placed.empty() && std::ranges::none_of(placed, on_map)) {
    throw InputError(fmt::format("rocks: none of {} lies on the elevation raster ({})",
                                 placed.size(), extent_text(elevation.frame)));
  }
  ground->elevation = std::move(elevation);
  ground->classes = std::move(classes);
  ground_ = std::move(ground);
}

double TerrainMap::max_height_m(double x_min_m, double x_max_m, double y_min_m,
                                double y_max_m) const {
  constexpr double kNotKnown_m = std::numeric_limits<double>::quiet_NaN();
  const GridFrame& frame = ground_->elevation.frame;
  if (!covers(frame, x_min_m, y_min_m) || !covers(frame, x_max_m, y_max_m)) return kNotKnown_m;
  const auto column = [&](double x_m) {
    return std::clamp((x_m - frame.west_m) / frame.cell_width_m - 0.5, 0.0,
                      static_cast<double>(frame.columns - 1));
  };
  const auto row = [&](double y_m) {
    return std::clamp((frame.north_m - y_m) / frame.cell_height_m - 0.5, 0.0,
                      static_cast<double>(frame.rows - 1));
  };
  const auto first_column = static_cast<std::ptrdiff_t>(column(x_min_m));
  const auto last_column = static_cast<std::ptrdiff_t>(std::ceil(column(x_max_m)));
  const auto first_row = static_cast<std::ptrdiff_t>(row(y_max_m));
  const auto last_row = static_cast<std::ptrdiff_t>(std::ceil(row(y_min_m)));
  float highest = -std::numeric_limits<float>::infinity();
  bool unknown = false;
  for (std::ptrdiff_t r = first_row; r <= last_row; ++r) {
    const float* cells = ground_->elevation.height_m.data() + r * frame.columns;
    for (std::ptrdiff_t c = first_column; c <= last_column; ++c) {
      unknown = unknown || std::isnan(cells[c]);
      highest = std::max(highest, cells[c]);
    }
  }
  return unknown ? kNotKnown_m : highest;
}

TerrainMap TerrainMap::forbidding(const std::vector<std::string>& soils) const {
  Ground ground = *ground_;
  const auto forbid = [&](std::int16_t& soil) {
    if (soil == kNoSoil) return;
    const std::string& name = soils_.soils[static_cast<std::size_t>(soil)].name;
    if (std::ranges::find(soils, name) != soils.end()) soil = kNoSoil;
  };
  std::ranges::for_each(ground.soil_of_cell, forbid);
  forbid(ground.soil_elsewhere);
  TerrainMap map = *this;
  map.ground_ = std::make_shared<const Ground>(std::move(ground));
  return map;
}

TerrainMap TerrainMap::with_soils(std::vector<MapSoil> soils) const {
  const auto same_name = [](const MapSoil& a, const MapSoil& b) { return a.name == b.name; };
  if (!std::ranges::equal(soils, soils_.soils, same_name)) {
    throw InputError("soils: names or order differ from those of the map");
  }
  TerrainMap map = *this;
  map.soils_.soils = std::move(soils);
  return map;
}

}  // namespace regoplan
