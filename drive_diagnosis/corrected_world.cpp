#include "drive_diagnosis/corrected_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace regoplan {
namespace {

double length_m(const std::vector<MapPlace>& track) {
  double length = 0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    length += std::hypot(track[i].x_m - track[i - 1].x_m, track[i].y_m - track[i - 1].y_m);
  }
  return length;
}

/// Whether a place lies beside a track, not before its begin nor behind its end.
bool is_beside(const std::vector<MapPlace>& track, double reach_m, const MapPlace& place) {
  for (std::size_t i = 1; i < track.size(); ++i) {
    const MapPlace &from = track[i - 1], &to = track[i];
    const double dx = to.x_m - from.x_m, dy = to.y_m - from.y_m;
    const double px = place.x_m - from.x_m, py = place.y_m - from.y_m;
    const double along = px * dx + py * dy, length = std::hypot(dx, dy);
    if (length == 0) continue;
    if (along >= 0 && along <= length * length && std::abs(px * dy - py * dx) <= reach_m * length) {
      return true;
    }
    // Outside of a bend, what is near its corner.
    if (i > 1 && std::hypot(px, py) <= reach_m && along < 0) {
      const MapPlace& before = track[i - 2];
      const double bx = from.x_m - before.x_m, by = from.y_m - before.y_m;
      if (px * bx + py * by > 0) return true;
    }
  }
  return false;
}

/// The way driven in a window of a zone, in the mean: no border is told more finely.
double window_way_m(const SoilZoneFound& zone, const std::vector<DriveWindow>& windows) {
  double way_m = 0;
  for (std::size_t i = zone.first; i <= zone.last; ++i) {
    way_m += windows[i].speed_mps * windows[i].duration_s();
  }
  return way_m / static_cast<double>(zone.last - zone.first + 1);
}

/// A class raster of the whole map where it has none.
ClassRaster classes_of(const TerrainMap& map, const SoilCatalogue& catalogue) {
  if (map.classes()) return *map.classes();
  ClassRaster classes{.frame = map.elevation().frame, .code = {}};
  const std::int32_t code =
      catalogue.classes.empty() ? ClassRaster::kNoData : catalogue.classes.front().first;
  classes.code.assign(map.elevation().height_m.size(), code);
  return classes;
}

void paint(const std::vector<MapPlace>& track, double reach_m, std::int32_t code,
           ClassRaster& classes) {
  const GridFrame& frame = classes.frame;
  const auto [west, east] = std::ranges::minmax(track, {}, &MapPlace::x_m);
  const auto [south, north] = std::ranges::minmax(track, {}, &MapPlace::y_m);
  const auto cell = [](double from_m, double size_m, int count) {
    return static_cast<int>(std::clamp(std::floor(from_m / size_m), 0.0, count - 1.0));
  };
  const int first_column =
      cell(west.x_m - reach_m - frame.west_m, frame.cell_width_m, frame.columns);
  const int last_column =
      cell(east.x_m + reach_m - frame.west_m, frame.cell_width_m, frame.columns);
  const int first_row = cell(frame.north_m - north.y_m - reach_m, frame.cell_height_m, frame.rows);
  const int last_row = cell(frame.north_m - south.y_m + reach_m, frame.cell_height_m, frame.rows);
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const MapPlace centre{frame.west_m + (column + 0.5) * frame.cell_width_m,
                            frame.north_m - (row + 0.5) * frame.cell_height_m};
      if (!is_beside(track, reach_m, centre)) continue;
      classes.code[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                   static_cast<std::size_t>(column)] = code;
    }
  }
}

/// The class that a zone is of: that of the soil that it is like, or a new one.
std::int32_t code_of(const SoilZoneFound& zone, int number, SoilCatalogue& catalogue) {
  std::int32_t free_code = 1;
  for (const auto& [code, soil] : catalogue.classes) {
    if (zone.like && soil == *zone.like) return code;
    free_code = std::max(free_code, code + 1);
  }
  catalogue.classes.emplace_back(free_code, static_cast<int>(catalogue.soils.size()));
  const std::string before = catalogue.soils[static_cast<std::size_t>(zone.soil)].name;
  catalogue.soils.push_back(
      {.name = fmt::format("{}_zone_{}", before, number),
       .source = fmt::format("diagnosis of a drive: the soil found from {:.0f} to {:.0f} s of it",
                             zone.starts_s, zone.ends_s),
       .soil = zone.estimate});
  return free_code;
}

