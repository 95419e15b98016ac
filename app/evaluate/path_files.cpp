#include "app/evaluate/path_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <span>

#include "app/settings/settings_node.h"
#include "planner/evaluation/course_bounds.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/value_range.h"
#include "terramech/tables/csv_table.h"
#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

/// Of points, and of candidates as `plan` writes them.
const std::vector<std::string>& known_columns() {
  static const std::vector<std::string> names{
      "x_m",      "y_m",       "speed_mps",      "time_s",        "z_m",
      "yaw_deg",  "steer_deg", "yaw_rate_rad_s", "curvature_1pm", "acceleration_mps2",
      "demand_n", "margin"};
  return names;
}

/// A CSV table of numbers under a header; cells are read when asked for.
class PathTable {
 public:
  explicit PathTable(const std::string& file) : file_(file) {
    if (std::filesystem::is_directory(file)) throw InputError(file + ": is a folder");
    std::ifstream stream(file);
    if (!stream) throw InputError(file + ": no such file, or it cannot be read");
    CsvTable table(stream, file, EmptyLines::kAnywhere);
    columns_ = table.columns();
    header_line_ = table.line();
    for (const char* column : {"x_m", "y_m"}) table.required_column(column, known_columns());
    while (auto cells = table.next()) rows_.push_back({table.line(), std::move(*cells)});
  }

  bool has(std::string_view column) const {
    return std::ranges::find(columns_, column) != columns_.end();
  }
  std::size_t rows() const { return rows_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }

  double number(std::size_t row, std::string_view column, const ValueRange& allowed,
                std::string_view why = "") const {
    const auto found = std::ranges::find(columns_, column);
    if (found == columns_.end()) {
      throw error(header_line_, fmt::format("column {} is missing", column));
    }
    const std::string& cell = rows_[row].cells[static_cast<std::size_t>(found - columns_.begin())];
    const std::optional<double> value = parse_number(cell);
    if (!value || !allowed.contains(*value)) {
      throw error(rows_[row].line, fmt::format("{}: {} is not valid (allowed: {}{})", column,
                                               cell.empty() ? "an empty cell" : cell,
                                               value ? allowed.text() : number_text(allowed), why));
    }
    return *value;
  }

  /// Nothing where the cell is empty.
  std::optional<double> number_if_any(std::size_t row, std::string_view column) const {
    const auto found = std::ranges::find(columns_, column);
    const std::string& cell = rows_[row].cells[static_cast<std::size_t>(found - columns_.begin())];
    if (cell.empty()) return std::nullopt;
    return number(row, column, kAnyNumber);
  }

  InputError error(std::int64_t line, std::string_view what) const {
    return InputError(fmt::format("{}:{}: {}", file_, line, what));
  }
  std::int64_t line(std::size_t row) const { return rows_[row].line; }
  const std::string& file() const { return file_; }

