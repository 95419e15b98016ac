#include "app/drive/drive_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/drive/broken_limits.h"
#include "app/page/plan_report_data.h"
#include "app/page/report_assets.h"
#include "app/page/report_page.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

using nlohmann::json;
constexpr std::size_t kRowsDrawnMax = 1000;
constexpr double kNone = DriveResult::kNone;

double rounded(double value, int decimals) {
  const double scale = std::pow(10, decimals);
  return std::round(value * scale) / scale;
}

double speed_mps(const DriveMoment& moment) {
  const BodyMotion& motion = moment.state.motion;
  return std::copysign(std::hypot(motion.vx_mps, motion.vy_mps), motion.vx_mps);
}

/// The margins at a time, linear between those that were worked out.
MarginMoment margins_at(const std::vector<MarginMoment>& margins, double time_s) {
  const auto above = std::ranges::lower_bound(margins, time_s, {}, &MarginMoment::time_s);
  if (above == margins.end()) {
    return {.time_s = time_s, .cornering = kNone, .tip_over = kNone, .traction = kNone};
  }
  if (above == margins.begin()) return *above;
  const MarginMoment &a = *(above - 1), &b = *above;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  const auto between = [&](double MarginMoment::*number) {
    return a.*number + share * (b.*number - a.*number);
  };
  return {.time_s = time_s,
          .s_m = between(&MarginMoment::s_m),
          .cornering = between(&MarginMoment::cornering),
          .tip_over = between(&MarginMoment::tip_over),
          .traction = between(&MarginMoment::traction)};
}

/// Cross-track error, slip, slip angle, sinkage and want of margin: the more, the worse.
std::vector<std::array<double, 5>> severities(const DriveResult& result) {
  const auto known = [](double value) { return std::isnan(value) ? -1e9 : value; };
  std::vector<std::array<double, 5>> rows;
  for (const DriveMoment& moment : result.moments) {
    const auto strain = [&](double WheelNow::*number) {
      return known(std::abs(largest_of_wheels(moment, number)));
    };
    rows.push_back({std::abs(moment.offset_m), strain(&WheelNow::slip),
                    strain(&WheelNow::slip_angle_rad), strain(&WheelNow::sinkage_m),
                    known(-margins_at(result.margins, moment.time_s).smallest())});
  }
  return rows;
}

/// The rows that are drawn, in order.
std::vector<std::size_t> drawn_rows(const DriveResult& result) {
  const auto severity = severities(result);
  const std::size_t count = severity.size(), kinds = std::tuple_size_v<std::array<double, 5>>;
  if (count == 0) return {};
  const std::size_t stretches = count <= kRowsDrawnMax ? count : (kRowsDrawnMax - 2) / kinds;
  std::set<std::size_t> rows{0, count - 1};
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t from = k * count / stretches, to = (k + 1) * count / stretches;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      std::size_t worst = from;
      for (std::size_t i = from; i < to; ++i) {
        if (severity[i][kind] > severity[worst][kind]) worst = i;
      }
      rows.insert(worst);
    }
  }
  return {rows.begin(), rows.end()};
}

TrajectoryPoint point_at(const PlanningProblem& problem, const DriveResult& result,
                         std::size_t row) {
  const DriveMoment& moment = result.moments[row];
  const VehicleState& state = moment.state;
  const MarginMoment margins = margins_at(result.margins, moment.time_s);
  const bool on_map = problem.map.inside(state.x_m, state.y_m);
  return {.time_s = moment.time_s,
          .x_m = state.x_m,
          .y_m = state.y_m,
          .z_m = on_map ? problem.map.height_m(state.x_m, state.y_m) : kNone,
          .yaw_rad = state.yaw_rad,
          .speed_mps = speed_mps(moment),
          .steer_rad = largest_of_wheels(moment, &WheelNow::steer_rad),
          .curvature_1pm = state.curvature_1pm,
          .slip_max = largest_of_wheels(moment, &WheelNow::slip),
          .slip_angle_max_rad = largest_of_wheels(moment, &WheelNow::slip_angle_rad),
          .sinkage_max_m = largest_of_wheels(moment, &WheelNow::sinkage_m),
          .demand_n = kNone,
          .supply_min_n = kNone,
          .supply_max_n = kNone,
          .cornering_margin = margins.cornering,
          .tip_over_margin = margins.tip_over,
          .traction_margin = margins.traction,
          .margin = margins.smallest()};
}

