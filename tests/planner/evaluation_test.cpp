#include "planner/evaluation/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/evaluation/manoeuvres.h"
#include "planner/plan.h"
#include "terramech/basics/input_error.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

UncertainSoil uncertain_regolith() {
  UncertainSoil soil = firm_regolith();
  soil.standard_deviation.cohesion_pa = 50;
  soil.standard_deviation.friction_angle_rad = 2 * kTestDegree;
  soil.standard_deviation.ky0_m = 0.003;
  return soil;
}

const EvaluationSettings kSettings{.soil_draws = 30, .seed = 3};

ReferencePath reference(const std::vector<PathPoint>& points, double speed_mps) {
  PathCurve curve(points);
  SpeedProfile speed({{0, speed_mps}, {curve.length_m(), speed_mps}});
  return {.name = "path", .legs = {{std::move(curve), std::move(speed)}}};
}

PathEvaluation evaluated(const PlanningProblem& problem, const ReferencePath& path,
                         const EvaluationSettings& settings = kSettings) {
  const World world(problem, WorldUse::kVerdict, 1);
  return evaluate(world, path, settings);
}

PlanningProblem flat_problem(const UncertainSoil& soil = firm_regolith()) {
  PlanningProblem problem = lrv_problem(one_soil_map(60, soil, flat));
  problem.speed_max_mps *= kSpeedTolerance;
  return problem;
}

Manoeuvre turn(double speed_mps, double radius_m = 15) {
  return {.kind = ManoeuvreKind::kSteadyTurn,
          .name = "turn",
          .vehicle = preset_vehicle("lrv"),
          .soil = {.name = "regolith", .source = "test", .soil = uncertain_regolith()},
          .speed_mps = speed_mps,
          .radius_m = radius_m,
          .angle_rad = 90 * kTestDegree};
}

PathEvaluation evaluated(const Manoeuvre& manoeuvre,
                         const EvaluationSettings& settings = kSettings) {
  const PlanningProblem base = flat_problem();
  const PreparedManoeuvre prepared = prepare(manoeuvre, base.limits, base);
  const World world(prepared.problem, WorldUse::kVerdict, 1);
  return std::visit([&](const auto& course) { return evaluate(world, course, settings); },
                    prepared.course);
}

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

