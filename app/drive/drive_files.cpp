#include "app/drive/drive_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "planner/problem/rejection_text.h"
#include "terramech/basics/angles.h"
#include "terramech/tables/csv_cells.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

std::string stem(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

/// A number, or null where there is none.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json place(double x_m, double y_m, double s_m, double time_s) {
  return {{"x_m", x_m}, {"y_m", y_m}, {"s_m", s_m}, {"time_s", time_s}};
}

Json limits_json(const DriveResult& result) {
  Json broken = Json::array();
  for (const LimitBroken& one : result.broken) {
    const double si = quantity(one.limit).si_per_shown;
    broken.push_back({{"limit", name(one.limit)},
                      {"first", place(one.x_m, one.y_m, one.s_m, one.time_s)},
                      {"value", one.first.found / si},
                      {"worst", one.worst / si},
                      {"allowed", one.first.limit / si}});
  }
  return broken;
}

template <class Value>
Json by_wheel(const std::vector<DriveMoment>& moments, std::size_t wheel, const Value& value) {
  Json values = Json::array();
  for (const DriveMoment& moment : moments) {
    values.push_back(wheel < moment.wheels.size() ? number(value(moment.wheels[wheel])) : Json());
  }
  return values;
}

template <class Value>
Json by_moment(const std::vector<DriveMoment>& moments, const Value& value) {
  Json values = Json::array();
  for (const DriveMoment& moment : moments) values.push_back(number(value(moment)));
  return values;
}

}  // namespace

std::string drive_csv(const DriveRecord& record, const Vehicle& vehicle) {
  std::string text = "drive_id,time_s,x_m,y_m,yaw_deg,roll_deg,pitch_deg";
  // A channel that a suite has not got has no columns.
  const std::optional<SensorSuite>& suite = record.settings.sensors;
  const bool turning = !suite || suite->wheel_speed, torques = !suite || suite->torque;
  const bool depths = !suite || suite->sinkage;
  const auto columns = [&](bool wanted, std::string_view before, std::string_view after) {
    for (const WheelMount& wheel : vehicle.wheels) {
      if (wanted)
        text += fmt::format(",{}", text_cell(fmt::format("{}{}{}", before, wheel.name, after)));
    }
  };
  columns(turning, "wheel_speed_", "_rad_s");
  columns(true, "steer_", "_deg");
  columns(torques, "torque_", "_nm");
  columns(depths, "sinkage_", "_m");
  text += "\n";
  const std::string id = own_text_cell(
      fmt::format("{}-{}-{}", stem(record.scenario), stem(record.path), record.settings.seed));
  for (const SensedRow& row : record.result.rows) {
    text += id + "," + number_cell(row.time_s) + "," + number_cell(row.x_m) + "," +
            number_cell(row.y_m);
    for (const double angle : {row.yaw_rad, row.roll_rad, row.pitch_rad}) {
      text += "," + number_cell(degrees(angle));
    }
    const auto cells = [&](bool wanted, const std::vector<double>& values, double unit) {
      for (std::size_t i = 0; wanted && i < vehicle.wheels.size(); ++i) {
        text += ",";
        if (i < values.size()) text += number_cell(values[i] * unit);
      }
    };
    cells(turning, row.wheel_speed_rad_s, 1);
    cells(true, row.steer_rad, degrees(1));
    cells(torques, row.torque_nm, 1);
    cells(depths, row.sinkage_m, 1);
    text += "\n";
  }
  return text;
}

