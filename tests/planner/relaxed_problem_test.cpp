#include "planner/certificate/relaxed_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "planner/certificate/closed_boxes.h"
#include "planner/certificate/open_boxes.h"
#include "planner/problem/world.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

std::string certificate(const PlanningProblem& problem) {
  return certificate_of_infeasibility(problem).value_or("");
}

/// Rocks from edge to edge but for a gap at y = 25.
std::vector<Rock> wall_with_gap(double gap_m) {
  std::vector<Rock> rocks;
  for (double away = gap_m / 2 + 0.6; away < 25; away += 0.8) {
    rocks.push_back({25, 25 - away, 0.6, 3});
    rocks.push_back({25, 25 + away, 0.6, 3});
  }
  return rocks;
}

}  // namespace

TEST(RelaxedProblem, OpenGroundHasNoCertificate) {
  EXPECT_EQ(certificate(lrv_problem(one_soil_map(50, firm_regolith(), flat))), "");
}

TEST(RelaxedProblem, AClosedRingOfRocksIsCertifiedAndAGapThatTheVehicleFitsIsNot) {
  const auto behind = [](std::vector<Rock> rocks) {
    return certificate(lrv_problem(one_soil_map(50, firm_regolith(), flat, std::move(rocks))));
  };
  EXPECT_NE(behind(ring_of_rocks(40, 25, 7)).find("rocks"), std::string::npos);
  EXPECT_NE(behind(wall_with_gap(0.8)).find("rocks"), std::string::npos);
  EXPECT_NE(behind(wall_with_gap(1.6)).find("rocks"), std::string::npos);
  EXPECT_EQ(behind(wall_with_gap(2.3)), "");  // the vehicle is 2.06 m wide
}

TEST(RelaxedProblem, ARingOfRocksIsCertifiedOnSlopingGroundToo) {
  for (const double slope_deg : {6.0, 12.0, 18.0}) {
    for (const double uphill_deg : {0.0, 50.0, 200.0}) {
      const double slope = std::tan(slope_deg * kTestDegree);
      const double east = slope * std::cos(uphill_deg * kTestDegree);
      const double north = slope * std::sin(uphill_deg * kTestDegree);
      const auto tilted = [&](double x, double y) { return east * x + north * y; };
      const auto with = [&](std::vector<Rock> rocks) {
        return certificate(
            lrv_problem(one_soil_map(50, firm_regolith(), tilted, std::move(rocks))));
      };
      EXPECT_NE(with(ring_of_rocks(40, 25, 7)).find("rocks"), std::string::npos)
          << slope_deg << " deg, uphill to " << uphill_deg << " deg";
      EXPECT_EQ(with(wall_with_gap(2.3)), "");
    }
  }
}

TEST(RelaxedProblem, RocksThatTheBodyPassesOverCloseNothing) {
  std::vector<Rock> low = wall_with_gap(0);
  for (Rock& rock : low) rock.height_m = 0.25;
  EXPECT_EQ(certificate(lrv_problem(one_soil_map(50, firm_regolith(), flat, low))), "");
}

TEST(RelaxedProblem, ARampTooSteepAllRoundIsCertifiedAndOneBelowTheLimitIsNot) {
  const auto plateau = [](double degrees) {
    return [degrees](double x, double y) {
      const double beyond = std::clamp(std::hypot(x - 40, y - 25) - 4, 0.0, 6.0);
      return -std::tan(degrees * kTestDegree) * beyond;
    };
  };
  PlanningProblem steep = lrv_problem(one_soil_map(50, firm_regolith(), plateau(38)));
  EXPECT_NE(certificate(steep).find("slope"), std::string::npos);
  PlanningProblem gentle = lrv_problem(one_soil_map(50, firm_regolith(), plateau(20)));
  EXPECT_EQ(certificate(gentle), "");
}

TEST(RelaxedProblem, AGoalOnGroundTooSteepIsCertified) {
  const auto cliff = [](double x, double /*y*/) { return 1.2 * std::max(0.0, x - 30); };
  EXPECT_NE(certificate(lrv_problem(one_soil_map(50, firm_regolith(), cliff))).find("goal"),
            std::string::npos);
}

TEST(RelaxedProblem, AGoalHoweverWideHasNoCertificate) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  for (const double radius_m : {1e8, 1e9, 1e12, 1e300, std::numeric_limits<double>::max()}) {
    problem.goal.radius_m = radius_m;
    EXPECT_EQ(certificate(problem), "") << radius_m;
  }
}

TEST(PlaceGrid, APointHoweverFarOffHasItsNearestPlace) {
  const PlaceGrid grid{.west_m = 10, .south_m = 20, .cell_m = 0.25, .columns = 8, .rows = 4};
  for (const double far_m : {1e3, 1e9, 1e300}) {
    const PlaceGrid::Place north_east = grid.at(far_m, far_m), south_west = grid.at(-far_m, -far_m);
    EXPECT_EQ(north_east.column, 7) << far_m;
    EXPECT_EQ(north_east.row, 3) << far_m;
    EXPECT_EQ(south_west.column, 0) << far_m;
    EXPECT_EQ(south_west.row, 0) << far_m;
  }
  EXPECT_EQ(grid.at(11.3, 20.6).column, 5);
  EXPECT_EQ(grid.at(11.3, 20.6).row, 2);
}

