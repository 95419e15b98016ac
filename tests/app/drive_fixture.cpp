#include "tests/app/drive_fixture.h"

#include <cmath>

namespace regoplan {
namespace {

constexpr double kRowEvery_s = 0.1;

DriveMoment moment_at(const PlanningProblem& problem, double share, double time_s) {
  const StartState& start = problem.start;
  const Goal& goal = problem.goal;
  const double way_m = std::hypot(goal.x_m - start.x_m, goal.y_m - start.y_m);
  const double wave = std::sin(40 * share);
  DriveMoment moment{.time_s = time_s,
                     .s_m = share * way_m,
                     .offset_m = 0.2 * wave,
                     .heading_error_rad = 0.05 * std::cos(40 * share),
                     .state = {.x_m = start.x_m + share * (goal.x_m - start.x_m),
                               .y_m = start.y_m + share * (goal.y_m - start.y_m),
                               .yaw_rad = start.heading_rad,
                               .motion = {.vx_mps = 1, .vy_mps = 0.02, .yaw_rate_rad_s = 0},
                               .curvature_1pm = 0.05 * wave,
                               .rim_speed_mps = 1.2},
                     .seen = {},
                     .asked = {.speed_target_mps = 1.25, .curvature_target_1pm = 0.06 * wave},
                     .wheels = {}};
  moment.seen = moment.state;
  moment.seen.x_m += 0.03;
  for (std::size_t i = 0; i < problem.vehicle.wheels.size(); ++i) {
    moment.wheels.push_back({.load_n = 250,
                             .steer_rad = 0.05 * wave,
                             .rim_speed_mps = 1.2,
                             .slip = 0.3 + 0.4 * wave,
                             .slip_angle_rad = 0.1 * wave,
                             .torque_nm = 12,
                             .sinkage_m = 0.01});
  }
  return moment;
}

SensedRow row_of(const DriveMoment& moment) {
  const std::size_t wheels = moment.wheels.size();
  return {.time_s = moment.time_s,
          .x_m = moment.seen.x_m,
          .y_m = moment.seen.y_m,
          .yaw_rad = moment.seen.yaw_rad,
          .roll_rad = 0,
          .pitch_rad = 0.01,
          .wheel_speed_rad_s = std::vector<double>(wheels, 3),
          .steer_rad = std::vector<double>(wheels, 0.1),
          .torque_nm = std::vector<double>(wheels, 12),
          .sinkage_m = std::vector<double>(wheels, 0.01)};
}

}  // namespace

DriveRecord made_up_drive(const PlanningProblem& problem, int rows) {
  DriveRecord record{.scenario = "scenario.yaml", .path = "candidate-1.csv", .settings = {}};
  DriveResult& result = record.result;
  for (int i = 0; i < rows; ++i) {
    const DriveMoment moment =
        moment_at(problem, static_cast<double>(i) / (rows - 1), kRowEvery_s * i);
    result.moments.push_back(moment);
    result.rows.push_back(row_of(moment));
    if (i % 5 == 0) {
      result.margins.push_back({.time_s = moment.time_s,
                                .s_m = moment.s_m,
                                .cornering = 0.3 - 0.28 * i / rows,
                                .tip_over = 0.4,
                                .traction = 0.2});
    }
  }
  const DriveMoment& last = result.moments.back();
  result.broken = {
      {.limit = Rejection::kSlip,
       .x_m = last.state.x_m,
       .y_m = last.state.y_m,
       .s_m = last.s_m,
       .time_s = last.time_s,
       .first = {.found = 0.61, .limit = 0.6},
       .worst = 0.7},
      {.limit = Rejection::kSlope, .first = {.found = 0.5, .limit = 0.4}, .worst = 0.6}};
  result.reason = Rejection::kDeviation;
  result.exceeded = Exceeded{.found = 0.5, .limit = 0.4};
  result.x_m = last.state.x_m;
  result.y_m = last.state.y_m;
  result.s_m = result.length_m = last.s_m;
  result.time_s = result.duration_s = last.time_s;
  result.smallest_margin = result.margins.back();
  return record;
}

}  // namespace regoplan
