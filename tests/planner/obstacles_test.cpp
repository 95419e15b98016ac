#include "planner/problem/obstacles.h"

#include <gtest/gtest.h>

#include <limits>

#include "maps/ground_finder.h"
#include "terramech/vehicle/steered_wheel.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

bool hits(const Vehicle& vehicle, const TerrainMap& map, const VehicleState& state,
          double clearance_m = 0) {
  const GroundPatch patch = GroundFinder(map, vehicle).at(state.x_m, state.y_m, state.yaw_rad);
  return Obstacles(map, vehicle, clearance_m).hit(state, patch);
}

bool hits(const TerrainMap& map, double x_m, double y_m, double yaw_rad = 0,
          double clearance_m = 0) {
  return hits(preset_vehicle("lrv"), map, {.x_m = x_m, .y_m = y_m, .yaw_rad = yaw_rad},
              clearance_m);
}

TerrainMap with_rock(const Rock& rock) {
  return one_soil_map(50, firm_regolith(), flat, {rock});
}

}  // namespace

TEST(Obstacles, OpenGroundIsFree) {
  EXPECT_FALSE(hits(one_soil_map(50, firm_regolith(), flat), 25, 25));
}

TEST(Obstacles, RocksNoHigherThanAStepAreDrivenOver) {
  const double step_m = preset_vehicle("lrv").step_max_m;
  EXPECT_FALSE(hits(with_rock({25, 25, 0.3, step_m}), 25, 25));
  EXPECT_FALSE(hits(with_rock({26.1, 25.9, 0.3, step_m}), 25, 25));
}

TEST(Obstacles, AHigherRockStopsAWheelThatWouldClimbIt) {
  const Vehicle lrv = preset_vehicle("lrv");
  const double x = 25 + lrv.wheels[0].x_m, y = 25 + lrv.wheels[0].y_m;
  EXPECT_TRUE(hits(with_rock({x, y, 0.2, lrv.step_max_m + 0.02}), 25, 25));
}

TEST(Obstacles, ARockLowerThanTheBodyPassesBetweenTheWheels) {
  const double clearance_m = preset_vehicle("lrv").body.clearance_m;
  EXPECT_FALSE(hits(with_rock({25, 25, 0.2, clearance_m - 0.02}), 25, 25));
  EXPECT_TRUE(hits(with_rock({25, 25, 0.2, clearance_m + 0.02}), 25, 25));
}

TEST(Obstacles, ARockBesideTheVehicleIsHitOnlyByAWiderOne) {
  const double edge_m = 25 + preset_vehicle("lrv").body.y_max_m;
  const TerrainMap map = with_rock({25, edge_m + 0.55, 0.5, 1});
  EXPECT_FALSE(hits(map, 25, 25));
  EXPECT_TRUE(hits(map, 25, 25, 0, 0.1));
}

TEST(Obstacles, TheReserveOfASearchReachesDownwardsToo) {
  const double clearance_m = preset_vehicle("lrv").body.clearance_m;
  const TerrainMap map = with_rock({25, 25, 0.2, clearance_m - 0.02});
  EXPECT_FALSE(hits(map, 25, 25));
  EXPECT_TRUE(hits(map, 25, 25, 0, 0.1));
}

TEST(Obstacles, ACylinderIsMetWhereItStandsOnItsSlope) {
  const TerrainMap map = one_soil_map(
      50, firm_regolith(), [](double x, double /*y*/) { return 0.3 * x; }, {{27, 25, 0.3, 1}});
  EXPECT_TRUE(hits(map, 26, 25));
  EXPECT_FALSE(hits(map, 22, 25));
}

TEST(Obstacles, ARidgeHigherThanTheClearanceTouchesTheBodyFromBelow) {
  // A wall half a metre wide, between the axles.
  const auto ridge = [](double height) {
    return [height](double x, double /*y*/) { return std::abs(x - 25) < 0.3 ? height : 0.0; };
  };
  EXPECT_FALSE(hits(one_soil_map(50, firm_regolith(), ridge(0.3)), 25, 25));
  EXPECT_TRUE(hits(one_soil_map(50, firm_regolith(), ridge(0.5)), 25, 25));
}

