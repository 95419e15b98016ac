#include "tests/app/plan_report_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

constexpr double kSide_m = 200;
constexpr double kWest_m = 1000, kNorth_m = 5200;  // not at 0: coordinates must show as they are

struct Crater {
  double x_m, y_m, radius_m;
};
constexpr std::array<Crater, 9> kCraters{{{60, 70, 22},
                                          {120, 60, 14},
                                          {105, 118, 26},
                                          {165, 95, 18},
                                          {45, 140, 17},
                                          {150, 160, 12},
                                          {20, 30, 9},
                                          {90, 165, 8},
                                          {178, 35, 11}}};

/// A bowl a fifth as deep as wide, with a rim that runs out to twice the radius.
double crater_height_m(const Crater& crater, double x_m, double y_m) {
  const double share = std::hypot(x_m - crater.x_m, y_m - crater.y_m) / crater.radius_m;
  const double rim_m = 0.06 * crater.radius_m;
  if (share < 1) return rim_m - 0.26 * crater.radius_m * (1 - share * share);
  return share < 2 ? rim_m * (2 - share) * (2 - share) : 0;
}

double ground_m(double x_m, double y_m) {
  double height_m = 2.0 * std::sin(x_m / 47) * std::cos(y_m / 61) + 0.03 * std::sin(x_m) +
                    0.03 * std::sin(0.8 * y_m + 0.3 * x_m);
  for (const Crater& crater : kCraters) height_m += crater_height_m(crater, x_m, y_m);
  return height_m;
}

MapSoil soil(std::string name, double cohesion_pa, double friction_angle_deg, double kphi) {
  const double degree = std::numbers::pi / 180;
  UncertainSoil numbers;
  numbers.mean = named_soils::simulant_2007();
  numbers.mean.cohesion_pa = cohesion_pa;
  numbers.mean.friction_angle_rad = friction_angle_deg * degree;
  numbers.mean.kphi = kphi;
  numbers.standard_deviation.cohesion_pa = 0.2 * cohesion_pa;
  numbers.standard_deviation.friction_angle_rad = 2 * degree;
  numbers.standard_deviation.kphi = 0.2 * kphi;
  return {.name = std::move(name), .source = "made up for a test", .soil = numbers};
}

