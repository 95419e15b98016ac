#include "terramech/margins/margins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

/// Standing still on a slope that falls toward the direction (x, y): the ground pushes uphill.
GroundReaction standing(double weight_n, double slope_rad, double x, double y) {
  return {.normal_n = weight_n * std::cos(slope_rad),
          .forward_n = -x * weight_n * std::sin(slope_rad),
          .left_n = -y * weight_n * std::sin(slope_rad)};
}

TEST(TipOver, IsOneAtRestOnTheFlat) {
  for (const std::string& name : preset_vehicle_names()) {
    const Vehicle vehicle = preset_vehicle(name);
    EXPECT_EQ(SupportPolygon(vehicle).tip_over_margin({.normal_n = 100}), 1) << name;
  }
}

TEST(TipOver, VanishesAtTheStaticAngleOverEveryRectangleEdge) {
  for (const char* name : {"tohoku", "lrv"}) {
    const Vehicle vehicle = preset_vehicle(name);
    const SupportPolygon polygon(vehicle);
    const double h = vehicle.cg_height_m;
    const double to_front = vehicle.wheels[0].x_m, to_left = vehicle.wheels[0].y_m;
    for (const double side : {-1.0, 1.0}) {
      EXPECT_NEAR(polygon.tip_over_margin(standing(500, std::atan(to_front / h), side, 0)), 0,
                  1e-12);
      EXPECT_NEAR(polygon.tip_over_margin(standing(500, std::atan(to_left / h), 0, side)), 0,
                  1e-12);
      EXPECT_LT(polygon.tip_over_margin(standing(500, std::atan(to_left / h) + 0.01, 0, side)), 0);
      EXPECT_GT(polygon.tip_over_margin(standing(500, std::atan(to_left / h) - 0.01, 0, side)), 0);
    }
  }
}

TEST(TipOver, CuriosityTipsOverTheSlantedEdgesFromCornerToMiddleWheel) {
  const Vehicle vehicle = preset_vehicle("curiosity");
  const WheelMount& front = vehicle.wheels[0];
  const WheelMount& middle = vehicle.wheels[2];
  ASSERT_GT(middle.y_m, front.y_m);
  const double dx = middle.x_m - front.x_m, dy = middle.y_m - front.y_m;
  const double length = std::hypot(dx, dy);
  const double distance = std::abs(front.x_m * dy - front.y_m * dx) / length;
  const double nx = dy / length, ny = -dx / length;
  ASSERT_GT(ny, 0);
  EXPECT_NEAR(SupportPolygon(vehicle).tip_over_margin(
                  standing(500, std::atan(distance / vehicle.cg_height_m), nx, ny)),
              0, 1e-12);
}

TEST(TipOver, OfThreeWheelsIsSmallestOverTheSlantedEdges) {
  const Vehicle vehicle = tricycle();
  const SupportPolygon polygon(vehicle);
  // From (1.4, 0) to (-0.7, 0.9): distance of the origin 1.4 * 0.9 / |(2.1, 0.9)|.
  const double length = std::hypot(2.1, 0.9), distance = 1.4 * 0.9 / length;
  const GroundReaction reaction = standing(500, 0.3, 0, 1);
  EXPECT_NEAR(polygon.tip_over_margin(reaction),
              1 - std::tan(0.3) * (2.1 / length) * vehicle.cg_height_m / distance, 1e-12);
}

TEST(TipOver, AFreeFallCountsAsTipped) {
  const SupportPolygon polygon(preset_vehicle("lrv"));
  EXPECT_EQ(polygon.tip_over_margin({.normal_n = 0}), -1);
  EXPECT_EQ(polygon.tip_over_margin({.normal_n = -5}), -1);
}

TEST(TipOver, VanishesWhereTheFirstWheelsOfABoxLift) {
  // Both tell the same balance: a rectangle's inner wheels carry nothing when it is about to tip.
  const Vehicle lrv = preset_vehicle("lrv");
  const LoadSharing sharing(lrv);
  const double left = 1000 * lrv.wheels[0].y_m / lrv.cg_height_m;
  const GroundReaction reaction{.normal_n = 1000, .forward_n = 0, .left_n = left};
  EXPECT_NEAR(SupportPolygon(lrv).tip_over_margin(reaction), 0, 1e-12);
  EXPECT_NEAR(sharing.load_n(0, reaction), 0, 1e-9);
  EXPECT_NEAR(sharing.load_n(2, reaction), 0, 1e-9);
}

TEST(CorneringDemand, IsCentripetalForceLessGravity) {
  EXPECT_EQ(cornering_demand_n(2, 3, 0.5, 0), 9);    // left turn
  EXPECT_EQ(cornering_demand_n(2, 3, -0.5, 0), -9);  // right turn
  EXPECT_EQ(cornering_demand_n(2, 3, 0.5, 4.5), 0);  // gravity turns it
  EXPECT_EQ(cornering_demand_n(2, 3, 0.5, -1), 11);  // gravity pulls out of the turn
}

TEST(CorneringMargin, IsTheDistanceToTheNearerEndOverTheWeight) {
  EXPECT_EQ(cornering_margin(1, -4, 4, 10), 0.3);
  EXPECT_EQ(cornering_margin(-1, -4, 4, 10), 0.3);
  EXPECT_EQ(cornering_margin(4, -4, 4, 10), 0);
  EXPECT_EQ(cornering_margin(5, -4, 4, 10), -0.1);
  EXPECT_EQ(cornering_margin(-5, -4, 4, 10), -0.1);
  EXPECT_EQ(cornering_margin(0, 1, 4, 10), -0.1);  // an interval need not hold zero
}

}  // namespace
}  // namespace regoplan