std::string drive_json(const DriveRecord& record, const PlanningProblem& problem) {
  const DriveResult& result = record.result;
  const SteeringLaw& law = result.law;
  const double si = result.reason ? quantity(*result.reason).si_per_shown : 1;
  const auto& exceeded = result.exceeded;
  Json margins{
      {"cornering", Json()}, {"tip_over", Json()}, {"traction", Json()}, {"smallest", Json()}};
  if (const auto& smallest = result.smallest_margin) {
    margins = {
        {"cornering", result.margin_cornering_min},
        {"tip_over", result.margin_tip_over_min},
        {"traction", result.margin_traction_min},
        {"smallest",
         {{"margin", smallest->smallest()}, {"s_m", smallest->s_m}, {"time_s", smallest->time_s}}}};
  }
  const bool whole = result.reached && result.within_limits();
  Json json{{"status", whole            ? "reached"
                       : result.reached ? "limits_broken"
                                        : "not_reached"},
            {"reason", result.reason ? name(*result.reason) : ""},
            {"place", place(result.x_m, result.y_m, result.s_m, result.time_s)},
            {"value", exceeded ? Json(exceeded->found / si) : Json()},
            {"allowed", exceeded ? Json(exceeded->limit / si) : Json()},
            {"goal", record.ends_in_goal ? "goal of the scenario" : "end of the path"},
            {"cross_track_rms_m", result.cross_track_rms_m},
            {"cross_track_max_m", result.cross_track_max_m},
            {"deviation_allowed_m", record.settings.deviation_max_m},
            {"duration_s", result.duration_s},
            {"length_m", result.length_m},
            {"energy_j", result.energy_j},
            {"margins_min", margins},
            {"limits_broken", limits_json(result)},
            {"follower", name(record.settings.follower.kind)},
            {"steering_law",
             {{"lookahead_wheelbases", law.lookahead_wheelbases},
              {"lookahead_s", law.lookahead_s},
              {"damping", law.damping},
              {"reaction_s", law.reaction_s},
              {"slip_memory_s", law.slip_memory_s}}},
            {"sensors", record.sensors.empty() ? "exact" : record.sensors},
            {"scenario", record.scenario},
            {"path", record.path},
            {"vehicle", problem.vehicle.name},
            {"gravity_mps2", problem.gravity_mps2},
            {"seed", record.settings.seed},
            {"version", REGOPLAN_VERSION},
            {"interrupted", result.interrupted}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string truth_json(const DriveRecord& record, const TrueWorld& world) {
  const std::vector<DriveMoment>& moments = record.result.moments;
  Json wheels = Json::object();
  const std::vector<WheelMount>& mounts = world.known_vehicle().wheels;
  for (std::size_t i = 0; i < mounts.size(); ++i) {
    const auto values = [&](const auto& value) { return by_wheel(moments, i, value); };
    wheels[mounts[i].name] = {
        {"slip", values([](const WheelNow& w) { return w.slip; })},
        {"slip_angle_deg", values([](const WheelNow& w) { return degrees(w.slip_angle_rad); })},
        {"load_n", values([](const WheelNow& w) { return w.load_n; })},
        {"torque_nm", values([](const WheelNow& w) { return w.torque_nm; })},
        {"sinkage_m", values([](const WheelNow& w) { return w.sinkage_m; })}};
  }
  Json soils = Json::array();
  for (const DriveMoment& moment : moments) {
    soils.push_back(world.soil_name(moment.state.x_m, moment.state.y_m));
  }
  const auto values = [&](const auto& value) { return by_moment(moments, value); };
  const Json json{
      {"truth_file", record.truth},
      {"truth", record.truth_text},
      {"seed", record.settings.seed},
      {"time_s", values([](const DriveMoment& m) { return m.time_s; })},
      {"x_m", values([](const DriveMoment& m) { return m.state.x_m; })},
      {"y_m", values([](const DriveMoment& m) { return m.state.y_m; })},
      {"yaw_deg", values([](const DriveMoment& m) { return degrees(m.state.yaw_rad); })},
      {"speed_mps", values([](const DriveMoment& m) {
         return std::hypot(m.state.motion.vx_mps, m.state.motion.vy_mps);
       })},
      {"s_m", values([](const DriveMoment& m) { return m.s_m; })},
      {"cross_track_m", values([](const DriveMoment& m) { return m.offset_m; })},
      {"soil", soils},
      {"wheels", wheels}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string broken_text(const LimitBroken& broken) {
  return fmt::format(
      "Limit broken: {} at worst, first at ({:.2f}, {:.2f}), {:.1f} s.",
      rejection_text(broken.limit, Exceeded{.found = broken.worst, .limit = broken.first.limit}),
      broken.x_m, broken.y_m, broken.time_s);
}

std::string drive_headline(const DriveRecord& record) {
  const DriveResult& r = record.result;
  const std::string goal = record.ends_in_goal ? "goal" : "end of the path";
  const std::string kept = fmt::format("cross-track error {:.3f} m rms, {:.3f} m at most",
                                       r.cross_track_rms_m, r.cross_track_max_m);
  if (r.interrupted) return fmt::format("Interrupted after {:.1f} s; {}.", r.duration_s, kept);
  if (r.reached && r.within_limits()) {
    return fmt::format("Reached the {} in {:.1f} s within every limit; {}.", goal, r.duration_s,
                       kept);
  }
  return fmt::format("{} the {}: {} at ({:.2f}, {:.2f}), {:.1f} m along, {:.1f} s; {}.",
                     r.reached ? "Broke a limit on the way to" : "Did not reach", goal,
                     rejection_text(*r.reason, r.exceeded), r.x_m, r.y_m, r.s_m, r.time_s, kept);
}

}  // namespace regoplan