TEST(Evaluation, FasterIsNeverSaferOnATurn) {
  double before = 1;
  for (const double speed : {1.0, 2.0, 3.0, 3.5}) {
    const PathEvaluation e = evaluated(turn(speed));
    EXPECT_LE(e.margins.cornering, before + 1e-9) << speed;
    before = e.margins.cornering;
  }
  EXPECT_LT(before, 0.05);  // the last of them is too fast
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

/// 30 deg to the left within a few points 0.15 m apart, after a straight.
std::vector<PathPoint> corner_after(double straight_m) {
  constexpr double kApart_m = 0.15;
  const double c = std::cos(30 * kTestDegree), s = std::sin(30 * kTestDegree);
  const double corner_x_m = 10 + straight_m;
  std::vector<PathPoint> points;
  for (double x_m = 10; x_m < corner_x_m - 1; x_m += 1) points.push_back({x_m, 25});
  for (int k = 4; k >= 0; --k) points.push_back({corner_x_m - k * kApart_m, 25});
  for (const double way_m : {1 * kApart_m, 2 * kApart_m, 3 * kApart_m, 4 * kApart_m, 2.0, 3.0, 4.0,
                             5.0, 6.0, 7.0, 8.0}) {
    points.push_back({corner_x_m + c * way_m, 25 + s * way_m});
  }
  return points;
}

TEST(Evaluation, ACornerSharperThanTheSteeringIsRefusedWhereverItLies) {
  std::vector<double> found_1pm;
  for (const double straight_m : {15.05, 15.15, 15.25, 15.35, 15.45}) {
    const PathEvaluation e = evaluated(flat_problem(), reference(corner_after(straight_m), 1));
    ASSERT_FALSE(e.feasible) << straight_m;
    EXPECT_EQ(e.refusal->reason, Rejection::kSteering) << straight_m;
    EXPECT_EQ(e.margin_min, -1) << straight_m;
    double sharpest_1pm = 0;
    for (const TrajectoryPoint& at : e.points) {
      sharpest_1pm = std::max(sharpest_1pm, std::abs(at.curvature_1pm));
    }
    found_1pm.push_back(sharpest_1pm);
  }
  for (const double sharpest_1pm : found_1pm) EXPECT_NEAR(sharpest_1pm, found_1pm[0], 0.1);
}

TEST(Evaluation, AHairpinBetweenTwoStationsIsRefusedForSteering) {
  EvaluationSettings settings = kSettings;
  settings.deviation_max_m = 20;  // not for leaving the path
  for (const double apart_m : {2.0, 0.5, 0.0}) {
    const PathEvaluation e =
        evaluated(flat_problem(), reference({{10, 25}, {40, 25}, {10, 25 + apart_m}}, 1), settings);
    ASSERT_FALSE(e.feasible) << apart_m;
    EXPECT_EQ(e.refusal->reason, Rejection::kSteering) << apart_m;
    EXPECT_NEAR(e.refusal->x_m, 40, 1);
  }
}

TEST(Evaluation, TheMarginOfATurnIsThatOfItsSharpestPlace) {
  // A bow within the steering whose sharpest place lies at, or between, stations.
  std::vector<double> margins;
  for (const double straight_m : {10.0, 10.1, 10.2, 10.3, 10.4}) {
    std::vector<PathPoint> points{{10, 25}, {12, 25}, {14, 25}, {16, 25}, {18, 25}};
    const double x_m = 10 + straight_m;
    for (const auto& [along_m, left_m] : std::vector<std::pair<double, double>>{
             {0.0, 0.0}, {0.4, 0.02}, {0.8, 0.08}, {2.8, 0.38}, {4.8, 0.68}, {6.8, 0.98}}) {
      points.push_back({x_m + along_m, 25 + left_m});
    }
    margins.push_back(evaluated(flat_problem(), reference(points, 1)).margin_min);
  }
  for (const double margin : margins) EXPECT_NEAR(margin, margins[0], 0.005);
  EXPECT_GT(margins[0], 0);
}

TEST(Evaluation, DensePointsRoundedToAMillimetreAreNotRefused) {
  const auto rounded_m = [](double x_m) { return std::round(x_m * 1000) / 1000; };
  std::vector<PathPoint> points;
  constexpr double kRadius_m = 15, kApart_m = 0.1;
  for (int i = 0; i <= 300; ++i) {
    const double at = i * kApart_m / kRadius_m;
    points.push_back(
        {rounded_m(10 + kRadius_m * std::sin(at)), rounded_m(20 + kRadius_m * (1 - std::cos(at)))});
  }
  const PathEvaluation e = evaluated(flat_problem(), reference(points, 1));
  EXPECT_TRUE(e.feasible) << sentence(*e.refusal);
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

TEST(Evaluation, APathBeyondTheSteeringIsRefusedWithoutMarginsOrDraws) {
  const PlanningProblem problem = flat_problem();
  const PathEvaluation e = evaluated(
      problem, reference({{20, 25}, {22, 25}, {22.6, 25.6}, {22, 26.2}, {20, 26.2}}, 0.5));
  ASSERT_FALSE(e.feasible);
  EXPECT_EQ(e.refusal->reason, Rejection::kSteering);
  EXPECT_GT(e.refusal->exceeded->found, problem.vehicle.curvature_max_1pm);
  EXPECT_FALSE(e.spread);
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

TEST(Evaluation, ARockOnThePathIsAnObstacle) {
  PlanningProblem problem = lrv_problem(one_soil_map(
      60, firm_regolith(), flat, {{.x_m = 30, .y_m = 25, .radius_m = 1, .height_m = 1}}));
  const PathEvaluation e = evaluated(problem, reference({{10, 25}, {45, 25}}, 2));
  ASSERT_FALSE(e.feasible);
  EXPECT_EQ(e.refusal->reason, Rejection::kObstacle);
}

TEST(Evaluation, ACornerSharperThanTheSteeringIsRefused) {
  std::vector<PathPoint> points;
  for (double x = 10; x <= 20; ++x) points.push_back({x, 25});
  points.push_back({20.7, 25.7});
  for (double x = 20; x >= 10; --x) points.push_back({x, 26.4});
  const PathEvaluation e = evaluated(flat_problem(), reference(points, 0.5));
  ASSERT_FALSE(e.feasible);
  EXPECT_EQ(e.refusal->reason, Rejection::kSteering);
  EXPECT_NEAR(e.refusal->x_m, 20, 1.5);
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

/// Turns of a vehicle by its tightest radius times this.
PathEvaluation tightest_turn(const char* vehicle, double radius_factor) {
  Manoeuvre m = turn(0.04);
  m.vehicle = preset_vehicle(vehicle);
  m.radius_m = radius_factor / m.vehicle.curvature_max_1pm;
  const PlanningProblem base = flat_problem();
  const PreparedManoeuvre prepared = prepare(m, default_limits(m.vehicle), base);
  const World world(prepared.problem, WorldUse::kVerdict, 1);
  return evaluate(world, std::get<ReferencePath>(prepared.course), kSettings);
}

TEST(Evaluation, ATurnIsRefusedForItsSteeringOnlyWhereItIsTighterThanTheVehicleTurns) {
  for (const char* vehicle : {"lrv", "curiosity", "tohoku"}) {
    const PathEvaluation at_the_end = tightest_turn(vehicle, 1);
    EXPECT_TRUE(at_the_end.feasible) << vehicle << ": " << sentence(*at_the_end.refusal);
    const PathEvaluation beyond = tightest_turn(vehicle, 0.999);
    ASSERT_TRUE(beyond.refusal) << vehicle;
    EXPECT_EQ(beyond.refusal->reason, Rejection::kSteering) << vehicle;
  }
}

/// Turns Curiosity on a plane of its own.
Manoeuvre point_turn(double slope_deg) {
  Manoeuvre m = turn(1);
  m.kind = ManoeuvreKind::kPointTurn;
  m.vehicle = preset_vehicle("curiosity");
  m.slope_rad = slope_deg * kTestDegree;
  m.turn_rate_rad_s = 1 * kTestDegree;
  m.angle_rad = 60 * kTestDegree;
  return m;
}

PathEvaluation evaluated_on_its_own_limits(const Manoeuvre& manoeuvre) {
  const PlanningProblem base = flat_problem();
  const PreparedManoeuvre prepared = prepare(manoeuvre, default_limits(manoeuvre.vehicle), base);
  const World world(prepared.problem, WorldUse::kVerdict, 1);
  return evaluate(world, std::get<SpotTurn>(prepared.course), kSettings);
}

TEST(Evaluation, APointTurnOnTheFlatTurnsWhereItStands) {
  for (const bool right : {false, true}) {
    Manoeuvre m = point_turn(0);
    m.to_the_right = right;
    const PathEvaluation e = evaluated_on_its_own_limits(m);
    EXPECT_TRUE(e.feasible) << sentence(*e.refusal);
    EXPECT_EQ(e.tracking.end, TrackingEnd::kArrived);
    EXPECT_LT(e.tracking.deviation_max_m, 0.02);
    EXPECT_NEAR(e.tracking.last.state.yaw_rad, (right ? -1 : 1) * m.angle_rad, 0.02);
    for (const TrajectoryPoint& point : e.points) EXPECT_NEAR(point.demand_n, 0, 1e-9);
    // All headings are alike there.
    EXPECT_NEAR(e.points.front().margin, e.points.back().margin, 1e-6);
  }
}

TEST(Evaluation, APointTurnOnASlopeIsWorseTheSteeperItIs) {
  double before = 1;
  for (const double slope_deg : {0.0, 8.0, 16.0, 29.0}) {
    const PathEvaluation e = evaluated_on_its_own_limits(point_turn(slope_deg));
    EXPECT_LT(e.margin_min, before) << slope_deg;
    before = e.margin_min;
    if (slope_deg == 29) {
      EXPECT_FALSE(e.feasible);
    }
  }
}

TEST(Evaluation, APointTurnOfAVehicleThatCannotIsAnError) {
  Manoeuvre m = point_turn(0);
  m.vehicle = preset_vehicle("lrv");  // its wheels do not reach the angle
  const PlanningProblem base = flat_problem();
  EXPECT_THROW(prepare(m, base.limits, base), InputError);
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