 private:
  struct Row {
    std::int64_t line;
    std::vector<std::string> cells;
  };
  std::string file_;
  std::int64_t header_line_ = 1;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

bool is_candidate(const PathTable& table) {
  return std::ranges::all_of(std::initializer_list<const char*>{"time_s", "yaw_deg", "speed_mps",
                                                                "steer_deg", "demand_n", "margin"},
                             [&](const char* column) { return table.has(column); });
}

/// Rows of a table that are driven in one direction; the last is the first of the next ones.
struct RowRange {
  std::size_t first = 0, last = 0;
  bool reverse = false;
  double stands_s = 0;  ///< before it
};

/// A point beyond the map is out of bounds, a verdict; one beyond its surroundings is a mistake.
PathCurve curve_of(const PathTable& table, const RowRange& rows, const GridFrame& map) {
  constexpr const char* kWhy = ", the map and as far around it as its diagonal";
  const double diagonal_m = std::hypot(map.east_m() - map.west_m, map.north_m - map.south_m());
  // Told to the centimetre, and within the diagonal.
  const auto at_least_m = [](double bound) { return std::ceil(bound * 100) / 100; };
  const auto at_most_m = [](double bound) { return std::floor(bound * 100) / 100; };
  const ValueRange x{.min = at_least_m(map.west_m - diagonal_m),
                     .max = at_most_m(map.east_m() + diagonal_m)};
  const ValueRange y{.min = at_least_m(map.south_m() - diagonal_m),
                     .max = at_most_m(map.north_m + diagonal_m)};
  std::vector<PathPoint> points;
  for (std::size_t i = rows.first; i <= rows.last && i < table.rows(); ++i) {
    points.push_back(
        {.x_m = table.number(i, "x_m", x, kWhy), .y_m = table.number(i, "y_m", y, kWhy)});
  }
  const std::int64_t last_line =
      table.rows() == 0 ? 1 : table.line(std::min(rows.last, table.rows() - 1));
  try {
    PathCurve curve(points);
    if (curve.length_m() <= kCourseLengthMax_m) return curve;
    throw InputError(fmt::format("the path is {:.4g} m long (allowed: at most {} m)",
                                 curve.length_m(), kCourseLengthMax_m));
  } catch (const InputError& bad) {
    throw table.error(last_line, bad.what());
  }
}

/// The curvature that sets the leading wheel to a steering angle; nothing where no wheel steers.
std::optional<double> curvature_for(const Vehicle& vehicle, double steer_rad) {
  const auto largest_at = [&](double curvature) {
    double largest = 0;
    for (const WheelMount& wheel : vehicle.wheels) {
      if (!wheel.steered || wheel.x_m <= vehicle.turn_centre_x_m) continue;
      const double angle = steer_angle_rad(vehicle, wheel, curvature);
      if (std::abs(angle) > std::abs(largest)) largest = angle;
    }
    return largest;
  };
  double low = -vehicle.curvature_max_1pm, high = vehicle.curvature_max_1pm;
  if (largest_at(high) == 0) return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (largest_at(middle) < steer_rad ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// At rest on a slope a vehicle may creep so fast against its direction.
constexpr double kCreep_mps = VehicleDynamics::kStandstillSpeed_mps;

/// What was commanded at a row of a candidate.
RecordedMoment moment_at(const PathTable& table, std::size_t i, const Vehicle& vehicle) {
  RecordedMoment moment;
  moment.time_s = table.number(i, "time_s", kAtLeast0);
  const double speed = table.number(i, "speed_mps", kAnyNumber);
  VehicleState& state = moment.state;
  state.x_m = table.number(i, "x_m", kAnyNumber);
  state.y_m = table.number(i, "y_m", kAnyNumber);
  state.yaw_rad = table.number(i, "yaw_deg", kAnyNumber) * kDegree;
  state.motion.vx_mps = speed;
  // What is left of a speed at rest says nothing of the direction that it was driven in.
  state.rim_speed_mps = std::abs(speed) > kCreep_mps ? speed : 0;
  if (table.has("yaw_rate_rad_s")) {
    state.motion.yaw_rate_rad_s = table.number(i, "yaw_rate_rad_s", kAnyNumber);
  }
  if (table.has("curvature_1pm")) {
    state.curvature_1pm = table.number(i, "curvature_1pm", kAnyNumber);
  } else {
    const auto curvature =
        curvature_for(vehicle, table.number(i, "steer_deg", kAnyNumber) * kDegree);
    if (!curvature) {
      throw table.error(table.line(i),
                        "column curvature_1pm is missing, and no wheel of the vehicle steers");
    }
    state.curvature_1pm = *curvature;
  }
  if (table.has("acceleration_mps2")) {
    state.rim_acceleration_mps2 = table.number(i, "acceleration_mps2", kAnyNumber);
  }
  return moment;
}

/// Backward differences, as the step that led to each row had it.
void add_accelerations(std::vector<RecordedMoment>& moments, double most_mps2) {
  for (std::size_t i = 1; i < moments.size(); ++i) {
    const RecordedMoment &a = moments[i - 1], &b = moments[i];
    const double rate = (b.state.motion.vx_mps - a.state.motion.vx_mps) / (b.time_s - a.time_s);
    moments[i].state.rim_acceleration_mps2 = std::clamp(rate, -most_mps2, most_mps2);
  }
}

/// The slowest moment about a change of direction ends one range and begins the next.
std::vector<RowRange> ranges_of(const std::vector<RecordedMoment>& moments) {
  const auto speed_mps = [](const RecordedMoment& at) { return at.state.motion.vx_mps; };
  const auto slower = [&](const RecordedMoment& a, const RecordedMoment& b) {
    return std::abs(speed_mps(a)) < std::abs(speed_mps(b));
  };
  std::vector<RowRange> ranges{{.first = 0, .last = moments.size() - 1}};
  std::optional<std::size_t> moved;  // the last moment that moves
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (std::abs(speed_mps(moments[i])) <= kCreep_mps) continue;
    const bool reverse = speed_mps(moments[i]) < 0;
    if (moved && reverse != ranges.back().reverse) {
      const std::span between(&moments[*moved], i + 1 - *moved);
      const auto slowest = std::min_element(between.begin(), between.end(), slower);
      ranges.back().last = *moved + static_cast<std::size_t>(slowest - between.begin());
      ranges.push_back({.first = ranges.back().last,
                        .last = moments.size() - 1,
                        .stands_s = moments[i].time_s - moments[*moved].time_s});
    }
    ranges.back().reverse = reverse;
    moved = i;
  }
  return ranges;
}

/// Without the ranges that get nowhere: about a place where it all but stands, a vehicle may drive
/// to and fro by less than what points of a curve are apart. They are parts of their neighbours.
std::vector<RowRange> that_get_on(const std::vector<RowRange>& ranges,
                                  const std::vector<RecordedMoment>& moments) {
  const auto gets_on = [&](const RowRange& range) {
    const VehicleState &from = moments[range.first].state, &to = moments[range.last].state;
    return std::hypot(to.x_m - from.x_m, to.y_m - from.y_m) >= PathCurve::kSpacingMin_m;
  };
  std::vector<RowRange> legs;
  for (const RowRange& range : ranges) {
    if (!gets_on(range)) {
      if (!legs.empty()) legs.back().last = range.last;
    } else if (!legs.empty() && legs.back().reverse == range.reverse) {
      legs.back().last = range.last;
    } else {
      legs.push_back(range);
      if (legs.size() == 1) legs.back().first = 0;
    }
  }
  return legs.empty() ? ranges : legs;
}

/// Speeds of a range's rows along its curve; the vehicle stands where its direction changes.
SpeedProfile speed_of(const std::vector<RecordedMoment>& moments, const RowRange& rows,
                      const PathCurve& curve) {
  std::vector<SpeedProfile::Node> nodes;
  for (std::size_t i = rows.first; i <= rows.last; ++i) {
    const bool changes = (i == rows.first && i > 0) || (i == rows.last && i + 1 < moments.size());
    const double along = (rows.reverse ? -1 : 1) * moments[i].state.motion.vx_mps;
    const double speed = changes ? 0 : std::max(0.0, along);
    const double s_m = curve.point_arc_m()[i - rows.first];
    if (!nodes.empty() && !(s_m > nodes.back().s_m)) {
      // The end's knot is the last row's, however near to it the rows before lie.
      const bool both_rest = nodes.size() > 1 && nodes[nodes.size() - 2].speed_mps + speed <= 0;
      if (i == rows.last || changes) nodes.back().speed_mps = both_rest ? 1e-3 : speed;
      continue;
    }
    const bool both_rest = !nodes.empty() && nodes.back().speed_mps + speed <= 0;
    nodes.push_back({s_m, both_rest ? 1e-3 : speed});
  }
  return SpeedProfile(std::move(nodes));
}

/// What sets the largest speed of a path.
std::string speed_limit_source(const PlanningProblem& problem, double speed_max_mps) {
  const bool is_vehicles = speed_max_mps == problem.vehicle.speed_max_mps;
  if (is_vehicles) return fmt::format("speed_max_mps of the vehicle {}", problem.vehicle.name);
  return speed_max_mps == problem.speed_max_mps ? "speed_mps.max of the scenario" : "--speed";
}

GivenPath candidate_path(const PathTable& table, const PlanningProblem& problem,
                         double speed_max_mps) {
  const Vehicle& vehicle = problem.vehicle;
  // Rolling downhill, the vehicle itself may be a little faster than its limit.
  constexpr double kRounding = 1e-3;
  const double fastest_mps = speed_max_mps * (1 + kRounding);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (std::abs(table.number(i, "speed_mps", kAnyNumber)) <= fastest_mps) continue;
    table.number(i, "speed_mps", {.min = -speed_max_mps, .max = speed_max_mps},
                 ", " + speed_limit_source(problem, speed_max_mps));
  }
  std::vector<RecordedMoment> moments;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double before_s = moments.empty() ? -1 : moments.back().time_s;
    moments.push_back(moment_at(table, i, vehicle));
    if (!(moments.back().time_s > before_s)) {
      throw table.error(table.line(i), fmt::format("time_s: {} is not valid (allowed: above {}, "
                                                   "the row before)",
                                                   moments.back().time_s, before_s));
    }
  }
  if (!table.has("acceleration_mps2")) add_accelerations(moments, vehicle.acceleration_max_mps2);
  std::vector<PathLeg> legs;
  for (const RowRange& rows : that_get_on(ranges_of(moments), moments)) {
    PathCurve curve = curve_of(table, rows, problem.map.elevation().frame);
    SpeedProfile speed = speed_of(moments, rows, curve);
    // A row that two legs share is of the former's record.
    std::vector<RecordedMoment> recorded;
    for (std::size_t i = legs.empty() ? rows.first : rows.first + 1; i <= rows.last; ++i) {
      recorded.push_back(moments[i]);
      recorded.back().s_m = curve.point_arc_m()[i - rows.first];
      // Before the first row nothing was driven.
      if (i > 0) recorded.back().state.direction_at_rest = rows.reverse ? -1 : 1;
    }
    legs.push_back({.curve = std::move(curve),
                    .speed = std::move(speed),
                    .recorded = std::move(recorded),
                    .reverse = rows.reverse,
                    .stands_s = rows.stands_s});
  }
  double margin_min = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < table.rows(); ++i) {
    margin_min = std::min(margin_min, table.number_if_any(i, "margin").value_or(margin_min));
  }
  return {.path = {.name = table.file(), .legs = std::move(legs)},
          .recorded_margin_min = margin_min,
          .notices = {}};
}

