#include "app/settings/effective_settings.h"

#include <nlohmann/json.hpp>
#include <numbers>

#include "app/settings/settings_json.h"
#include "app/settings/vehicle_settings.h"
#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

/// The degrees that read back to these radians.
double degrees_as_written(double angle_rad) {
  return parse_number(number_in_unit(angle_rad, std::numbers::pi / 180)).value();
}

Json start_json(const StartState& start) {
  return {{"x_m", start.x_m},
          {"y_m", start.y_m},
          {"heading_deg", degrees_as_written(start.heading_rad)},
          {"speed_mps", start.speed_mps}};
}

Json goal_json(const Goal& goal) {
  Json json{{"x_m", goal.x_m},
            {"y_m", goal.y_m},
            {"radius_m", goal.radius_m},
            {"speed_mps", {{"max", goal.speed_max_mps}}}};
  if (goal.heading_rad) {
    json["heading_deg"] = degrees_as_written(*goal.heading_rad);
    json["heading_tolerance_deg"] = degrees_as_written(goal.heading_tolerance_rad);
  }
  return json;
}

Json search_json(const Search& search) {
  const Objective& objective = search.objective;
  Json json{{"name", search.planner},
            {"objective",
             {{"per_s", objective.per_s},
              {"per_m", objective.per_m},
              {"per_j", objective.per_j},
              {"per_exposed_s", objective.per_exposed_s},
              {"exposed_below", objective.exposed_below}}}};
  if (search.time_s) json["time_s"] = *search.time_s;
  if (search.iterations) json["iterations"] = *search.iterations;
  json["improve"] = search.improve;
  json["seed"] = search.seed;
  json["candidates"] = search.candidates;
  json["soil_draws"] = search.soil_draws;
  return json;
}

}  // namespace

Json limits_json(const Limits& limits) {
  Json json;
  for (const LimitKey& limit : limit_keys()) {
    const std::string shown = number_in_unit(limits.*limit.value, limit.si_per_shown);
    json[std::string(limit.key)] = parse_number(shown).value();
  }
  return json;
}

Json vehicle_file_json(const Vehicle& vehicle) {
  return to_json(parse_settings(vehicle_text(vehicle), "vehicle"));
}

Json effective_settings(const PlanningProblem& problem) {
  return {{"vehicle", vehicle_file_json(problem.vehicle)},
          {"gravity_mps2", problem.gravity_mps2},
          {"start", start_json(problem.start)},
          {"goal", goal_json(problem.goal)},
          {"speed_mps", {{"max", problem.speed_max_mps}}},
          {"limits", limits_json(problem.limits)},
          {"planner", search_json(problem.search)}};
}

}  // namespace regoplan