Candidate made_up_path(const PlanningProblem& problem, int rank, double bow_m, double lowest) {
  const StartState& start = problem.start;
  const Goal& goal = problem.goal;
  Candidate candidate;
  candidate.rank = rank;
  candidate.planner = rank % 2 == 1 ? "SST" : "KPIECE1";
  candidate.seed = 7;
  const double dx_m = goal.x_m - start.x_m, dy_m = goal.y_m - start.y_m;
  const double reach_m = std::hypot(dx_m, dy_m);
  const double weight_n = problem.vehicle.mass_kg * problem.gravity_mps2;
  constexpr int kCount = 2400;
  for (int i = 0; i < kCount; ++i) {
    const double s = i / (kCount - 1.0), wave = std::sin(std::numbers::pi * s);
    const double side_m = bow_m * wave + 5 * std::sin(5 * std::numbers::pi * s) * wave;
    TrajectoryPoint p;
    p.time_s = 80 * s;
    p.x_m = start.x_m + dx_m * s - dy_m / reach_m * side_m;
    p.y_m = start.y_m + dy_m * s + dx_m / reach_m * side_m;
    p.z_m = problem.map.height_m(p.x_m, p.y_m);
    p.speed_mps = std::min(3.0, 0.3 + 30 * std::min(s, 1 - s)) * (1 - 0.3 * wave * wave);
    p.curvature_1pm = -0.09 * std::sin(5 * std::numbers::pi * s) * wave;
    p.steer_rad = std::atan(1.143 * p.curvature_1pm);
    p.demand_n = problem.vehicle.mass_kg * p.speed_mps * p.speed_mps * p.curvature_1pm +
                 30 * std::sin(20 * s);
    p.supply_min_n = -weight_n * (0.42 + 0.05 * std::sin(9 * s));
    p.supply_max_n = weight_n * (0.42 + 0.05 * std::cos(7 * s));
    p.cornering_margin = std::max(
        lowest, std::min(p.supply_max_n - p.demand_n, p.demand_n - p.supply_min_n) / weight_n);
    p.tip_over_margin = 0.62 - 0.3 * std::abs(p.demand_n) / weight_n;
    p.traction_margin = 0.34 + 0.12 * std::sin(14 * s + bow_m);
    p.margin = std::min({p.cornering_margin, p.tip_over_margin, p.traction_margin});
    p.slip_max = 0.12 + 0.08 * std::sin(14 * s + bow_m + 3);
    p.slip_angle_max_rad = 0.35 * p.demand_n / weight_n;
    p.sinkage_max_m = 0.021 + 0.02 * p.slip_max;
    p.torque_max_nm = 24 + 18 * std::sin(14 * s + bow_m);
    p.energy_j = 16000 * s;
    p.soil = problem.map.soil_index(p.x_m, p.y_m).value_or(-1);
    candidate.points.push_back(p);
  }
  for (std::size_t i = 0; i < candidate.points.size(); ++i) {
    const auto& ahead = candidate.points[std::min(i + 1, candidate.points.size() - 1)];
    const auto& behind = candidate.points[i == 0 ? 0 : i - 1];
    candidate.points[i].yaw_rad = std::atan2(ahead.y_m - behind.y_m, ahead.x_m - behind.x_m);
    if (i > 0)
      candidate.length_m +=
          std::hypot(candidate.points[i].x_m - behind.x_m, candidate.points[i].y_m - behind.y_m);
  }
  const auto worst =
      std::min_element(candidate.points.begin(), candidate.points.end(),
                       [](const auto& a, const auto& b) { return a.margin < b.margin; });
  candidate.duration_s = candidate.points.back().time_s;
  candidate.energy_j = 118.25 * candidate.length_m;
  candidate.margin_min = worst->margin + 0.003;
  candidate.margin_worst_tenth = worst->margin + 0.02;
  const double p05 = worst->margin - 0.041;
  candidate.spread = MarginSpread{.draws = 100,
                                  .p05 = p05,
                                  .p05_low = p05 - 0.01,
                                  .p05_high = p05 + 0.01,
                                  .feasible = probability_of(100 - 3 * rank, 100)};
  candidate.limiting = {.margin = worst->margin == worst->cornering_margin ? MarginKind::kCornering
                                                                           : MarginKind::kTraction,
                        .x_m = worst->x_m,
                        .y_m = worst->y_m,
                        .time_s = worst->time_s};
  candidate.verified = {.passed = true,
                        .reason = "",
                        .margin_min = worst->margin,
                        .deviation_max_m = 0.11 + 0.05 * rank};
  return candidate;
}

RejectedState made_up_rejection(const PlanningProblem& problem, std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(0, 1);
  std::discrete_distribution<int> reasons{3, 1, 4, 9, 22, 3, 8, 11, 6, 2, 32};
  const auto reason = static_cast<Rejection>(reasons(random));
  const double limit = reason == Rejection::kSlope       ? problem.limits.slope_max_rad
                       : reason == Rejection::kSlipAngle ? problem.limits.slip_angle_max_rad
                       : reason == Rejection::kSinkage   ? problem.limits.sinkage_max_m
                       : reason == Rejection::kSlip      ? problem.limits.slip_max
                       : reason == Rejection::kSpeed     ? problem.speed_max_mps
                                                         : problem.limits.margin_min;
  const bool margin = is_margin(reason);
  return {
      .reason = reason,
      .x_m = kWest_m + kSide_m * any(random),
      .y_m = kNorth_m - kSide_m * any(random),
      .yaw_rad = 2 * std::numbers::pi * any(random),
      .speed_mps = 1 + 2 * any(random),
      .curvature_1pm = 0.4 * (any(random) - 0.5),
      .exceeded = Exceeded{.found = margin ? limit - 0.3 * any(random) : limit * (1 + any(random)),
                           .limit = limit}};
}

}  // namespace

