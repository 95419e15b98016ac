#include "app/settings/truth_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "app/settings/model_settings.h"
#include "app/settings/settings_path.h"
#include "app/settings/soil_settings.h"
#include "driving/true_world.h"
#include "maps/raster_files.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// As far as any projection reaches, and farther.
constexpr ValueRange kMapCoordinate{.min = -1e9, .max = 1e9};

/// Where a truth begins: the problem that it departs from.
struct Planned {
  const PlanningProblem& problem;
  std::filesystem::path folder;

  std::vector<std::string> soil_names() const {
    std::vector<std::string> names;
    for (const MapSoil& soil : problem.map.soils()) names.push_back(soil.name);
    return names;
  }
};

/// A number of a soil: itself, or `{std: k}`, the mean and k standard deviations.
double soil_number(const SettingsNode& node, const SoilParameter& parameter,
                   const UncertainSoil& known) {
  const ValueRange allowed{
      .min = parameter.min, .max = parameter.max, .min_excluded = parameter.min_excluded};
  if (node.kind() != SettingsNode::Kind::kMapping) {
    return node.number(allowed) * parameter.file_unit;
  }
  return read_mapping(node, [&](SettingsMapping& mapping) {
    const double off = mapping.number("std", {.min = -10, .max = 10});
    if (off != 0 && known.standard_deviation.*parameter.member == 0) {
      throw mapping.required("std").error(fmt::format(
          "{} of the planned soil has no std, of which {} is nothing (allowed: a number instead of "
          "the mapping)",
          parameter.name, off));
    }
    const double value =
        known.mean.*parameter.member + off * known.standard_deviation.*parameter.member;
    const double shown = value / parameter.file_unit;
    if (!allowed.contains(shown)) {
      throw mapping.node().error(
          fmt::format("{} is not valid (allowed: {})", shown, allowed.text()));
    }
    return value;
  });
}

/// A known soil with some of its numbers changed.
Soil read_changed_soil(const SettingsNode& node, const UncertainSoil& known) {
  return read_mapping(node, [&](SettingsMapping& mapping) {
    Soil soil = known.mean;
    for (const SoilParameter& parameter : soil_parameters()) {
      if (const SettingsNode* number = mapping.optional(parameter.name)) {
        soil.*parameter.member = soil_number(*number, parameter, known);
      }
    }
    validate(soil);
    return soil;
  });
}

/// `like: NAME` and, where it differs from that, `soil: {...}`.
Soil read_zone_soil(SettingsMapping& mapping, const Planned& planned) {
  const std::size_t like = mapping.required("like").choice(planned.soil_names());
  const UncertainSoil& known = planned.problem.map.soils()[like].soil;
  const SettingsNode* changes = mapping.optional("soil");
  return changes ? read_changed_soil(*changes, known) : known.mean;
}

std::vector<Soil> read_soils(const SettingsNode& node, const Planned& planned) {
  std::vector<Soil> soils;
  for (const MapSoil& soil : planned.problem.map.soils()) soils.push_back(soil.soil.mean);
  const std::vector<std::string> names = planned.soil_names();
  for (const SettingsEntry& entry : node.mapping()) {
    const auto found = std::ranges::find(names, entry.key);
    if (found == names.end()) {
      throw entry.value.error(
          fmt::format("no soil of the map (allowed: {})", fmt::join(names, " | ")));
    }
    const auto index = static_cast<std::size_t>(found - names.begin());
    soils[index] = read_changed_soil(entry.value, planned.problem.map.soils()[index].soil);
  }
  return soils;
}

/// A zone that no vehicle on the map can meet is a mistake in its coordinates.
void require_on_map(const SoilZone& zone, const GridFrame& map, const SettingsNode& corners) {
  const auto [west, east] = std::ranges::minmax(zone.corners, {}, &PathPoint::x_m);
  const auto [south, north] = std::ranges::minmax(zone.corners, {}, &PathPoint::y_m);
  if (east.x_m > map.west_m && west.x_m < map.east_m() && north.y_m > map.south_m() &&
      south.y_m < map.north_m) {
    return;
  }
  throw corners.error(
      fmt::format("the zone lies beside the map (x {:.10g} to {:.10g}, y {:.10g} to {:.10g} m)",
                  map.west_m, map.east_m(), map.south_m(), map.north_m));
}