Candidate driven_path(const PlanningProblem& problem, const DriveRecord& record,
                      const std::vector<std::size_t>& rows) {
  const DriveResult& result = record.result;
  Candidate driven{.rank = 1,
                   .planner = std::string(name(record.settings.follower.kind)),
                   .length_m = result.length_m,
                   .duration_s = result.duration_s,
                   .energy_j = result.energy_j};
  for (const std::size_t row : rows) driven.points.push_back(point_at(problem, result, row));
  return driven;
}

Candidate planned_path(const ReferencePath& path) {
  constexpr int kPlaces = 1000;
  Candidate planned{.length_m = path.length_m(), .duration_s = path.duration_s()};
  for (int i = 0; i < kPlaces; ++i) {
    const double s_m = path.length_m() * i / (kPlaces - 1);
    const ReferencePath::Place at = path.place(s_m);
    const CurvePlace place = at.on_curve();
    planned.points.push_back({.time_s = at.time_s(),
                              .x_m = place.x_m,
                              .y_m = place.y_m,
                              .yaw_rad = place.heading_rad,
                              .speed_mps = at.speed().speed_mps,
                              .cornering_margin = kNone,
                              .tip_over_margin = kNone,
                              .traction_margin = kNone,
                              .margin = kNone});
  }
  return planned;
}

/// Columns of the driven path beyond those of any path.
class DrivenColumns {
 public:
  DrivenColumns(json& points, const DriveResult& result, const std::vector<std::size_t>& rows)
      : points_(points), result_(result), rows_(rows) {}

  template <class Value>
  void add(const std::string& name, int decimals, const Value& value) {
    json numbers = json::array();
    for (const std::size_t row : rows_) {
      numbers.push_back(rounded(value(result_.moments[row]), decimals));
    }
    points_[name] = std::move(numbers);
  }

  /// Of one wheel, in a unit.
  void add(const std::string& name, int decimals, std::size_t wheel, double WheelNow::*number,
           double unit = 1) {
    add(name, decimals, [&](const DriveMoment& moment) {
      return wheel < moment.wheels.size() ? moment.wheels[wheel].*number / unit : kNone;
    });
  }

 private:
  json& points_;
  const DriveResult& result_;
  const std::vector<std::size_t>& rows_;
};

void add_motion(DrivenColumns& columns, const ReferencePath& path) {
  using M = DriveMoment;
  columns.add("s_m", 3, [](const M& m) { return m.s_m; });
  columns.add("cross_track_m", 4, [](const M& m) { return m.offset_m; });
  columns.add("course_error_deg", 3, [](const M& m) { return degrees(m.heading_error_rad); });
  columns.add("speed_planned_mps", 3, [&](const M& m) {
    const ReferencePath::Place place = path.place(m.s_m);
    return place.leg.direction() * place.speed().speed_mps;
  });
  columns.add("rim_speed_asked_mps", 3, [](const M& m) { return m.asked.speed_target_mps; });
  columns.add("rim_speed_mps", 3, [](const M& m) { return m.state.rim_speed_mps; });
  columns.add("curvature_planned_1pm", 5, [&](const M& m) {
    const ReferencePath::Place place = path.place(m.s_m);
    return place.leg.curvature_1pm(place.s_m);
  });
  columns.add("curvature_asked_1pm", 5, [](const M& m) { return m.asked.curvature_target_1pm; });
  columns.add("seen_off_m", 4, [](const M& m) {
    return std::hypot(m.seen.x_m - m.state.x_m, m.seen.y_m - m.state.y_m);
  });
}

void add_wheels(DrivenColumns& columns, const Vehicle& vehicle) {
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const std::string& name = vehicle.wheels[i].name;
    columns.add("slip_" + name, 4, i, &WheelNow::slip);
    columns.add("slip_angle_" + name + "_deg", 3, i, &WheelNow::slip_angle_rad, kDegree);
    columns.add("steer_" + name + "_deg", 3, i, &WheelNow::steer_rad, kDegree);
    columns.add("torque_" + name + "_nm", 2, i, &WheelNow::torque_nm);
    columns.add("sinkage_" + name + "_m", 5, i, &WheelNow::sinkage_m);
    columns.add("load_" + name + "_n", 1, i, &WheelNow::load_n);
  }
}

/// The way driven by each row: of all rows, not only of those that are drawn.
json way_driven(const DriveResult& result, const std::vector<std::size_t>& rows) {
  json ways = json::array();
  double way_m = 0;
  std::size_t row = 0;
  for (const std::size_t until : rows) {
    for (; row < until; ++row) {
      const VehicleState &a = result.moments[row].state, &b = result.moments[row + 1].state;
      way_m += std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    }
    ways.push_back(rounded(way_m, 3));
  }
  return ways;
}