TerrainMap report_test_map(int cells) {
  const double cell_m = kSide_m / cells;
  ElevationRaster elevation{.frame = {.columns = cells,
                                      .rows = cells,
                                      .west_m = kWest_m,
                                      .north_m = kNorth_m,
                                      .cell_width_m = cell_m,
                                      .cell_height_m = cell_m,
                                      .crs_wkt = ""},
                            .height_m = {}};
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const double x_m = (column + 0.5) * cell_m, y_m = kSide_m - (row + 0.5) * cell_m;
      const bool known = x_m + (kSide_m - y_m) > 35;
      elevation.height_m.push_back(known ? static_cast<float>(ground_m(x_m, y_m))
                                         : std::numeric_limits<float>::quiet_NaN());
    }
  }
  ClassRaster classes;
  classes.frame = elevation.frame;
  classes.frame.columns = classes.frame.rows = 100;
  classes.frame.cell_width_m = classes.frame.cell_height_m = kSide_m / 100;
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 100; ++column) {
      const double zone = std::sin(column / 17.0) + std::cos(row / 13.0 + column / 31.0);
      const bool forbidden = std::hypot(column - 82, row - 76) < 7;
      classes.code.push_back(forbidden ? 9 : zone > 0.5 ? 1 : zone > -0.7 ? 2 : 3);
    }
  }
  std::vector<Rock> rocks;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  for (int i = 0; i < 260; ++i) {
    const double radius_m = 0.2 + 1.6 * std::pow(any(random), 4);
    rocks.push_back({.x_m = kWest_m + 2 + 196 * any(random),
                     .y_m = kNorth_m - 2 - 196 * any(random),
                     .radius_m = radius_m,
                     .height_m = radius_m});
  }
  return {std::move(elevation),
          std::move(classes),
          {.soils = {soil("firm regolith", 900, 38, 9e5), soil("nominal regolith", 600, 36, 8e5),
                     soil("loose drift", 200, 31, 4e5)},
           .classes = {{1, 0}, {2, 1}, {3, 2}},
           .unmapped = std::nullopt},
          std::move(rocks)};
}

PlanningProblem report_test_problem(TerrainMap map) {
  const Vehicle vehicle = preset_vehicle("lrv");
  PlanningProblem problem{
      .map = std::move(map),
      .vehicle = vehicle,
      .gravity_mps2 = 1.62,
      .start = {.x_m = 1016, .y_m = 5022, .heading_rad = 0.9},
      .goal = {.x_m = 1184, .y_m = 5172, .radius_m = 3, .heading_rad = std::nullopt},
      .speed_max_mps = 3,
      .limits = {.slip_max = vehicle.slip_max,
                 .slip_angle_max_rad = vehicle.slip_angle_max_rad,
                 .slope_max_rad = vehicle.slope_max_rad,
                 .sinkage_max_m = vehicle.sinkage_max_m},
      .search = {.time_s = 20.0, .iterations = std::nullopt, .seed = 7}};
  return problem;
}

PlanResult report_test_result(const PlanningProblem& problem) {
  PlanResult result;
  result.status = PlanStatus::kFeasible;
  result.candidates = {made_up_path(problem, 1, -34, 0.20), made_up_path(problem, 2, 31, 0.15),
                       made_up_path(problem, 3, 62, 0.1)};
  Candidate overturned = made_up_path(problem, 4, 4, -0.06);
  overturned.rank = 0;
  overturned.verified.passed = false;
  overturned.verified.reason = "the replay is rejected for cornering after 21.4 s";
  for (TrajectoryPoint& p : overturned.points) {
    p.cornering_margin -= 0.25;
    p.margin = std::min(p.margin, p.cornering_margin);
  }
  result.overturned = {overturned};
  const TrajectoryPoint& fast = result.candidates.front().points[520];
  const TrajectoryPoint& loose = result.candidates.front().points[1610];
  result.what_ifs = {{.question = "the same path at twice its speed",
                      .feasible = false,
                      .reason = Rejection::kCornering,
                      .x_m = fast.x_m,
                      .y_m = fast.y_m,
                      .time_s = fast.time_s / 2,
                      .margin_min = -0.31,
                      .end_shift_m = std::nullopt},
                     {.question = "the same controls with cohesion and tan(phi) halved",
                      .feasible = false,
                      .reason = Rejection::kTraction,
                      .x_m = loose.x_m,
                      .y_m = loose.y_m,
                      .time_s = loose.time_s,
                      .margin_min = -0.04,
                      .end_shift_m = 6.3,
                      .driven = {{fast.x_m, fast.y_m}, {loose.x_m, loose.y_m}},
                      .probability = probability_of(19, 20)}};
  result.relaxed = {
      {.given_up = "at half the speed, 1.5 m/s", .opened = {}},
      {.given_up = "with margin_min 0", .opened = made_up_path(problem, 0, 80, 0.02)}};
  std::mt19937_64 random(11);
  for (int i = 0; i < 1500; ++i) {
    result.rejected_states.push_back(made_up_rejection(problem, random));
    result.rejected[static_cast<std::size_t>(result.rejected_states.back().reason)] += 37;
  }
  result.propagations = 1284533;
  result.before_search = {{.step = "reading the scenario and its map", .time_s = 0.4}};
  result.planning_time_s = 19.8;
  result.verification_time_s = 4.2;
  result.seed = 7;
  return result;
}

}  // namespace regoplan