/// Between corners on one line there is no ground.
void require_area(const SoilZone& zone, const SettingsNode& corners) {
  const PathPoint& first = zone.corners.front();
  const auto distance_m = [&first](const PathPoint& corner) {
    return std::hypot(corner.x_m - first.x_m, corner.y_m - first.y_m);
  };
  const PathPoint farthest = *std::ranges::max_element(zone.corners, {}, distance_m);
  const double length_m = distance_m(farthest);
  constexpr double kRounding = 1e-9;  // of the length
  const auto beside = [&](const PathPoint& corner) {
    const double area_m2 = (farthest.x_m - first.x_m) * (corner.y_m - first.y_m) -
                           (farthest.y_m - first.y_m) * (corner.x_m - first.x_m);
    return std::abs(area_m2) > kRounding * length_m * length_m;
  };
  if (std::ranges::none_of(zone.corners, beside)) {
    throw corners.error("the corners lie on one line (allowed: corners around some ground)");
  }
}

SoilZone read_zone(const SettingsNode& node, const Planned& planned) {
  return read_mapping(node, [&](SettingsMapping& mapping) {
    SoilZone zone{.name = mapping.required("name").text(),
                  .soil = read_zone_soil(mapping, planned),
                  .corners = {}};
    const SettingsNode& corners = mapping.required("corners_m");
    for (const SettingsNode& corner : corners.list()) {
      if (corner.list().size() != 2) throw corner.not_allowed("[x_m, y_m]");
      zone.corners.push_back(
          {corner.list()[0].number(kMapCoordinate), corner.list()[1].number(kMapCoordinate)});
    }
    if (zone.corners.size() < 3) {
      throw corners.error(
          fmt::format("{} corners are not valid (allowed: at least 3)", zone.corners.size()));
    }
    require_area(zone, corners);
    require_on_map(zone, planned.problem.map.elevation().frame, corners);
    return zone;
  });
}

ZoneRaster read_zone_raster(const SettingsNode& node, const Planned& planned) {
  return read_mapping(node, [&](SettingsMapping& mapping) {
    const SettingsNode& name = mapping.required("file");
    ZoneRaster raster{.classes = with_named_file(
                          name, planned.folder,
                          [](const NamedFile& file) { return read_classes(file.path.string()); }),
                      .soils = {}};
    adopt_crs(raster.classes, planned.problem.map.elevation().frame, name.text());
    const SettingsNode& codes = mapping.required("codes");
    if (codes.mapping().empty()) throw codes.not_allowed("at least one code");
    for (const SettingsEntry& entry : codes.mapping()) {
      std::int32_t code = 0;
      const char* end = entry.key.data() + entry.key.size();
      const auto [parsed, failed] = std::from_chars(entry.key.data(), end, code);
      if (failed != std::errc() || parsed != end) {
        throw entry.value.error(fmt::format("{} is no code (allowed: an integer)", entry.key));
      }
      raster.soils.emplace_back(code, read_mapping(entry.value, [&](SettingsMapping& soil) {
                                  return read_zone_soil(soil, planned);
                                }));
    }
    return raster;
  });
}

TrueMechanism read_true_mechanism(const SettingsNode& node, const Vehicle& vehicle) {
  std::vector<std::string> names;
  for (const WheelMount& wheel : vehicle.wheels) names.push_back(wheel.name);
  return read_mapping(node, [&names](SettingsMapping& mapping) {
    TrueMechanism one{.mechanism = read_mechanism(mapping)};
    if (const SettingsNode* wheels = mapping.optional("wheels")) {
      for (const SettingsNode& wheel : wheels->list()) {
        one.wheels.push_back(names[wheel.choice(names)]);
      }
    }
    return one;
  });
}

WheelFault read_fault(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    const ValueRange factor{.min = 0.5, .max = 2};
    WheelFault fault;
    fault.drag_nm = mapping.number_or("drag_nm", {.min = 0, .max = 1e5}, 0);
    fault.steer_offset_rad =
        kDegree * mapping.number_or("steer_offset_deg", {.min = -45, .max = 45}, 0);
    fault.radius_factor = mapping.number_or("radius_factor", factor, 1);
    fault.motor_constant_factor = mapping.number_or("motor_constant_factor", factor, 1);
    return fault;
  });
}

