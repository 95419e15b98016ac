#include "app/page/plan_report_data.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/page/report_layers.h"
#include "app/page/report_map.h"
#include "app/page/spread_json.h"
#include "app/settings/effective_settings.h"
#include "maps/ground_finder.h"
#include "planner/driving/wheel_loads_along.h"
#include "planner/problem/rejection_text.h"
#include "planner/verdict/pareto.h"
#include "planner/verdict/ranking.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

using nlohmann::json;

constexpr std::size_t kPointsOfPathMax = 1000;
constexpr std::size_t kPointsOfAllMax = 8000;
constexpr std::size_t kRejectedStatesMax = 4000;

/// Short to write; what is not finite stays what it is.
double rounded(double value, int decimals) {
  const double scale = std::pow(10, decimals);
  return std::round(value * scale) / scale;
}

/// Smaller than every number where the margin is not known, so that such a point is never dropped.
double severity_order(const TrajectoryPoint& point) {
  return std::isnan(point.margin) ? -std::numeric_limits<double>::infinity() : point.margin;
}

std::vector<TrajectoryPoint> thinned(const std::vector<TrajectoryPoint>& points,
                                     std::size_t count_max) {
  if (points.size() <= count_max) return points;
  std::vector<TrajectoryPoint> kept{points.front()};
  const std::size_t stretches = count_max - 2, inner = points.size() - 2;
  for (std::size_t k = 0; k < stretches; ++k) {
    const auto at = [&](std::size_t i) {
      return points.begin() + 1 + static_cast<std::ptrdiff_t>(i * inner / stretches);
    };
    kept.push_back(
        *std::min_element(at(k), at(k + 1), [](const TrajectoryPoint& a, const TrajectoryPoint& b) {
          return severity_order(a) < severity_order(b);
        }));
  }
  kept.push_back(points.back());
  return kept;
}

/// A column for each wheel: `load_front_left_n`.
void add_wheel_loads(const PlanningProblem& problem, const std::vector<TrajectoryPoint>& points,
                     json& columns) {
  const auto loads = wheel_loads_along_n(problem, points);
  for (std::size_t wheel = 0; wheel < problem.vehicle.wheels.size(); ++wheel) {
    json numbers = json::array();
    for (const std::vector<double>& of_point : loads)
      numbers.push_back(rounded(of_point[wheel], 1));
    columns["load_" + problem.vehicle.wheels[wheel].name + "_n"] = std::move(numbers);
  }
}

/// Columns of how the vehicle lies on the ground: `pitch_deg` nose up, `roll_deg` left side up, and
/// `slope_deg`, the angle between its plane and the horizontal.
void add_attitude(const PlanningProblem& problem, const std::vector<TrajectoryPoint>& points,
                  json& columns) {
  const GroundFinder ground(problem.map, problem.vehicle);
  json pitch = json::array(), roll = json::array(), slope = json::array();
  const auto shown = [](double angle_rad, bool known) {
    return known ? json(rounded(degrees(angle_rad), 2)) : json();
  };
  for (const TrajectoryPoint& point : points) {
    const GroundPatch patch = ground.at(point.x_m, point.y_m, point.yaw_rad);
    const double forward = patch.slope_forward;
    pitch.push_back(shown(std::atan(forward), patch.known));
    roll.push_back(shown(std::atan(patch.slope_left / std::hypot(1, forward)), patch.known));
    slope.push_back(shown(patch.tilt_rad(), patch.known));
  }
  columns["pitch_deg"] = std::move(pitch);
  columns["roll_deg"] = std::move(roll);
  columns["slope_deg"] = std::move(slope);
}

/// Columns of what the drives give: `energy_j` so far, and on the way to the next point `power_w`
/// and `energy_per_m_j`, null where it creeps.
void add_energy(const std::vector<TrajectoryPoint>& points, json& columns) {
  json energy = json::array(), power = json::array(), per_metre = json::array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TrajectoryPoint& from = points[i];
    const TrajectoryPoint& to = points[std::min(i + 1, points.size() - 1)];
    const double gained_j = to.energy_j - from.energy_j, lasts_s = to.time_s - from.time_s;
    const double way_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    constexpr double kCreeps_m = 0.05;
    energy.push_back(rounded(from.energy_j, 1));
    power.push_back(lasts_s > 0 ? json(rounded(gained_j / lasts_s, 1)) : json());
    per_metre.push_back(way_m > kCreeps_m ? json(rounded(gained_j / way_m, 2)) : json());
  }
  columns["energy_j"] = std::move(energy);
  columns["power_w"] = std::move(power);
  columns["energy_per_m_j"] = std::move(per_metre);
}