TEST(Obstacles, HeadingDecidesWhatIsTouched) {
  const double beyond_side_m = 1.3;  // beyond the body's half width, within its half length
  const TerrainMap map = with_rock({25, 25 + beyond_side_m, 0.1, 1});
  EXPECT_FALSE(hits(map, 25, 25, 0));
  EXPECT_TRUE(hits(map, 25, 25, 90 * kTestDegree));
}

TEST(Obstacles, ABodyThatClearsRidgeAndRockAloneDoesNotClearARockOnARidge) {
  // 0.29 m is driven over, the underside is 0.356 m up: together they stand 0.57 m above the
  // wheels.
  const auto ridge = [](double x, double /*y*/) { return std::abs(x - 25) < 0.3 ? 0.28 : 0.0; };
  const Rock low{25, 25, 0.2, 0.29};
  EXPECT_FALSE(hits(one_soil_map(50, firm_regolith(), ridge), 25, 25));
  EXPECT_FALSE(hits(with_rock(low), 25, 25));
  EXPECT_TRUE(hits(one_soil_map(50, firm_regolith(), ridge, {low}), 25, 25));
}

TEST(Obstacles, TheBodyClearsEveryRockByItsHeightAboveTheWheelsPlaneAlone) {
  // Whatever part of it is ground and what part rock.
  const double clearance_m = preset_vehicle("lrv").body.clearance_m;
  for (const double ground_m : {0.1, 0.2, 0.3}) {
    const auto ridge = [&](double x, double /*y*/) {
      return std::abs(x - 25) < 0.3 ? ground_m : 0.0;
    };
    const auto with_top_at = [&](double top_m) {
      return one_soil_map(50, firm_regolith(), ridge, {{25, 25, 0.2, top_m - ground_m}});
    };
    EXPECT_FALSE(hits(with_top_at(clearance_m - 0.01), 25, 25)) << ground_m;
    EXPECT_TRUE(hits(with_top_at(clearance_m + 0.01), 25, 25)) << ground_m;
  }
}

TEST(Obstacles, WhatIsHighOnTheBodyLeansOutOnASlope) {
  // Down a slope of 22 deg the front of the body's top is farther ahead than any corner is from the
  // vehicle's origin on the level: it meets boulders, and walls, that its underside is not near.
  const Vehicle lrv = preset_vehicle("lrv");
  const double tilt = 22 * kTestDegree, top_m = lrv.body.clearance_m + lrv.body.height_m;
  const double front_m = lrv.body.x_max_m * std::cos(tilt) + top_m * std::sin(tilt);
  const auto down = [&](double x, double /*y*/) { return -std::tan(tilt) * x; };
  constexpr double kRadius_m = 0.5;
  const auto with_face_at = [&](double ahead_m) {
    return one_soil_map(50, firm_regolith(), down, {{25 + ahead_m + kRadius_m, 25, kRadius_m, 3}});
  };
  EXPECT_TRUE(hits(with_face_at(front_m - 0.05), 25, 25));
  EXPECT_FALSE(hits(with_face_at(front_m + 0.05), 25, 25));
  const auto with_wall_at = [&](double ahead_m) {
    constexpr double kCell_m = 0.1;
    return one_soil_map(
        50, firm_regolith(),
        [&](double x, double y) { return down(x, y) + (x > 25 + ahead_m ? 4 : 0); }, {}, kCell_m);
  };
  EXPECT_TRUE(hits(with_wall_at(front_m - 0.25), 25, 25));
  EXPECT_FALSE(hits(with_wall_at(front_m + 0.25), 25, 25));
}

TEST(Obstacles, GroundThatIsNotKnownHidesNeitherARockOnItNorASpikeBesideIt) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const double clearance_m = preset_vehicle("lrv").body.clearance_m;
  const auto hole = [](double x, double y) {
    return std::hypot(x - 25, y - 25) < 0.5 ? kUnknown : 0.0;
  };
  EXPECT_FALSE(hits(one_soil_map(50, firm_regolith(), hole), 25, 25));
  const auto rock_in_hole = [&](double height_m) {
    return one_soil_map(50, firm_regolith(), hole, {{25, 25, 0.2, height_m}});
  };
  EXPECT_TRUE(hits(rock_in_hole(clearance_m + 0.02), 25, 25));
  EXPECT_FALSE(hits(rock_in_hole(clearance_m - 0.02), 25, 25));
  // One cell rises into the body; a neighbour of it is known or not.
  for (const double dx : {-0.5, 0.0, 0.5}) {
    for (const double dy : {-0.5, 0.0, 0.5}) {
      for (const double spike_m : {0.3, 0.5}) {
        const auto ground = [&](double x, double y) {
          const auto is_at = [&](double at_x, double at_y) {
            return std::hypot(x - at_x, y - at_y) < 0.1;
          };
          if (is_at(25.25, 25.25)) return spike_m;
          return is_at(25.25 + dx, 25.25 + dy) ? kUnknown : 0.0;
        };
        EXPECT_EQ(hits(one_soil_map(50, firm_regolith(), ground), 25, 25), spike_m > clearance_m)
            << spike_m << " with unknown ground " << dx << ", " << dy << " beside it";
      }
    }
  }
}

