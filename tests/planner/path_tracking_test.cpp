// The law that drives a path in closed loop, without a judge of margins.
#include "planner/evaluation/path_tracking.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flat_problem.h"

namespace regoplan {
namespace {

class PathTracking : public testing::Test {
 protected:
  static ReferencePath path(const std::vector<PathPoint>& points, double speed_mps) {
    PathCurve curve(points);
    SpeedProfile speed({{0, speed_mps}, {curve.length_m(), speed_mps}});
    return {.name = "path", .legs = {{std::move(curve), std::move(speed)}}};
  }

  /// A quarter of a circle to the left.
  static std::vector<PathPoint> bend(double radius_m) {
    std::vector<PathPoint> points;
    for (int i = 0; i <= 18; ++i) {
      const double angle = i * 5 * kTestDegree;
      points.push_back({15 + radius_m * std::sin(angle), 15 + radius_m * (1 - std::cos(angle))});
    }
    return points;
  }

  PlanningProblem problem_ = lrv_problem(one_soil_map(60, firm_regolith(), flat));
  World world_{problem_, WorldUse::kVerdict, 1};
  FollowerChoice follower_;
};

TEST_F(PathTracking, KeepsToAStraightPathAndArrivesInItsTime) {
  const TrackingRun run = track(world_, path({{10, 25}, {45, 25}}, 2), follower_, 1);
  EXPECT_EQ(run.end, TrackingEnd::kArrived);
  EXPECT_LT(run.deviation_max_m, 1e-6);
  EXPECT_NEAR(run.duration_s, 17.5, 0.5);
}

TEST_F(PathTracking, KeepsNearABendAndStraysTheMoreTheFasterItIs) {
  const TrackingRun slow = track(world_, path(bend(20), 1), follower_, 2);
  const TrackingRun fast = track(world_, path(bend(20), 2.5), follower_, 2);
  ASSERT_EQ(slow.end, TrackingEnd::kArrived);
  ASSERT_EQ(fast.end, TrackingEnd::kArrived);
  EXPECT_LT(slow.deviation_max_m, 0.1);
  EXPECT_GT(fast.deviation_max_m, slow.deviation_max_m);
}

/// Where a path ends at rest its side slope is what it was: so are heading and steering.
TEST_F(PathTracking, ArrivesAtRestOnASideSlopeHeadedAsItWentAlongIt) {
  const PlanningProblem tilted =
      lrv_problem(one_soil_map(60, firm_regolith(), [](double, double y_m) { return 0.25 * y_m; }));
  const World world(tilted, WorldUse::kVerdict, 1);
  PathCurve curve({{10, 25}, {45, 25}});
  SpeedProfile speed({{0, 0}, {5, 1}, {30, 1}, {curve.length_m(), 0}});
  for (const bool reverse : {false, true}) {
    const ReferencePath along{.name = "path",
                              .legs = {{.curve = curve, .speed = speed, .reverse = reverse}}};
    const TrackingRun run = track(world, along, {.kind = FollowerKind::kCompensated}, 1);
    ASSERT_EQ(run.end, TrackingEnd::kArrived);
    const VehicleState& middle = run.moments[run.moments.size() / 2].state;
    EXPECT_NEAR(run.last.state.yaw_rad, middle.yaw_rad, 0.01) << reverse;
    EXPECT_NEAR(run.last.state.curvature_1pm, middle.curvature_1pm, 0.01) << reverse;
    EXPECT_GT(std::abs(std::sin(middle.yaw_rad)), 0.03) << "it crabs by its slip angle";
  }
}

TEST_F(PathTracking, IsTheSameToBothSides) {
  std::vector<PathPoint> right = bend(20);
  for (PathPoint& point : right) point.y_m = 50 - point.y_m;
  const TrackingRun to_left = track(world_, path(bend(20), 2), follower_, 2);
  const TrackingRun to_right = track(world_, path(right, 2), follower_, 2);
  EXPECT_NEAR(to_left.deviation_max_m, to_right.deviation_max_m, 1e-6);
  EXPECT_NEAR(to_left.energy_j, to_right.energy_j, 1e-6 * to_left.energy_j);
}

TEST_F(PathTracking, StandsAndGoesBackWhereThePathChangesDirection) {
  ReferencePath ahead = path({{10, 25}, {30, 25}}, 2);
  ReferencePath back = path({{30, 25}, {20, 25.2}, {12, 26}}, 1);
  back.legs.front().reverse = true;
  ahead.legs.push_back(back.legs.front());
  const TrackingRun run = track(world_, ahead, follower_, 1);
  ASSERT_EQ(run.end, TrackingEnd::kArrived);
  EXPECT_NEAR(run.last.state.x_m, 12, 0.1);
  EXPECT_NEAR(run.last.state.y_m, 26, 0.1);
  EXPECT_LT(std::abs(run.last.state.yaw_rad), 0.3);  // it still faces ahead
  EXPECT_LT(run.deviation_max_m, 0.2);
  EXPECT_NEAR(run.last.s_m, ahead.length_m(), 0.1);
  EXPECT_GT(run.duration_s, ahead.duration_s());
}

TEST_F(PathTracking, WaitsAtRestUntilTheWheelsAreSteeredForTheNextLeg) {
  // Sixths of circles of 4 m: ahead on left lock to (20, 20), backwards from there on right lock.
  std::vector<PathPoint> to, from;
  for (int i = 0; i <= 12; ++i) {
    const double a = (60 - 5 * i) * kTestDegree, b = 5 * i * kTestDegree;
    to.push_back({20 - 4 * std::sin(a), 24 - 4 * std::cos(a)});
    from.push_back({20 - 4 * std::sin(b), 16 + 4 * std::cos(b)});
  }
  ReferencePath shunt{.name = "shunt", .legs = {}};
  for (const auto& points : {to, from}) {
    PathCurve curve(points);
    const double length_m = curve.length_m();
    shunt.legs.push_back(
        {.curve = std::move(curve),
         .speed = SpeedProfile({{0, 0}, {1.5, 0.9}, {length_m - 1.5, 0.9}, {length_m, 0}}),
         .reverse = !shunt.legs.empty()});
  }
  const TrackingRun run = track(world_, shunt, {.kind = FollowerKind::kCompensated}, 1);
  ASSERT_EQ(run.end, TrackingEnd::kArrived);
  EXPECT_LT(run.deviation_max_m, 0.05);
}

TEST_F(PathTracking, EndsWhereItStraysFartherThanAllowed) {
  const TrackingRun run = track(world_, path(bend(20), 2.5), follower_, 0.005);
  EXPECT_EQ(run.end, TrackingEnd::kStrayed);
  EXPECT_LT(run.last.s_m, path(bend(20), 2.5).length_m() - 1);
}

TEST_F(PathTracking, EndsAtALimitOfTheStateAndNamesIt) {
  const TrackingRun run = track(world_, path({{10, 25}, {70, 25}}, 2), follower_, 1);
  EXPECT_EQ(run.end, TrackingEnd::kRejected);
  ASSERT_TRUE(run.rejected);
  // The body reaches over the border before the centre of gravity does.
  EXPECT_EQ(run.rejected->reason, Rejection::kUnknownTerrain);
}

TEST_F(PathTracking, SaysNothingAboutThePathWhereItWasStopped) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(track(world_, path({{10, 25}, {45, 25}}, 2), follower_, 1, stop.get_token()).end,
            TrackingEnd::kInterrupted);
}

}  // namespace
}  // namespace regoplan