json points_json(const PlanningProblem& problem, const std::vector<TrajectoryPoint>& points) {
  json columns = json::object();
  const auto column = [&](const char* name, int decimals, const auto& value) {
    json numbers = json::array();
    for (const TrajectoryPoint& point : points)
      numbers.push_back(rounded(std::invoke(value, point), decimals));
    columns[name] = std::move(numbers);
  };
  using P = TrajectoryPoint;
  column("time_s", 3, &P::time_s);
  column("x_m", 3, &P::x_m);
  column("y_m", 3, &P::y_m);
  column("z_m", 3, &P::z_m);
  column("yaw_deg", 2, [](const P& p) { return degrees(p.yaw_rad); });
  column("speed_mps", 3, &P::speed_mps);
  column("steer_deg", 2, [](const P& p) { return degrees(p.steer_rad); });
  column("curvature_1pm", 5, &P::curvature_1pm);
  column("slip_max", 4, &P::slip_max);
  column("slip_angle_max_deg", 2, [](const P& p) { return degrees(p.slip_angle_max_rad); });
  column("sinkage_max_m", 5, &P::sinkage_max_m);
  column("torque_max_nm", 2, &P::torque_max_nm);
  column("demand_n", 1, &P::demand_n);
  column("supply_min_n", 1, &P::supply_min_n);
  column("supply_max_n", 1, &P::supply_max_n);
  column("cornering_margin", 4, &P::cornering_margin);
  column("tip_over_margin", 4, &P::tip_over_margin);
  column("traction_margin", 4, &P::traction_margin);
  column("margin", 4, &P::margin);
  json soils = json::array();
  for (const TrajectoryPoint& point : points) soils.push_back(point.soil);
  columns["soil"] = std::move(soils);
  add_wheel_loads(problem, points, columns);
  add_attitude(problem, points, columns);
  add_energy(points, columns);
  return columns;
}

/// Null where a path is as the search found it.
json improved_json(const std::optional<Improvement>& improvement) {
  if (!improvement) return nullptr;
  return {{"cost_before", improvement->cost_before}, {"cost_after", improvement->cost_after}};
}

json candidate_json(const PlanningProblem& problem, const Candidate& candidate,
                    std::size_t points_max) {
  json row{{"rank", candidate.rank},
           {"planner", candidate.planner},
           {"seed", candidate.seed},
           {"length_m", candidate.length_m},
           {"duration_s", candidate.duration_s},
           {"energy_j", candidate.energy_j},
           {"margin_min", candidate.margin_min},
           {"margin_worst_tenth", candidate.margin_worst_tenth},
           {"improved", improved_json(candidate.improvement)},
           {"limiting",
            {{"margin", name(candidate.limiting.margin)},
             {"x_m", candidate.limiting.x_m},
             {"y_m", candidate.limiting.y_m},
             {"time_s", candidate.limiting.time_s}}},
           {"verified",
            {{"passed", candidate.verified.passed},
             {"reason", candidate.verified.reason},
             {"margin_min", candidate.verified.margin_min},
             {"max_deviation_m", candidate.verified.deviation_max_m}}},
           {"points_total", candidate.points.size()},
           {"points", points_json(problem, thinned(candidate.points, points_max))}};
  add_spread(row, candidate.spread);
  return row;
}

json candidates_json(const PlanningProblem& problem, const std::vector<Candidate>& candidates) {
  const std::size_t points_max = std::min(
      kPointsOfPathMax,
      std::max<std::size_t>(50, kPointsOfAllMax / std::max<std::size_t>(1, candidates.size())));
  const std::vector<bool> pareto = pareto_best(candidates);
  json rows = json::array();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    rows.push_back(candidate_json(problem, candidates[i], points_max));
    rows.back()["pareto"] = static_cast<bool>(pareto[i]);
  }
  return rows;
}