/// How far a named offset of that id lies off, m.
MapPlace offset(const VehicleEffects& effects, std::string_view id) {
  MapPlace off;
  for (const VehicleFinding& found : effects.found) {
    if (found.id != id) continue;
    (found.parameter == "east_m" ? off.x_m : off.y_m) += found.size;
  }
  return off;
}

/// Slopes are what drives tell, and heights above the datum go with them.
void scale_heights(const VehicleEffects& effects, ElevationRaster& elevation) {
  for (const VehicleFinding& found : effects.found) {
    if (found.id != "map_heights") continue;
    for (float& height_m : elevation.height_m) {
      height_m = static_cast<float>(height_m * (1 + found.size));
    }
  }
}

void move(GridFrame& frame, const MapPlace& by) {
  frame.west_m += by.x_m;
  frame.north_m += by.y_m;
}

}  // namespace

std::vector<MapPlace> zone_track(const SoilZoneFound& zone,
                                 const std::vector<DriveWindow>& windows) {
  constexpr int kPlacesOfWindow = 5;
  const auto place_at = [](const DriveWindow& window, double time_s) {
    return window.place_at(time_s - window.middle_s());
  };
  std::vector<MapPlace> track{place_at(windows[zone.first], zone.starts_s)};
  for (std::size_t i = zone.first; i <= zone.last; ++i) {
    for (int k = 0; k < kPlacesOfWindow; ++k) {
      const double time_s =
          windows[i].start_s + (k + 0.5) / kPlacesOfWindow * windows[i].duration_s();
      if (time_s > zone.starts_s && time_s < zone.ends_s) {
        track.push_back(place_at(windows[i], time_s));
      }
    }
  }
  track.push_back(place_at(windows[zone.last], zone.ends_s));
  return track;
}

TerrainMap corrected_map(const TerrainMap& map, const VehicleEffects& effects,
                         const std::vector<DriveWindow>& windows) {
  SoilCatalogue catalogue = map.catalogue();
  catalogue.soils = effects.soils;
  if (catalogue.classes.empty() && !map.classes()) catalogue.classes.emplace_back(1, 0);
  ElevationRaster elevation = map.elevation();
  ClassRaster classes = classes_of(map, catalogue);
  std::vector<Rock> rocks = map.rocks();
  const MapPlace all = offset(effects, "map_offset"), soils = offset(effects, "zone_border");
  move(elevation.frame, all);
  scale_heights(effects, elevation);
  move(classes.frame, {all.x_m + soils.x_m, all.y_m + soils.y_m});
  for (Rock& rock : rocks) {
    rock.x_m += all.x_m;
    rock.y_m += all.y_m;
  }
  int zones = 0;
  for (const VehicleFinding& found : effects.found) {
    if (!found.zone) continue;
    const std::vector<MapPlace> track = zone_track(*found.zone, windows);
    const double reach_m = length_m(track) / 2 + window_way_m(*found.zone, windows);
    paint(track, reach_m, code_of(*found.zone, ++zones, catalogue), classes);
  }
  return {std::move(elevation), std::move(classes), std::move(catalogue), std::move(rocks)};
}

Vehicle corrected_vehicle(const Vehicle& vehicle, const VehicleEffects& effects) {
  Vehicle corrected = vehicle;
  if (effects.vehicle.mass_kg) corrected.mass_kg = effects.vehicle.mass_kg->value;
  if (effects.vehicle.wheel_radius_m) {
    corrected.wheel.radius_m = effects.vehicle.wheel_radius_m->value;
  }
  for (const VehicleFinding& found : effects.found) {
    if (found.parameter == "radius_share")
      corrected.wheel.radius_m = vehicle.wheel.radius_m * (1 + found.size);
    if (found.id == "payload") corrected.mass_kg = vehicle.mass_kg * (1 + found.size);
    if (found.id != "cg_offset") continue;
    const auto off_m = [&found](std::string_view way) {
      return found.parameter == way ? found.size : 0;
    };
    corrected = with_centre_moved(corrected, off_m("forward_m"), off_m("left_m"), off_m("up_m"));
  }
  // Told from a centre of gravity nearer to its inner wheels, the same turn asks more of them.
  corrected.curvature_max_1pm = steerable_curvature_1pm(corrected);
  return corrected;
}

}  // namespace regoplan