/// Two boulders with so much room between them, either side of y = 25 m, beside the front axle.
TerrainMap gate(double room_m) {
  const double x = 25 + preset_vehicle("lrv").wheels[0].x_m;
  return one_soil_map(50, firm_regolith(), flat,
                      {{x, 25 + room_m / 2 + 1, 1, 2}, {x, 25 - room_m / 2 - 1, 1, 2}});
}

TEST(Obstacles, AGateIsAsNarrowAsTheSteeringMakesTheVehicle) {
  const Vehicle lrv = preset_vehicle("lrv");
  const VehicleState straight{.x_m = 25, .y_m = 25};
  VehicleState at_lock = straight;
  at_lock.curvature_1pm = lrv.curvature_max_1pm;
  EXPECT_FALSE(hits(lrv, gate(2.5), straight));
  EXPECT_FALSE(hits(lrv, gate(2.5), straight, 0.1));
  EXPECT_FALSE(hits(lrv, gate(2.1), straight));
  EXPECT_TRUE(hits(lrv, gate(2.0), straight));
  EXPECT_TRUE(hits(lrv, gate(2.5), at_lock));
  EXPECT_FALSE(hits(lrv, gate(2.7), at_lock));
}

TEST(Obstacles, SteeringEitherWayNeedsTheSameRoom) {
  const Vehicle lrv = preset_vehicle("lrv");
  for (const double room_m : {2.1, 2.3, 2.4, 2.5, 2.6}) {
    for (const double share : {0.2, 0.5, 1.0}) {
      const VehicleState left{.x_m = 25, .y_m = 25, .curvature_1pm = share * lrv.curvature_max_1pm};
      VehicleState right = left;
      right.curvature_1pm = -left.curvature_1pm;
      EXPECT_EQ(hits(lrv, gate(room_m), left), hits(lrv, gate(room_m), right)) << room_m << share;
    }
  }
}

TEST(Obstacles, NoSteeringFreesAPoseWhoseBodyTouches) {
  const Vehicle lrv = preset_vehicle("lrv");
  const TerrainMap map = with_rock({26.5, 25.9, 0.3, 1.5});
  for (double k = -lrv.curvature_max_1pm; k <= lrv.curvature_max_1pm; k += 0.1) {
    EXPECT_TRUE(hits(lrv, map, {.x_m = 25, .y_m = 25, .curvature_1pm = k})) << k;
  }
}

TEST(Obstacles, WheelsSetForTurningOnTheSpotAreMetWhereTheyThenReach) {
  // A rock lower than the body, beside a front wheel, where its corner comes once it is turned.
  const Vehicle curiosity = preset_vehicle("curiosity");
  const WheelMount& front = curiosity.wheels[0];
  const SteeredWheel turned = wheel_on_the_spot(curiosity, front);
  const double ahead = -0.9 * curiosity.wheel.radius_m, left = 0.45 * curiosity.wheel.width_m;
  const double x = 25 + front.x_m + turned.cos_steer * ahead - turned.sin_steer * left;
  const double y = 25 + front.y_m + turned.sin_steer * ahead + turned.cos_steer * left;
  const TerrainMap map = one_soil_map(50, firm_regolith(), flat, {{x, y, 0.04, 0.55}});
  EXPECT_FALSE(hits(curiosity, map, {.x_m = 25, .y_m = 25}));
  EXPECT_TRUE(hits(curiosity, map, {.x_m = 25, .y_m = 25, .turn_rate_rad_s = 0.1}));
}

}  // namespace regoplan
