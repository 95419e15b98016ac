#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/plan.h"
#include "terramech/basics/input_error.h"
#include "tests/planner/evaluated.h"

namespace regoplan {
namespace {

TEST(Evaluation, AStraightPathOnFirmGroundIsFeasibleAndTrackedClosely) {
  const PathEvaluation e = evaluated(flat_problem(), reference({{10, 25}, {45, 25}}, 2));
  EXPECT_TRUE(e.feasible) << sentence(*e.refusal);
  EXPECT_EQ(e.tracking.end, TrackingEnd::kArrived);
  EXPECT_LT(e.tracking.deviation_max_m, 0.01);
  EXPECT_NEAR(e.tracking.duration_s, e.duration_s, 0.05 * e.duration_s);
  EXPECT_GT(e.tracking.energy_j, 0);
  for (std::size_t i = 1; i < e.s_m.size(); ++i) EXPECT_LE(e.s_m[i] - e.s_m[i - 1], 0.5 + 1e-9);
}

TEST(Evaluation, AlongThePathStandWhatTheDriveTookOfTorqueAndEnergy) {
  const PathEvaluation e = evaluated(flat_problem(), reference({{10, 25}, {45, 25}}, 2));
  ASSERT_GT(e.points.size(), 10u);
  for (std::size_t i = 1; i < e.points.size(); ++i) {
    EXPECT_GE(e.points[i].energy_j, e.points[i - 1].energy_j);
  }
  EXPECT_NEAR(e.points.front().energy_j, 0, 1);
  EXPECT_NEAR(e.points.back().energy_j, e.tracking.energy_j, 0.03 * e.tracking.energy_j);
  // At a steady speed the torques of four like wheels are what drives it over its way.
  const TrajectoryPoint &a = e.points[e.points.size() / 3], &b = e.points[e.points.size() * 2 / 3];
  const double pull_n = (b.energy_j - a.energy_j) / (b.x_m - a.x_m);
  EXPECT_NEAR(4 * a.torque_max_nm / flat_problem().vehicle.wheel.radius_m, pull_n, 0.2 * pull_n);
}

TEST(Evaluation, WhatWasNeverDrivenHasNoStrainAndNoEnergy) {
  PlanningProblem problem = flat_problem();
  problem.map = one_soil_map(60, firm_regolith(), flat, {{30, 25, 1, 1}});
  const PathEvaluation e = evaluated(problem, reference({{10, 25}, {45, 25}}, 2));
  ASSERT_TRUE(e.refusal);
  const auto strains = [](const TrajectoryPoint& point) {
    return std::array{point.slip_max, point.slip_angle_max_rad, point.sinkage_max_m,
                      point.torque_max_nm};
  };
  for (std::size_t i = 0; i < e.points.size(); ++i) {
    const bool driven = e.s_m[i] <= e.tracking.last.s_m;
    for (const double strain : strains(e.points[i])) {
      EXPECT_EQ(std::isnan(strain), i == 0 || e.s_m[i] > e.tracking.last.s_m + 1) << e.s_m[i];
    }
    if (driven) {
      EXPECT_FALSE(std::isnan(e.points[i].energy_j));
    }
  }
  EXPECT_GT(e.points[1].sinkage_max_m, 0);
  EXPECT_TRUE(std::isnan(e.points.back().energy_j));
}

TEST(Evaluation, APathThatEndsAtSpeedMustLeaveRoomToStop) {
  // The path ends 5 m before a wall; from 2 m/s the vehicle stops in 6.7 m, from 0.5 m/s at once.
  PlanningProblem problem = flat_problem();
  problem.map = one_soil_map(60, firm_regolith(), flat, {{42, 24, 1, 2}, {42, 26, 1, 2}});
  const std::vector<PathPoint> points{{10, 25}, {37, 25}};
  const PathEvaluation fast = evaluated(problem, reference(points, 2));
  ASSERT_TRUE(fast.refusal);
  EXPECT_EQ(fast.refusal->reason, Rejection::kObstacle);
  EXPECT_TRUE(fast.refusal->while_stopping);
  EXPECT_TRUE(
      sentence(*fast.refusal).starts_with("the vehicle cannot stop at the end: obstacle at (39."))
      << sentence(*fast.refusal);
  EXPECT_TRUE(evaluated(problem, reference(points, 0.5)).feasible);
  ReferencePath piece = reference(points, 2);
  piece.goes_on = true;
  EXPECT_TRUE(evaluated(problem, piece).feasible);
}

/// 20 m straight on, from rest to rest.
ReferencePath rest_to_rest(bool reverse, double from_x_m, double to_x_m) {
  PathCurve curve({{from_x_m, 25}, {to_x_m, 25}});
  SpeedProfile speed({{0, 0}, {5, 1}, {15, 1}, {curve.length_m(), 0}});
  return {.name = "path",
          .legs = {{.curve = std::move(curve), .speed = std::move(speed), .reverse = reverse}}};
}

TEST(Evaluation, AStopDownhillIsJudgedAsTheDriveThatLedToIt) {
  PlanningProblem problem = flat_problem();
  const double steep = std::tan(22 * kTestDegree);
  problem.map = one_soil_map(60, firm_regolith(), [&](double x_m, double) { return -steep * x_m; });
  for (const bool reverse : {false, true}) {
    const PathEvaluation e = evaluated(problem, rest_to_rest(reverse, 15, 35));
    EXPECT_TRUE(e.feasible) << sentence(*e.refusal);
    const TrajectoryPoint &before = e.points[e.points.size() - 2], &last = e.points.back();
    ASSERT_EQ(last.speed_mps, 0);
    EXPECT_NEAR(last.traction_margin, before.traction_margin, 0.02) << reverse;
    EXPECT_NEAR(last.cornering_margin, before.cornering_margin, 0.02) << reverse;
    // Setting off is judged as the drive that it begins.
    EXPECT_NEAR(e.points[0].traction_margin, e.points[1].traction_margin, 0.02) << reverse;
  }
}

TEST(Evaluation, WhatCannotBeAskedNamesFieldValueAndRange) {
  const ReferencePath path = reference({{10, 25}, {40, 25}}, 1);
  const auto refused = [](const ReferencePath& asked, const EvaluationSettings& settings,
                          const std::string& words) {
    try {
      evaluated(flat_problem(), asked, settings);
      FAIL() << "accepted: " << words;
    } catch (const ValueError& error) {
      EXPECT_EQ(std::string(error.what()), words);
    }
  };
  refused(path, {.soil_draws = 0}, "soil_draws: 0 is not valid (allowed: 2 to 1000000)");
  refused(path, {.soil_draws = -5}, "soil_draws: -5 is not valid (allowed: 2 to 1000000)");
  refused(path, {.threads = 0}, "threads: 0 is not valid (allowed: 1 to 256)");
  refused(path, {.deviation_max_m = NAN}, "deviation_max_m: nan is not valid (allowed: above 0)");
  refused({.name = "none", .legs = {}}, kSettings, "legs: 0 is not valid (allowed: at least one)");
  ReferencePath ends_early = path;
  ends_early.legs.front().speed = SpeedProfile({{0, 1}, {10, 1}});
  refused(ends_early, kSettings,
          "legs[0].speed: its end, s_m: 10 is not valid (allowed: at least 30, the length of the "
          "curve)");
}

TEST(Evaluation, FasterIsNeverSaferOnATurn) {
  double before = 1;
  for (const double speed : {1.0, 2.0, 3.0, 3.5}) {
    const PathEvaluation e = evaluated(turn(speed));
    EXPECT_LE(e.margins.cornering, before + 1e-9) << speed;
    before = e.margins.cornering;
  }
  EXPECT_LT(before, 0.05);  // the last of them is too fast
}

TEST(Evaluation, ASlalomIsNowhereSharperThanItsBows) {
  const PlanningProblem base = flat_problem();
  for (const double waves : {0.5, 1.3, 1.75, 3.0}) {
    Manoeuvre slalom = turn(1);
    slalom.kind = ManoeuvreKind::kSlalom;
    slalom.amplitude_m = 1;
    slalom.wavelength_m = 15;
    slalom.waves = waves;
    const PreparedManoeuvre prepared = prepare(slalom, base.limits, base);
    const PathCurve& curve = std::get<ReferencePath>(prepared.course).legs.front().curve;
    const double asked_1pm = std::pow(2 * std::numbers::pi / 15, 2);
    const double sharpest_m = curve.sharpest_m(0, curve.length_m());
    EXPECT_NEAR(std::abs(curve.at(sharpest_m).curvature_1pm), asked_1pm, 0.005 * asked_1pm)
        << waves;
    EXPECT_NEAR(curve.at(0).y_m, 0, 1e-9);
    EXPECT_NEAR(curve.at(curve.length_m()).y_m, 0, 1e-9);
    EXPECT_NEAR(curve.at(15).y_m, 1, 0.02);  // the first bow, to the left
  }
}

TEST(Evaluation, LeftAndRightTurnsAreEquallySafe) {
  Manoeuvre left = turn(2.5), right = turn(2.5);
  right.to_the_right = true;
  const PathEvaluation a = evaluated(left), b = evaluated(right);
  EXPECT_NEAR(a.margin_min, b.margin_min, 1e-6);
  EXPECT_NEAR(a.tracking.deviation_max_m, b.tracking.deviation_max_m, 1e-6);
  EXPECT_EQ(a.feasible, b.feasible);
}

TEST(Evaluation, ATurnTooFastNamesCorneringItsPlaceAndTheLimitOfTheSupply) {
  const PathEvaluation e = evaluated(turn(3.5));
  ASSERT_FALSE(e.feasible);
  EXPECT_EQ(e.refusal->reason, Rejection::kCornering);
  EXPECT_FALSE(e.refusal->while_tracking);
  EXPECT_GT(e.refusal->s_m, 2);  // not on the straight before the turn
  EXPECT_EQ(e.limiting.margin, MarginKind::kCornering);
  ASSERT_TRUE(e.cornering_limit);
  EXPECT_EQ(e.cornering_limit->limit, BranchLimit::kSlipAngle);
  EXPECT_FALSE(e.cornering_limit->wheel.empty());
}

TEST(Evaluation, TheLimitingPlaceIsThatOfTheSmallestMarginNotThatOfTheRefusal) {
  // Beyond the supply there is no traction margin, yet the cornering margin goes on falling.
  for (const double speed_mps : {2.0, 3.5, 4.0}) {
    const PathEvaluation e = evaluated(turn(speed_mps));
    const auto at = std::ranges::find(e.points, e.limiting.time_s, &TrajectoryPoint::time_s);
    ASSERT_NE(at, e.points.end()) << speed_mps;
    EXPECT_EQ(e.limiting.x_m, at->x_m);
    EXPECT_EQ(e.limiting.y_m, at->y_m);
    EXPECT_EQ(margins_at(*at).smallest(), e.margin_min) << speed_mps;
    ASSERT_EQ(e.limiting.margin, MarginKind::kCornering);
    ASSERT_TRUE(e.cornering_limit);
    EXPECT_NEAR(e.cornering_limit->supply_n, at->supply_max_n, 0.01 * at->supply_max_n);
    EXPECT_EQ(e.cornering_limit->supply_n < at->demand_n, e.margin_min < 0) << speed_mps;
    if (e.refusal && !e.refusal->while_tracking) {
      EXPECT_LT(e.refusal->time_s, e.limiting.time_s) << speed_mps;
    }
  }
}

TEST(Evaluation, APathThatLeavesTheMapIsRefusedThere) {
  const PathEvaluation e = evaluated(flat_problem(), reference({{40, 25}, {70, 25}}, 2));
  ASSERT_FALSE(e.feasible);
  EXPECT_TRUE(e.refusal->reason == Rejection::kBounds ||
              e.refusal->reason == Rejection::kUnknownTerrain);
  EXPECT_GT(e.refusal->x_m, 55);
  EXPECT_LE(e.refusal->x_m, 60.5);
  EXPECT_FALSE(e.spread);  // no soil could give margins there
}

TEST(Evaluation, AVehicleThatSinksTooDeepIsToldSoAndOtherSoilsMayBearIt) {
  PlanningProblem problem = flat_problem();
  problem.limits.sinkage_max_m = 0.001;
  const PathEvaluation e = evaluated(problem, reference({{10, 25}, {30, 25}}, 1));
  ASSERT_FALSE(e.feasible);
  EXPECT_EQ(e.refusal->reason, Rejection::kSinkage);
  EXPECT_EQ(e.refusal->exceeded->limit, problem.limits.sinkage_max_m);
  EXPECT_GT(e.refusal->exceeded->found, problem.limits.sinkage_max_m);
  EXPECT_TRUE(e.spread);
}

TEST(Evaluation, MotorsTooWeakToRollAreAWantOfTraction) {
  PlanningProblem problem = flat_problem();
  problem.vehicle.torque_max_nm = 0.5;
  const PathEvaluation e = evaluated(problem, reference({{10, 25}, {30, 25}}, 1));
  ASSERT_FALSE(e.feasible);
  EXPECT_EQ(e.refusal->reason, Rejection::kTraction);
  EXPECT_EQ(e.limiting.margin, MarginKind::kTraction);
}

TEST(Evaluation, ARockOnThePathIsAnObstacle) {
  PlanningProblem problem = lrv_problem(one_soil_map(
      60, firm_regolith(), flat, {{.x_m = 30, .y_m = 25, .radius_m = 1, .height_m = 1}}));
  const PathEvaluation e = evaluated(problem, reference({{10, 25}, {45, 25}}, 2));
  ASSERT_FALSE(e.feasible);
  EXPECT_EQ(e.refusal->reason, Rejection::kObstacle);
}

TEST(Evaluation, SlopesThatASideForceCannotHoldAreRefused) {
  Manoeuvre traverse = turn(1);
  traverse.kind = ManoeuvreKind::kSlopeTraverse;
  traverse.length_m = 15;
  traverse.slope_heading_rad = 90 * kTestDegree;
  traverse.slope_rad = 5 * kTestDegree;
  const PathEvaluation gentle = evaluated(traverse);
  EXPECT_TRUE(gentle.feasible) << sentence(*gentle.refusal);
  EXPECT_GT(gentle.points.front().demand_n, 0);  // uphill is left: gravity pulls to the right
  traverse.slope_rad = 15 * kTestDegree;
  EXPECT_LT(evaluated(traverse).margin_min, gentle.margin_min);
}

TEST(Evaluation, APathWhoseDriveWasRefusedIsNotFeasible) {
  const PlanningProblem problem = flat_problem();
  const World world(problem, WorldUse::kVerdict, 1);
  DrivenCourse course{.name = "made up", .length_m = 10, .duration_s = 10, .speed_max_mps = 1};
  for (const double s_m : {0.0, 5.0, 10.0}) {
    course.stations.push_back(
        {.s_m = s_m, .time_s = s_m, .state = world.dynamics().rolling_state(20 + s_m, 25, 0, 1)});
  }
  course.deviation_allowed_m = 1;
  course.run.last = {.time_s = 6, .s_m = 6, .offset_m = -1.4};
  course.run.end = TrackingEnd::kArrived;
  EXPECT_TRUE(judged(world, course, kSettings).feasible);
  for (const auto& [end, reason] : {std::pair{TrackingEnd::kStrayed, Rejection::kDeviation},
                                    std::pair{TrackingEnd::kStalled, Rejection::kStalled},
                                    std::pair{TrackingEnd::kDynamics, Rejection::kDynamics}}) {
    course.run.end = end;
    const PathEvaluation evaluation = judged(world, course, kSettings);
    EXPECT_FALSE(evaluation.feasible) << name(reason);
    ASSERT_TRUE(evaluation.refusal) << name(reason);
    EXPECT_EQ(evaluation.refusal->reason, reason);
    EXPECT_TRUE(evaluation.refusal->while_tracking);
  }
}

TEST(Evaluation, EveryKindOfManoeuvreEndsInAVerdict) {
  Manoeuvre m = turn(1.5);
  m.length_m = 12;
  m.offset_m = 2;
  m.amplitude_m = 1;
  m.wavelength_m = 15;
  m.waves = 1.5;
  m.braking_mps2 = 0.2;
  m.angle_rad = 30 * kTestDegree;
  for (const ManoeuvreKind kind :
       {ManoeuvreKind::kLaneChange, ManoeuvreKind::kSlalom, ManoeuvreKind::kBrakingInATurn}) {
    m.kind = kind;
    const PathEvaluation e = evaluated(m);
    EXPECT_TRUE(e.feasible) << name(kind) << ": " << sentence(*e.refusal);
    EXPECT_LT(e.tracking.deviation_max_m, 0.3) << name(kind);
  }
}

TEST(Evaluation, APathIsReversedAsItIsDriven) {
  // An LRV is its own mirror image: backwards on the mirrored path it fares as forwards.
  std::vector<PathPoint> bend;
  for (double s = 0; s <= 1.2; s += 0.1)
    bend.push_back({15 + 20 * std::sin(s), 45 - 20 * std::cos(s)});
  ReferencePath ahead = reference(bend, 2);
  const PathEvaluation forwards = evaluated(flat_problem(), ahead);
  ahead.legs.front().reverse = true;
  const PathEvaluation back = evaluated(flat_problem(), ahead);
  EXPECT_TRUE(back.feasible) << sentence(*back.refusal);
  EXPECT_NEAR(back.margin_min, forwards.margin_min, 1e-6);
  EXPECT_NEAR(back.tracking.deviation_max_m, forwards.tracking.deviation_max_m, 1e-6);
  EXPECT_LT(back.points.front().speed_mps, 0);
}

TEST(Evaluation, VehiclesThatAreNotTheirOwnMirrorImageReverseTheirPathsToo) {
  PlanningProblem problem = flat_problem();
  problem.vehicle = preset_vehicle("curiosity");
  problem.limits = default_limits(problem.vehicle);
  problem.speed_max_mps = problem.vehicle.speed_max_mps * kSpeedTolerance;
  ReferencePath path = reference({{20, 20}, {22, 20.1}, {24, 20.8}, {25.5, 22}}, 0.04);
  path.legs.front().reverse = true;
  const PathEvaluation e = evaluated(problem, path);
  EXPECT_TRUE(e.feasible) << sentence(*e.refusal);
  EXPECT_LT(e.tracking.deviation_max_m, 0.05);
}

TEST(Evaluation, SameSeedSameResultWhateverTheThreads) {
  EvaluationSettings one = kSettings, two = kSettings;
  one.threads = 1;
  two.threads = 2;
  const PathEvaluation a = evaluated(turn(2.5), one), b = evaluated(turn(2.5), two);
  EXPECT_EQ(a.margin_min, b.margin_min);
  EXPECT_EQ(a.spread->margin.p05, b.spread->margin.p05);
  EXPECT_EQ(a.tracking.energy_j, b.tracking.energy_j);
}

TEST(Evaluation, ACandidateIsConfirmed) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const PlanResult planned = plan(problem);
  ASSERT_FALSE(planned.candidates.empty());
  const Candidate& candidate = planned.candidates.front();
  std::vector<PathPoint> points;
  for (const TrajectoryPoint& point : candidate.points) points.push_back({point.x_m, point.y_m});
  PathCurve curve(points);
  std::vector<RecordedMoment> recorded;
  std::vector<SpeedProfile::Node> nodes;
  for (std::size_t i = 0; i < candidate.points.size(); ++i) {
    const TrajectoryPoint& point = candidate.points[i];
    recorded.push_back({.s_m = curve.point_arc_m()[i],
                        .time_s = point.time_s,
                        .state = {.x_m = point.x_m,
                                  .y_m = point.y_m,
                                  .yaw_rad = point.yaw_rad,
                                  .motion = {.vx_mps = point.speed_mps},
                                  .curvature_1pm = point.curvature_1pm,
                                  .rim_speed_mps = point.speed_mps,
                                  .rim_acceleration_mps2 = point.acceleration_mps2}});
    if (nodes.empty() || recorded.back().s_m > nodes.back().s_m) {
      nodes.push_back({recorded.back().s_m, point.speed_mps});
    }
  }
  const PathEvaluation e = evaluated(problem, {.name = "candidate",
                                               .legs = {{.curve = std::move(curve),
                                                         .speed = SpeedProfile(std::move(nodes)),
                                                         .recorded = std::move(recorded)}}});
  EXPECT_TRUE(e.feasible) << sentence(*e.refusal);
  EXPECT_NEAR(e.margin_min, candidate.margin_min, 0.02);
}

}  // namespace
}  // namespace regoplan