json what_if_json(const WhatIf& what_if) {
  json row = {{"question", what_if.question},
              {"feasible", what_if.feasible},
              {"x_m", what_if.x_m},
              {"y_m", what_if.y_m},
              {"time_s", what_if.time_s},
              {"margin_min", what_if.margin_min},
              {"reason", nullptr},
              {"end_shift_m", nullptr},
              {"probability", nullptr},
              {"driven", what_if.driven}};
  if (what_if.probability) row["probability"] = what_if.probability->share;
  if (what_if.reason) row["reason"] = name(*what_if.reason);
  if (what_if.end_shift_m) row["end_shift_m"] = *what_if.end_shift_m;
  return row;
}

/// What was given up, with the paths of those that opened the way.
json relaxed_json(const PlanningProblem& problem, const std::vector<RelaxedAnswer>& answers) {
  json rows = json::array();
  for (const RelaxedAnswer& answer : answers) {
    rows.push_back({{"given_up", answer.given_up}, {"path", nullptr}});
    if (answer.opened)
      rows.back()["path"] = candidate_json(problem, *answer.opened, kPointsOfPathMax);
  }
  return rows;
}

json rejected_states_json(const std::vector<RejectedState>& states) {
  const std::size_t count = std::min(states.size(), kRejectedStatesMax);
  json rows = json::array();
  for (std::size_t k = 0; k < count; ++k) {
    const RejectedState& state = states[k * states.size() / count];
    const double si_per_shown = quantity(state.reason).si_per_shown;
    const auto shown = [&](double Exceeded::*number) {
      return state.exceeded ? json(rounded((*state.exceeded).*number / si_per_shown, 5)) : json();
    };
    rows.push_back({{"reason", name(state.reason)},
                    {"x_m", rounded(state.x_m, 3)},
                    {"y_m", rounded(state.y_m, 3)},
                    {"yaw_deg", rounded(degrees(state.yaw_rad), 2)},
                    {"speed_mps", rounded(state.speed_mps, 3)},
                    {"curvature_1pm", rounded(state.curvature_1pm, 5)},
                    {"value", shown(&Exceeded::found)},
                    {"limit", shown(&Exceeded::limit)}});
  }
  return rows;
}

json rejected_json(const PlanResult& result) {
  json counts = json::array();  // not an object: the order of the checks matters
  for (int k = 0; k < kRejectionCount; ++k)
    counts.push_back({{"reason", name(static_cast<Rejection>(k))},
                      {"count", result.rejected[static_cast<std::size_t>(k)]}});
  return counts;
}

std::string drive_law_name(DriveLaw law) {
  switch (law) {
    case DriveLaw::kKinematic:
      return "kinematic";
    case DriveLaw::kEqualTorque:
      return "equal_torque";
    case DriveLaw::kEqualSpeed:
      return "equal_speed";
  }
  return "";
}

json vehicle_json(const Vehicle& vehicle) {
  json wheels = json::array();
  for (const WheelMount& wheel : vehicle.wheels)
    wheels.push_back({{"name", wheel.name},
                      {"x_m", wheel.x_m},
                      {"y_m", wheel.y_m},
                      {"steered", wheel.steered},
                      {"driven", wheel.driven}});
  const BodyBox& body = vehicle.body;
  return {{"name", vehicle.name},
          {"source", vehicle.source},
          {"mass_kg", vehicle.mass_kg},
          {"yaw_inertia_kgm2", vehicle.yaw_inertia_kgm2},
          {"cg_height_m", vehicle.cg_height_m},
          {"wheel_radius_m", vehicle.wheel.radius_m},
          {"wheel_width_m", vehicle.wheel.width_m},
          {"wheels", wheels},
          {"suspension",
           vehicle.suspension == Suspension::kRockerBogie ? "rocker_bogie" : "equal_springs"},
          {"drive_law", drive_law_name(vehicle.drive_law)},
          {"turn_centre_x_m", vehicle.turn_centre_x_m},
          {"body",
           {{"x_min_m", body.x_min_m},
            {"x_max_m", body.x_max_m},
            {"y_min_m", body.y_min_m},
            {"y_max_m", body.y_max_m},
            {"clearance_m", body.clearance_m},
            {"height_m", body.height_m}}},
          {"speed_max_mps", vehicle.speed_max_mps},
          {"acceleration_max_mps2", vehicle.acceleration_max_mps2},
          {"curvature_max_1pm", vehicle.curvature_max_1pm},
          {"curvature_rate_max_1pms", vehicle.curvature_rate_max_1pms},
          {"steer_angle_max_deg", degrees(vehicle.steer_angle_max_rad)},
          {"step_max_m", vehicle.step_max_m},
          {"torque_max_nm", vehicle.torque_max_nm ? json(*vehicle.torque_max_nm) : json()}};
}