/// Whether all speeds of a table are meant backwards: the first that is not 0 tells.
bool drives_in_reverse(const PathTable& table) {
  for (std::size_t i = 0; table.has("speed_mps") && i < table.rows(); ++i) {
    const double speed = table.number(i, "speed_mps", kAnyNumber);
    if (speed != 0) return speed < 0;
  }
  return false;
}

/// The end of a path may stand, and so may its start, but nobody gets from one to the other so.
void refuse_rest_between(const PathTable& table, const std::vector<SpeedProfile::Node>& nodes) {
  // So slow nothing passes the bound of the drive's time; speeds between would round to 0.
  constexpr double kRest_mps = 1e-12;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (nodes[i - 1].speed_mps + nodes[i].speed_mps > kRest_mps) continue;
    throw table.error(table.line(table.rows() - 1),
                      fmt::format("speed_mps: at rest both {:.4g} m and {:.4g} m along the path, "
                                  "so it never ends (allowed: 0 only at the ends, with a speed "
                                  "on the way between them)",
                                  nodes[i - 1].s_m, nodes[i].s_m));
  }
}

/// Speeds that stand in the table, without their sign, as far as the vehicle's acceleration follows
/// them.
SpeedProfile given_speed(const PathTable& table, const PathCurve& curve,
                         const PlanningProblem& problem, double speed_max_mps,
                         std::vector<std::string>& notices) {
  const Vehicle& vehicle = problem.vehicle;
  const std::string limit = speed_limit_source(problem, speed_max_mps);
  std::vector<SpeedProfile::Node> nodes;
  const bool reverse = drives_in_reverse(table);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const bool end = i == 0 || i + 1 == table.rows();
    const char* ends = end ? "" : "; 0 only at the ends";
    const double speed =
        reverse
            ? -table.number(i, "speed_mps", {.min = -speed_max_mps, .max = 0, .max_excluded = !end},
                            fmt::format(", {}; all of a path in one direction{}", limit, ends))
            : table.number(i, "speed_mps", {.min = 0, .max = speed_max_mps, .min_excluded = !end},
                           fmt::format(", {}{}", limit, ends));
    const double s = curve.point_arc_m()[i];
    if (!nodes.empty() && !(s > nodes.back().s_m)) {
      nodes.back().speed_mps = speed;  // of points too near to each other the last counts
    } else {
      nodes.push_back({s, speed});
    }
  }
  refuse_rest_between(table, nodes);
  SpeedProfile profile = limited_by_acceleration(
      nodes, nodes.front().speed_mps, nodes.back().speed_mps, vehicle.acceleration_max_mps2);
  constexpr double kNoticed_mps = 1e-3;
  const auto lowered = std::ranges::find_if(nodes, [&](const SpeedProfile::Node& node) {
    return profile.at(node.s_m).speed_mps < node.speed_mps - kNoticed_mps;
  });
  if (lowered != nodes.end()) {
    notices.push_back(fmt::format(
        "{}: speeds are lowered to what the acceleration of {} m/s2 follows, first {:.1f} m along "
        "({:.2f} for {:.2f} m/s)",
        table.file(), vehicle.acceleration_max_mps2, lowered->s_m,
        profile.at(lowered->s_m).speed_mps, lowered->speed_mps));
  }
  return profile;
}