/// Soils below the vehicle; zones of a truth stand after the map's soils.
void add_soils(json& data, const DriveResult& result, const std::vector<std::size_t>& rows,
               const TrueWorld& world) {
  std::vector<std::string> names;
  for (const json& soil : data["map"]["soils"]) names.push_back(soil.at("name"));
  json column = json::array();
  for (const std::size_t row : rows) {
    const VehicleState& state = result.moments[row].state;
    const std::string soil = world.soil_name(state.x_m, state.y_m);
    const auto known = std::ranges::find(names, soil);
    column.push_back(soil.empty() ? -1 : known - names.begin());
    if (!soil.empty() && known == names.end()) names.push_back(soil);
  }
  for (std::size_t i = data["map"]["soils"].size(); i < names.size(); ++i) {
    data["map"]["soils"].push_back({{"name", names[i]}, {"zone", true}});
  }
  data["candidates"][0]["points"]["soil"] = std::move(column);
}

/// Where the drive begins and, of a path that does not lead to the goal, where it is to end.
void add_ends(json& data, const ReferencePath& path, const DriveRecord& record,
              const TrueWorld& world) {
  const std::vector<DriveMoment>& moments = record.result.moments;
  const VehicleState start =
      moments.empty() ? start_of(path, world.known_vehicle()) : moments.front().state;
  data["problem"]["start"] = {{"x_m", start.x_m},
                              {"y_m", start.y_m},
                              {"heading_deg", degrees(start.yaw_rad)},
                              {"speed_mps", start.motion.vx_mps}};
  if (record.ends_in_goal) return;
  const CurvePlace end = path.end();
  data["problem"]["goal"] = {{"x_m", end.x_m}, {"y_m", end.y_m}, {"radius_m", 0}, {"label", "End"}};
}

json zones_json(const std::vector<SoilZone>& zones) {
  json rows = json::array();
  for (const SoilZone& zone : zones) {
    json corners = json::array();
    for (const PathPoint& corner : zone.corners) corners.push_back({corner.x_m, corner.y_m});
    rows.push_back({{"name", zone.name}, {"corners", corners}});
  }
  return rows;
}

json report_data(const PlanningProblem& problem, const ReferencePath& path,
                 const DriveRecord& record, const TrueWorld& world) {
  const DriveResult& result = record.result;
  const std::vector<std::size_t> rows = drawn_rows(result);
  PlanResult picture{.candidates = {driven_path(problem, record, rows)},
                     .overturned = {planned_path(path)},
                     .seed = record.settings.seed,
                     .interrupted = result.interrupted};
  json data = plan_report_data(problem, picture);
  data["kind"] = "drive";
  data["drive"] = json::parse(drive_json(record, problem));
  data["truth_text"] = record.truth_text;
  data["zones"] = zones_json(record.zones);
  data["status"] = data["drive"]["status"];
  json& driven = data["candidates"][0];
  driven["points_total"] = result.moments.size();
  DrivenColumns columns(driven["points"], result, rows);
  add_motion(columns, path);
  add_wheels(columns, problem.vehicle);
  driven["points"]["way_m"] = way_driven(result, rows);
  add_soils(data, result, rows, world);
  add_ends(data, path, record, world);
  data["rejected_states"] = broken_limits_json(problem.limits, result);
  return data;
}

/// What must be known before the figures.
std::vector<std::string> drive_lead(const DriveRecord& record) {
  const DriveResult& result = record.result;
  std::vector<std::string> lead;
  if (result.interrupted) lead.emplace_back("Interrupted: this is what was driven by then.");
  for (const LimitBroken& one : result.broken) lead.push_back(broken_text(one));
  const auto short_name = [](const std::string& file) {
    return std::filesystem::path(file).filename().string();
  };
  lead.push_back(fmt::format(
      "Driven by {} in {}, {}.", name(record.settings.follower.kind),
      record.truth.empty()
          ? "the world as it is planned"
          : fmt::format("a world that differs as {} says", short_name(record.truth)),
      record.sensors.empty() ? "with exact sensors"
                             : fmt::format("with sensors {}, seed {}", short_name(record.sensors),
                                           record.settings.seed)));
  return lead;
}

}  // namespace

std::string drive_report(const PlanningProblem& problem, const ReferencePath& path,
                         const DriveRecord& record, const TrueWorld& world) {
  return render({.command = "drive",
                 .title = fmt::format("Drive of {}", problem.vehicle.name),
                 .headline = drive_headline(record),
                 .lead = drive_lead(record),
                 .body_html = report_assets::kDriveHtml,
                 .script = report_assets::kDriveScript,
                 .data_json = json_for_html(report_data(problem, path, record, world))});
}

}  // namespace regoplan