json search_json(const Search& search) {
  const Objective& objective = search.objective;
  json row = {{"planner", search.planner},
              {"objective",
               {{"per_s", objective.per_s},
                {"per_m", objective.per_m},
                {"per_j", objective.per_j},
                {"per_exposed_s", objective.per_exposed_s},
                {"exposed_below", objective.exposed_below}}},
              {"improve", search.improve},
              {"seed", search.seed},
              {"candidates", search.candidates},
              {"soil_draws", search.soil_draws},
              {"threads", search.threads}};
  if (search.time_s) row["time_s"] = *search.time_s;
  if (search.iterations) row["iterations"] = *search.iterations;
  return row;
}

json problem_json(const PlanningProblem& problem) {
  const StartState& start = problem.start;
  const Goal& goal = problem.goal;
  json limits = limits_json(problem.limits);
  limits["speed_max_mps"] = problem.speed_max_mps;
  json row = {
      {"start",
       {{"x_m", start.x_m},
        {"y_m", start.y_m},
        {"heading_deg", degrees(start.heading_rad)},
        {"speed_mps", start.speed_mps}}},
      {"goal",
       {{"x_m", goal.x_m},
        {"y_m", goal.y_m},
        {"radius_m", goal.radius_m},
        {"speed_max_mps", goal.speed_max_mps}}},
      {"limits", limits},
      {"vehicle", vehicle_json(problem.vehicle)},
      {"wheel_variant",
       problem.wheel_variant == WheelVariant::kYoshida2004 ? "yoshida2004" : "ishigami2007"},
      {"gravity_mps2", problem.gravity_mps2},
      {"search", search_json(problem.search)}};
  if (goal.heading_rad) {
    row["goal"]["heading_deg"] = degrees(*goal.heading_rad);
    row["goal"]["heading_tolerance_deg"] = degrees(goal.heading_tolerance_rad);
  }
  return row;
}

}  // namespace

json plan_report_data(const PlanningProblem& problem, const PlanResult& result) {
  json data = {{"kind", "plan"},
               {"version", REGOPLAN_VERSION},
               {"status", name(result.status)},
               {"reason", result.reason},
               {"certificate", nullptr},
               {"interrupted", result.interrupted},
               {"seed", result.seed},
               {"propagations", result.propagations},
               {"before_search", json::array()},
               {"planning_time_s", result.planning_time_s},
               {"verification_time_s", result.verification_time_s},
               {"least_duration_s", nullptr},
               {"doubtful", !result.candidates.empty() &&
                                is_doubtful(result.candidates.front(), problem.limits)},
               {"problem", problem_json(problem)},
               {"map", report_map(problem.map)},
               {"candidates", candidates_json(problem, result.candidates)},
               {"overturned", candidates_json(problem, result.overturned)},
               {"what_ifs", json::array()},
               {"relaxed", relaxed_json(problem, result.relaxed)},
               {"rejected", rejected_json(result)},
               {"rejected_states", rejected_states_json(result.rejected_states)}};
  for (const TimedStep& timed : result.before_search) {
    data["before_search"].push_back({{"step", timed.step}, {"time_s", timed.time_s}});
  }
  if (result.rasters) data["map"]["layers"] = report_layers(*result.rasters);
  if (result.least_duration_s) data["least_duration_s"] = *result.least_duration_s;
  if (result.certificate) data["certificate"] = *result.certificate;
  for (const WhatIf& what_if : result.what_ifs) data["what_ifs"].push_back(what_if_json(what_if));
  return data;
}

}  // namespace regoplan
