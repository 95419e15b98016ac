#include "app/settings/sweep_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "app/settings/vehicle_settings.h"
#include "terramech/basics/input_error.h"
#include "terramech/parameters/gravity_range.h"

namespace regoplan {
namespace {

/// Keys that name one number of any problem.
using FixedKeys = std::map<std::string, SweepKey, std::less<>>;

void add_vehicle_keys(FixedKeys& keys) {
  for (const VehicleNumber& number : vehicle_numbers()) {
    // What a scenario takes for its limits is varied there, where it counts.
    if (std::ranges::find(limit_keys(), number.key, &LimitKey::key) != limit_keys().end()) continue;
    keys[fmt::format("vehicle.{}", number.key)] = {.allowed = number.allowed,
                                                   .set = [&number](PlanningProblem& p, double v) {
                                                     p.vehicle.*number.member = v * number.unit;
                                                   }};
  }
  keys["vehicle.wheel.radius_m"] = {.allowed = kAbove0, .set = [](PlanningProblem& p, double v) {
                                      p.vehicle.wheel.radius_m = v;
                                    }};
  keys["vehicle.wheel.width_m"] = {
      .allowed = kAbove0, .set = [](PlanningProblem& p, double v) { p.vehicle.wheel.width_m = v; }};
  keys["vehicle.torque_max_nm"] = {
      .allowed = kAbove0, .set = [](PlanningProblem& p, double v) { p.vehicle.torque_max_nm = v; }};
}

FixedKeys known_keys() {
  FixedKeys keys{
      {"speed_mps.max", {kAbove0, [](PlanningProblem& p, double v) { p.speed_max_mps = v; }}},
      {"start.speed_mps", {kAtLeast0, [](PlanningProblem& p, double v) { p.start.speed_mps = v; }}},
      {"goal.speed_mps.max",
       {kAtLeast0, [](PlanningProblem& p, double v) { p.goal.speed_max_mps = v; }}},
      {"goal.radius_m", {kAbove0, [](PlanningProblem& p, double v) { p.goal.radius_m = v; }}},
      {"gravity_mps2", {kGravity_mps2, [](PlanningProblem& p, double v) { p.gravity_mps2 = v; }}}};
  for (const LimitKey& limit : limit_keys()) {
    keys[fmt::format("limits.{}", limit.key)] = {.allowed = limit.shown_range,
                                                 .set = [&limit](PlanningProblem& p, double v) {
                                                   p.limits.*limit.value = v * limit.si_per_shown;
                                                 }};
  }
  add_vehicle_keys(keys);
  return keys;
}

const FixedKeys& fixed_keys() {
  static const FixedKeys keys = known_keys();
  return keys;
}

/// Sets the mean of a number of one soil, or of all where `name` is empty.
void set_soil(PlanningProblem& problem, const std::string& name, double Soil::*member,
              double value) {
  std::vector<MapSoil> soils = problem.map.soils();
  bool found = false;
  for (MapSoil& soil : soils) {
    if (!name.empty() && soil.name != name) continue;
    soil.soil.mean.*member = value;
    found = true;
  }
  if (!found) {
    std::vector<std::string> names;
    for (const MapSoil& soil : soils) names.push_back(soil.name);
    throw InputError(
        fmt::format("the map has no soil {} (it has: {})", name, fmt::join(names, ", ")));
  }
  problem.map = problem.map.with_soils(std::move(soils));
}

SweepKey soil_key(const std::string& soil, std::string_view parameter) {
  const auto& known = soil_parameters();
  const auto found = std::ranges::find(known, parameter, &SoilParameter::name);
  if (found == known.end()) {
    std::vector<std::string_view> names;
    for (const SoilParameter& each : known) names.push_back(each.name);
    throw InputError(
        fmt::format("{} is no number of a soil (allowed: {})", parameter, fmt::join(names, ", ")));
  }
  // Experiments are named after their values, and names may not hold everything.
  if (soil.find_first_of(",= \t\n/") != std::string::npos) {
    throw InputError("a soil whose name holds a comma, =, / or a blank cannot be varied by it");
  }
  return {.allowed = {.min = found->min, .max = found->max, .min_excluded = found->min_excluded},
          .set = [soil, &parameter = *found](PlanningProblem& p, double v) {
            set_soil(p, soil, parameter.member, v * parameter.file_unit);
          }};
}

}  // namespace

SweepKey sweep_key(std::string_view key) {
  if (const auto fixed = fixed_keys().find(key); fixed != fixed_keys().end()) return fixed->second;
  constexpr std::string_view kEvery = "soil.", kOne = "soils.";
  if (key.starts_with(kEvery)) return soil_key("", key.substr(kEvery.size()));
  const std::size_t dot = key.rfind('.');
  if (key.starts_with(kOne) && dot > kOne.size()) {
    return soil_key(std::string(key.substr(kOne.size(), dot - kOne.size())), key.substr(dot + 1));
  }
  std::vector<std::string_view> names;
  for (const auto& [name, fixed] : fixed_keys()) names.push_back(name);
  throw InputError(fmt::format("cannot be varied (allowed: {}, soil.KEY, soils.NAME.KEY)",
                               fmt::join(names, ", ")));
}

}  // namespace regoplan
