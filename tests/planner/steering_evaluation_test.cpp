// Paths that ask for more at a place between stations: bends, also such as the vehicle cannot
// steer, and short braking.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/planner/evaluated.h"

namespace regoplan {
namespace {

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

TEST(Evaluation, TheMarginOfAShortBrakingIsToldWhereverItLies) {
  std::vector<double> margins;
  for (const double at_m : {20.0, 20.1, 20.2, 20.3, 20.4}) {
    ReferencePath path = reference({{10, 25}, {20, 25}, {30, 25}, {40, 25}}, 0.6);
    path.legs[0].speed = SpeedProfile({{0, 0.6},
                                       {at_m, 0.6},
                                       {at_m + 0.1, 0.52},
                                       {at_m + 0.2, 0.52},
                                       {at_m + 0.3, 0.6},
                                       {path.legs[0].length_m(), 0.6}});
    margins.push_back(evaluated(flat_problem(), path).margin_min);
  }
  for (const double margin : margins) EXPECT_NEAR(margin, margins[0], 1e-3);
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

TEST(Evaluation, APathBeyondTheSteeringIsRefusedWithoutMarginsOrDraws) {
  const PlanningProblem problem = flat_problem();
  const PathEvaluation e = evaluated(
      problem, reference({{20, 25}, {22, 25}, {22.6, 25.6}, {22, 26.2}, {20, 26.2}}, 0.5));
  ASSERT_FALSE(e.feasible);
  EXPECT_EQ(e.refusal->reason, Rejection::kSteering);
  EXPECT_GT(e.refusal->exceeded->found, problem.vehicle.curvature_max_1pm);
  EXPECT_FALSE(e.spread);
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

}  // namespace
}  // namespace regoplan
