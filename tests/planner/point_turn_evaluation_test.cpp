#include <gtest/gtest.h>

#include <cmath>

#include "terramech/basics/input_error.h"
#include "tests/planner/evaluated.h"

namespace regoplan {
namespace {

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

}  // namespace
}  // namespace regoplan