GivenPath point_path(const PathTable& table, const PlanningProblem& problem, double speed_max_mps) {
  PathCurve curve =
      curve_of(table, {.first = 0, .last = table.rows()}, problem.map.elevation().frame);
  std::vector<std::string> notices;
  if (curve.thinned() > 0) {
    notices.push_back(fmt::format("{}: {} points nearer than {} m to the one before are left out",
                                  table.file(), curve.thinned(), PathCurve::kSpacingMin_m));
  }
  std::vector<std::string> ignored;
  for (const std::string& column : table.columns()) {
    if (column != "x_m" && column != "y_m" && column != "speed_mps") ignored.push_back(column);
  }
  if (!ignored.empty()) {
    notices.push_back(
        fmt::format("{}: columns ignored: {}", table.file(), fmt::join(ignored, ", ")));
  }
  SpeedProfile speed = table.has("speed_mps")
                           ? given_speed(table, curve, problem, speed_max_mps, notices)
                           : limited_by_acceleration(
                                 {{0, speed_max_mps}, {curve.length_m(), speed_max_mps}},
                                 problem.start.speed_mps, 0, problem.vehicle.acceleration_max_mps2);
  return {.path = {.name = table.file(),
                   .legs = {{.curve = std::move(curve),
                             .speed = std::move(speed),
                             .reverse = drives_in_reverse(table)}}},
          .recorded_margin_min = {},
          .notices = std::move(notices)};
}

}  // namespace

GivenPath read_path(const std::string& file, const PlanningProblem& problem, double speed_max_mps) {
  const PathTable table(file);
  GivenPath given = is_candidate(table) ? candidate_path(table, problem, speed_max_mps)
                                        : point_path(table, problem, speed_max_mps);
  const ReferencePath& path = given.path;
  if (!(drive_steps(path) <= kDriveStepsMax)) {
    throw InputError(fmt::format("{}: at its speeds it takes {:.3g} s (allowed: at most {:.3g} s)",
                                 file, path.duration_s(), drive_time_max_s(path.speed_max_mps())));
  }
  return given;
}

}  // namespace regoplan
