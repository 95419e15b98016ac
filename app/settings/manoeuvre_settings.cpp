#include "app/settings/manoeuvre_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "app/settings/settings_mapping.h"
#include "app/settings/vehicle_settings.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// A value, or each of a list of values.
std::vector<std::reference_wrapper<const SettingsNode>> each_of(const SettingsNode& node) {
  std::vector<std::reference_wrapper<const SettingsNode>> all;
  if (node.kind() != SettingsNode::Kind::kList) return {node};
  for (const SettingsNode& item : node.list()) all.emplace_back(item);
  if (all.empty()) throw node.not_allowed("a value or a list of values");
  return all;
}

std::vector<Vehicle> vehicles(SettingsMapping& mapping, const PlanningProblem& problem,
                              const std::filesystem::path& folder) {
  const SettingsNode* node = mapping.optional("vehicle");
  if (!node) return {problem.vehicle};
  std::vector<Vehicle> all;
  for (const SettingsNode& item : each_of(*node)) {
    all.push_back(placed(item, [&] { return named_vehicle(item, folder); }));
  }
  return all;
}

std::vector<MapSoil> soils(SettingsMapping& mapping, const PlanningProblem& problem) {
  const std::vector<MapSoil>& known = problem.map.soils();
  std::vector<std::string> names;
  for (const MapSoil& soil : known) names.push_back(soil.name);
  const SettingsNode* node = mapping.optional("soil");
  if (!node) {
    if (known.size() == 1) return known;
    throw mapping.node().error(
        fmt::format("soil is missing (allowed: {})", fmt::join(names, " | ")));
  }
  std::vector<MapSoil> all;
  for (const SettingsNode& item : each_of(*node)) all.push_back(known[item.choice(names)]);
  return all;
}

std::vector<double> numbers(SettingsMapping& mapping, std::string_view key,
                            const ValueRange& allowed, double fallback) {
  const SettingsNode* node = mapping.optional(key);
  if (!node) return {fallback};
  std::vector<double> all;
  for (const SettingsNode& item : each_of(*node)) all.push_back(item.number(allowed));
  return all;
}

/// What the kind itself needs.
void read_shape(SettingsMapping& mapping, Manoeuvre& m) {
  switch (m.kind) {
    case ManoeuvreKind::kBrakingInATurn:
    case ManoeuvreKind::kSteadyTurn:
      m.radius_m = mapping.number("radius_m", kAbove0);
      m.angle_rad = mapping.number_or("angle_deg", {.min = 0, .max = 3600, .min_excluded = true},
                                      m.kind == ManoeuvreKind::kSteadyTurn ? 180 : 45) *
                    kDegree;
      if (m.kind == ManoeuvreKind::kBrakingInATurn) {
        m.braking_mps2 = mapping.number_or("braking_mps2", kAbove0, 0);
      }
      break;
    case ManoeuvreKind::kLaneChange:
      m.offset_m = mapping.number("offset_m", kAbove0);
      m.length_m = mapping.number("length_m", {.min = 1});
      break;
    case ManoeuvreKind::kSlalom:
      m.amplitude_m = mapping.number("amplitude_m", kAbove0);
      m.wavelength_m = mapping.number("wavelength_m", {.min = 1});
      m.waves = mapping.number_or("waves", {.min = 0.5, .max = 100}, 3);
      break;
    case ManoeuvreKind::kSlopeTraverse:
      m.length_m = mapping.number_or("length_m", {.min = 1, .max = 1e4}, 20);
      break;
    case ManoeuvreKind::kPointTurn:
      m.angle_rad =
          mapping.number_or("angle_deg", {.min = 0, .max = 3600, .min_excluded = true}, 90) *
          kDegree;
      break;
  }
}

/// What tells manoeuvres of one kind apart beside vehicle, soil, speed and slope; ends in ", ".
std::string shape_text(const Manoeuvre& m) {
  switch (m.kind) {
    case ManoeuvreKind::kBrakingInATurn:
    case ManoeuvreKind::kSteadyTurn:
      return fmt::format("radius {} m, ", m.radius_m);
    case ManoeuvreKind::kLaneChange:
      return fmt::format("{} m in {} m, ", m.offset_m, m.length_m);
    case ManoeuvreKind::kSlalom:
      return fmt::format("{} m each {} m, ", m.amplitude_m, m.wavelength_m);
    case ManoeuvreKind::kSlopeTraverse:
    case ManoeuvreKind::kPointTurn:
      return "";
  }
  return "";
}