/// A vehicle falls over whose centre of gravity is moved off its wheels: by the number that does it
/// alone, or by both together.
void require_standing(const SettingsNode& node, const Vehicle& vehicle, const DriveTruth& truth) {
  constexpr std::string_view kAllowed =
      "a centre of gravity within the polygon of the wheels' contacts";
  const auto refuse = [&](std::string_view key, double forward_m, double left_m) {
    const SettingsNode* number = node.find(key);
    if (!number || stands_on_wheels(with_centre_moved(vehicle, forward_m, left_m, 0))) return;
    throw number->not_allowed(kAllowed);
  };
  refuse("cg_forward_m", truth.cg_forward_m, 0);
  refuse("cg_left_m", 0, truth.cg_left_m);
  refuse("cg_left_m", truth.cg_forward_m, truth.cg_left_m);
}

void read_vehicle_truth(const SettingsNode& node, const Vehicle& vehicle, DriveTruth& truth) {
  read_mapping(node, [&](SettingsMapping& mapping) {
    const ValueRange arm{.min = -100, .max = 100};
    truth.payload_kg = mapping.number_or(
        "payload_kg", {.min = -vehicle.mass_kg, .max = 1e6, .min_excluded = true}, 0);
    truth.cg_forward_m = mapping.number_or("cg_forward_m", arm, 0);
    truth.cg_left_m = mapping.number_or("cg_left_m", arm, 0);
    truth.cg_up_m = mapping.number_or("cg_up_m", arm, 0);
    if (const SettingsNode* wheels = mapping.optional("wheels")) {
      truth.wheels.resize(vehicle.wheels.size());
      for (const SettingsEntry& entry : wheels->mapping()) {
        const auto found = std::ranges::find(vehicle.wheels, entry.key, &WheelMount::name);
        if (found == vehicle.wheels.end()) {
          throw entry.value.error(fmt::format("no wheel of {}", vehicle.name));
        }
        truth.wheels[static_cast<std::size_t>(found - vehicle.wheels.begin())] =
            read_fault(entry.value);
      }
    }
    require_standing(node, vehicle, truth);
    true_vehicle(vehicle, truth);  // throws where it cannot be
    return 0;
  });
}

PathPoint read_shift(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    const ValueRange metres{.min = -1e4, .max = 1e4};
    return PathPoint{mapping.number_or("east_m", metres, 0),
                     mapping.number_or("north_m", metres, 0)};
  });
}

}  // namespace

DriveTruth read_truth(const std::string& file, const PlanningProblem& problem) {
  return parse_truth(settings_text(file), file, problem);
}

DriveTruth parse_truth(const std::string& text, const std::string& file,
                       const PlanningProblem& problem) {
  const SettingsNode root = parse_settings(text, file);
  const Planned planned{problem, std::filesystem::path(file).parent_path()};
  return read_mapping(root, [&](SettingsMapping& mapping) {
    DriveTruth truth;
    if (const SettingsNode* soils = mapping.optional("soils")) {
      truth.soils = read_soils(*soils, planned);
    }
    if (const SettingsNode* zones = mapping.optional("zones")) {
      for (const SettingsNode& zone : zones->list()) {
        truth.zones.push_back(read_zone(zone, planned));
      }
    }
    if (const SettingsNode* raster = mapping.optional("zone_raster")) {
      truth.zone_raster = read_zone_raster(*raster, planned);
    }
    if (const SettingsNode* mechanisms = mapping.optional("mechanisms")) {
      for (const SettingsNode& one : mechanisms->list()) {
        truth.mechanisms.push_back(read_true_mechanism(one, problem.vehicle));
      }
    }
    if (const SettingsNode* vehicle = mapping.optional("vehicle")) {
      read_vehicle_truth(*vehicle, problem.vehicle, truth);
    }
    if (const SettingsNode* shift = mapping.optional("map")) {
      const PathPoint by = read_shift(*shift);
      truth.map_east_m = by.x_m;
      truth.map_north_m = by.y_m;
    }
    if (const SettingsNode* shift = mapping.optional("soil_border")) {
      const PathPoint by = read_shift(*shift);
      truth.soil_east_m = by.x_m;
      truth.soil_north_m = by.y_m;
    }
    if (const SettingsNode* ruts = mapping.optional("ruts")) {
      truth.rut_stiffness = read_mapping(*ruts, [](SettingsMapping& rut) {
        return rut.number("stiffening", {.min = 0, .max = 10});
      });
    }
    return truth;
  });
}

}  // namespace regoplan
