#include "planner/problem/planning_problem.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "maps/class_codes.h"
#include "maps/ground_finder.h"
#include "planner/problem/obstacles.h"
#include "planner/runtime/draw_statistics.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/parameters/gravity_range.h"
#include "terramech/parameters/soil.h"

namespace regoplan {
namespace {

void require(const char* field, double value, bool valid, const char* allowed) {
  if (!std::isfinite(value) || !valid) throw ValueError(field, value, allowed);
}

void validate_place(const TerrainMap& map, const char* what, double x_m, double y_m) {
  if (!map.inside(x_m, y_m)) {
    throw InputError(fmt::format("{}: ({}, {}) lies outside the map (allowed: {})", what, x_m, y_m,
                                 extent_text(map.elevation().frame)));
  }
  if (std::isnan(map.height_m(x_m, y_m))) {
    throw InputError(
        fmt::format("{}: the elevation at ({}, {}) is unknown (nodata or NaN)", what, x_m, y_m));
  }
  if (!map.soil_index(x_m, y_m)) {
    throw InputError(
        fmt::format("{}: no soil at ({}, {}): {}", what, x_m, y_m, why_no_soil(map, x_m, y_m)));
  }
}

void validate(const Objective& objective) {
  const auto weight = [](const char* field, double value) {
    require(field, value, value >= 0, "0 or above");
  };
  weight("planner.objective.per_s", objective.per_s);
  weight("planner.objective.per_m", objective.per_m);
  weight("planner.objective.per_j", objective.per_j);
  weight("planner.objective.per_exposed_s", objective.per_exposed_s);
  require("planner.objective.exposed_below", objective.exposed_below, objective.exposed_below > 0,
          "above 0");
  if (objective.per_s + objective.per_m + objective.per_j <= 0) {
    throw InputError("planner.objective: one of per_s, per_m and per_j must be above 0");
  }
}

void validate(const MapSoil& soil) {
  const std::string of_soil = fmt::format("soils.{}.", soil.name);
  try {
    validate(soil.soil.mean);
  } catch (const ValueError& error) {
    throw ValueError(of_soil + error.field(), error.value(), error.allowed());
  }
  for (const SoilParameter& parameter : soil_parameters()) {
    require(fmt::format("{}{}.std", of_soil, parameter.name),
            soil.soil.standard_deviation.*parameter.member / parameter.file_unit, kAtLeast0);
  }
}

void validate(const Search& search) {
  validate(search.objective);
  const std::vector<std::string>& names = planner_names();
  if (std::find(names.begin(), names.end(), search.planner) == names.end()) {
    throw InputError(fmt::format("planner.name: {} is not known (allowed: {})", search.planner,
                                 fmt::join(names, ", ")));
  }
  if (search.time_s.has_value() == search.iterations.has_value()) {
    throw InputError("planner: give exactly one of time_s and iterations");
  }
  if (search.time_s) {
    require("planner.time_s", *search.time_s, *search.time_s > 0, "above 0");
  } else {
    require("planner.iterations", static_cast<double>(*search.iterations),
            *search.iterations > 0 && *search.iterations <= kIterationsMax, "1 to 2e9");
  }
  require("planner.candidates", search.candidates,
          search.candidates >= 1 && search.candidates <= 100, "1 to 100");
  require("planner.soil_draws", search.soil_draws,
          search.soil_draws >= 1 && search.soil_draws <= 100000, "1 to 100000");
  require("planner.threads", search.threads, search.threads >= 1 && search.threads <= 256,
          "1 to 256");
}

}  // namespace

WheelModelSpec wheel_model_spec(const PlanningProblem& problem, const Soil& soil) {
  return {.variant = problem.wheel_variant,
          .wheel = problem.vehicle.wheel,
          .soil = soil,
          .gravity_mps2 = problem.gravity_mps2,
          .mechanisms = problem.mechanisms,
          .generic = problem.generic};
}

bool is_uncertain(const MapSoil& soil) {
  return std::any_of(soil_parameters().begin(), soil_parameters().end(),
                     [&soil](const SoilParameter& parameter) {
                       return soil.soil.standard_deviation.*parameter.member > 0;
                     });
}

bool has_uncertain_soil(const PlanningProblem& problem) {
  return std::ranges::any_of(problem.map.soils(), is_uncertain);
}

void validate(const PlanningProblem& problem) {
  validate(problem.vehicle);
  require("gravity_mps2", problem.gravity_mps2, kGravity_mps2);
  require("speed_mps.max", problem.speed_max_mps,
          problem.speed_max_mps > 0 && problem.speed_max_mps <= problem.vehicle.speed_max_mps,
          fmt::format("above 0 to the vehicle's {}", problem.vehicle.speed_max_mps).c_str());
  require("start.heading_deg", problem.start.heading_rad / kDegree, true, "a finite number");
  require("start.speed_mps", problem.start.speed_mps,
          problem.start.speed_mps >= 0 && problem.start.speed_mps <= problem.speed_max_mps,
          "0 to speed_mps.max");
  // A goal of this size holds the map wherever it lies: nothing would be left to plan.
  const GridFrame& frame = problem.map.elevation().frame;
  const double diagonal_m =
      std::hypot(frame.east_m() - frame.west_m, frame.north_m - frame.south_m());
  require("goal.radius_m", problem.goal.radius_m,
          problem.goal.radius_m > 0 && problem.goal.radius_m <= diagonal_m,
          fmt::format("above 0 to the map's diagonal, {:.2f}", std::floor(100 * diagonal_m) / 100)
              .c_str());
  require("goal.speed_mps.max", problem.goal.speed_max_mps,
          problem.goal.speed_max_mps >= 0 && problem.goal.speed_max_mps <= problem.speed_max_mps,
          "0 to speed_mps.max");
  if (problem.goal.heading_rad) {
    require("goal.heading_tolerance_deg", problem.goal.heading_tolerance_rad / kDegree,
            problem.goal.heading_tolerance_rad > 0, "above 0");
  }
  for (const MapSoil& soil : problem.map.soils()) validate(soil);
  for (const Mechanism& mechanism : problem.mechanisms) form_of(mechanism);
  if (problem.generic) validate(*problem.generic);
  validate(problem.limits);
  validate(problem.search);
  const double shown = probability_of(problem.search.soil_draws, problem.search.soil_draws).low;
  if (shown < problem.limits.probability_min && has_uncertain_soil(problem)) {
    throw InputError(
        fmt::format("planner.soil_draws: {} draws show at most {:.4f}, less than "
                    "limits.probability_min {} (allowed: more draws)",
                    problem.search.soil_draws, shown, problem.limits.probability_min));
  }
  validate_place(problem.map, "start", problem.start.x_m, problem.start.y_m);
  validate_place(problem.map, "goal", problem.goal.x_m, problem.goal.y_m);

  const GroundFinder ground(problem.map, problem.vehicle);
  const GroundPatch patch =
      ground.at(problem.start.x_m, problem.start.y_m, problem.start.heading_rad);
  if (!patch.known) {
    throw InputError("start: a wheel stands outside the map or on unknown or forbidden ground");
  }
  const Obstacles obstacles(problem.map, problem.vehicle, 0);
  if (obstacles.hit({.x_m = problem.start.x_m,
                     .y_m = problem.start.y_m,
                     .yaw_rad = problem.start.heading_rad},
                    patch)) {
    throw InputError(fmt::format("start: the vehicle at ({}, {}) touches a rock or the ground",
                                 problem.start.x_m, problem.start.y_m));
  }
}

}  // namespace regoplan