TEST(ClosedBoxes, NoPoseOfAClosedBoxIsOneThatTheVerdictAllows) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  int closed = 0;
  for (int map = 0; map < 12; ++map) {
    std::vector<Rock> rocks;
    for (int i = 0; i < 30; ++i) {
      rocks.push_back({25 + 22 * unit(random), 25 + 22 * unit(random), 0.7 + 0.5 * unit(random),
                       1.6 + unit(random)});
    }
    const double relief = map % 3;
    const double east = map < 3 ? 0 : 0.3 * unit(random), north = map < 3 ? 0 : 0.3 * unit(random);
    const auto hills = [=](double x, double y) {
      return 0.4 * relief * std::sin(x / 4) * std::cos(y / 3) + east * x + north * y;
    };
    // Start and goal play no part here.
    const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), hills, rocks));
    const ClosedBoxes boxes(problem);
    const World verdict(problem, WorldUse::kVerdict, 1);
    for (int i = 0; i < 4000; ++i) {
      const PoseBox box{.x_m = 25 + 22 * unit(random),
                        .y_m = 25 + 22 * unit(random),
                        .heading_rad = std::numbers::pi * unit(random),
                        .half_m = 0.125,
                        .half_rad = 0.1};
      if (!boxes.too_steep(box) && boxes.reason(box) == ClosedBoxes::Reason::kOpen) continue;
      ++closed;
      for (int pose = 0; pose < 10; ++pose) {
        VehicleState state;
        state.x_m = box.x_m + box.half_m * unit(random);
        state.y_m = box.y_m + box.half_m * unit(random);
        state.yaw_rad = box.heading_rad + box.half_rad * unit(random);
        EXPECT_TRUE(verdict.rejected(state, {}, std::nullopt));
      }
    }
  }
  EXPECT_GT(closed, 300);
}

TEST(ClosedBoxes, RoughGroundThatLetsSomePoseLeanLessIsNotTooSteep) {
  PlanningProblem problem = lrv_problem(one_soil_map(30, firm_regolith(), flat));
  problem.limits.slope_max_rad = 20 * kTestDegree;
  // A slope as steep as half a degree above the limit: on bumps the vehicle may lean less, on what
  // is all but even it may not.
  const auto closed_on = [&](double bumps_m) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    const PlanningProblem on = [&] {
      PlanningProblem made = problem;
      made.map = one_soil_map(30, firm_regolith(), [&](double x_m, double) {
        return std::tan(20.5 * kTestDegree) * x_m + bumps_m * unit(random);
      });
      return made;
    }();
    const ClosedBoxes boxes(on);
    const World verdict(on, WorldUse::kVerdict, 1);
    int closed = 0, allowed = 0;
    for (int i = 0; i < 300; ++i) {
      const PoseBox box{.x_m = 15 + 8 * unit(random),
                        .y_m = 15 + 8 * unit(random),
                        .heading_rad = std::numbers::pi * unit(random),
                        .half_m = 0.05,
                        .half_rad = 0.05};
      const VehicleState middle =
          verdict.dynamics().rolling_state(box.x_m, box.y_m, box.heading_rad, 0);
      const bool free = !verdict.rejected(middle, {}, std::nullopt);
      allowed += free;
      if (!boxes.too_steep(box)) continue;
      ++closed;
      EXPECT_FALSE(free);
    }
    return std::pair{closed, allowed};
  };
  const auto [closed_rough, allowed_rough] = closed_on(0.1);
  EXPECT_EQ(closed_rough, 0);
  EXPECT_GT(allowed_rough, 50);
  const auto [closed_even, allowed_even] = closed_on(1e-4);
  EXPECT_GT(closed_even, 250);
  EXPECT_EQ(allowed_even, 0);
}

TEST(ClosedBoxes, WavesAsLongAsTheTrackLetAVehicleAcrossTheSlopeLeanLess) {
  // Bumps under one side and hollows under the other take most of what the bound of the turn allows
  // off the slope: half of that bound would close poses that the verdict allows.
  const Vehicle lrv = preset_vehicle("lrv");
  const double half_track_m = lrv.wheels.front().y_m;
  constexpr double kWave_m = 0.15, kSlope = 0.5;
  const auto waves = [&](double x_m, double /*y_m*/) {
    return kSlope * x_m - kWave_m * std::sin(std::numbers::pi / 2 * (x_m - 15) / half_track_m);
  };
  int allowed = 0;
  for (const double limit_deg : {17.0, 18.0, 19.0, 20.0, 21.0, 22.0}) {
    PlanningProblem problem = lrv_problem(one_soil_map(30, firm_regolith(), waves, {}, 0.25));
    problem.limits.slope_max_rad = limit_deg * kTestDegree;
    const ClosedBoxes boxes(problem);
    const World verdict(problem, WorldUse::kVerdict, 1);
    for (double y_m = 10; y_m < 20; y_m += 0.5) {
      for (const double x_m : {14.9, 15.0, 15.1}) {
        const PoseBox box{.x_m = x_m,
                          .y_m = y_m,
                          .heading_rad = std::numbers::pi / 2,
                          .half_m = 0.02,
                          .half_rad = 0.02};
        const bool free = !verdict.rejected(
            verdict.dynamics().rolling_state(box.x_m, box.y_m, box.heading_rad, 0), {},
            std::nullopt);
        allowed += free;
        if (!boxes.too_steep(box)) continue;
        EXPECT_FALSE(free) << limit_deg;
      }
    }
  }
  EXPECT_GT(allowed, 60);
}

}  // namespace regoplan