std::vector<Manoeuvre> read_one(const SettingsNode& node, const PlanningProblem& problem,
                                const std::filesystem::path& folder) {
  return read_mapping(node, [&](SettingsMapping& mapping) {
    constexpr std::array kKinds{ManoeuvreKind::kSteadyTurn,     ManoeuvreKind::kLaneChange,
                                ManoeuvreKind::kSlalom,         ManoeuvreKind::kSlopeTraverse,
                                ManoeuvreKind::kBrakingInATurn, ManoeuvreKind::kPointTurn};
    std::vector<std::string> kinds;
    for (const ManoeuvreKind kind : kKinds) kinds.emplace_back(name(kind));
    const SettingsNode& kind_node = mapping.required("kind");
    Manoeuvre base{.kind = kKinds.at(kind_node.choice(kinds))};
    const SettingsNode* given_name = mapping.optional("name");
    const std::string base_name = given_name ? given_name->text() : std::string(name(base.kind));
    const std::vector<Vehicle> all_vehicles = vehicles(mapping, problem, folder);
    const std::vector<MapSoil> all_soils = soils(mapping, problem);
    const bool turns = base.kind == ManoeuvreKind::kPointTurn;
    const std::vector<double> speeds =
        turns ? numbers(mapping, "turn_rate_deg_s", kAbove0, 1)
              : numbers(mapping, "speed_mps", kAbove0, problem.speed_max_mps);
    const bool across = base.kind == ManoeuvreKind::kSlopeTraverse;
    const std::vector<double> slopes =
        numbers(mapping, "slope_deg", {.min = 0, .max = 60}, across ? 10 : 0);
    const SettingsNode* heading = mapping.optional("slope_heading_deg");
    const double uphill_deg =
        heading ? heading->number({.min = -360, .max = 360}) : (across ? 90 : 0);
    base.slope_heading_rad = uphill_deg * kDegree;
    const std::string towards = heading ? fmt::format(" uphill at {} deg", uphill_deg) : "";
    if (const SettingsNode* turn = mapping.optional("turn")) {
      base.to_the_right = turn->choice({"left", "right"}) == 1;
    }
    read_shape(mapping, base);
    constexpr std::size_t kMost = 10000;
    const std::size_t count =
        all_vehicles.size() * all_soils.size() * slopes.size() * speeds.size();
    if (count > kMost) {
      throw mapping.node().error(
          fmt::format("{} combinations are too many (allowed: {})", count, kMost));
    }
    std::vector<Manoeuvre> all;
    for (const Vehicle& vehicle : all_vehicles) {
      for (const MapSoil& soil : all_soils) {
        for (const double slope : slopes) {
          for (const double speed : speeds) {
            Manoeuvre one = base;
            one.vehicle = vehicle;
            one.soil = soil;
            one.slope_rad = slope * kDegree;
            (turns ? one.turn_rate_rad_s : one.speed_mps) = turns ? speed * kDegree : speed;
            if (one.braking_mps2 == 0) one.braking_mps2 = vehicle.acceleration_max_mps2;
            one.name = fmt::format("{}: {}{}, {}, {} {}, slope {} deg{}", base_name,
                                   shape_text(one), vehicle.name, soil.name, speed,
                                   turns ? "deg/s" : "m/s", slope, towards);
            all.push_back(std::move(one));
          }
        }
      }
    }
    return all;
  });
}

}  // namespace

std::vector<Manoeuvre> read_manoeuvres(const std::string& file, const PlanningProblem& problem) {
  const SettingsNode root = read_settings(file);
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::vector<Manoeuvre> all;
  for (const SettingsNode& item : root.list()) {
    for (Manoeuvre& one : read_one(item, problem, folder)) {
      // Bad numbers of a manoeuvre are found where it is made ready: here, with its place.
      placed(item, [&] { return prepare(one, problem.limits, problem); });
      all.push_back(std::move(one));
    }
  }
  if (all.empty()) throw root.error("no manoeuvre");
  return all;
}

}  // namespace regoplan
