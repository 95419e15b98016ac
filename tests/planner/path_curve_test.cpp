#include "planner/course/path_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

std::vector<PathPoint> circle(double radius_m, int points, double angle_rad) {
  std::vector<PathPoint> path;
  for (int i = 0; i < points; ++i) {
    const double at = angle_rad * i / (points - 1);
    path.push_back({radius_m * std::sin(at), radius_m * (1 - std::cos(at))});
  }
  return path;
}

TEST(PathCurve, ACircleKeepsItsCurvatureToItsEnds) {
  constexpr double kRadius_m = 10;
  const PathCurve curve(circle(kRadius_m, 41, std::numbers::pi));
  EXPECT_NEAR(curve.length_m(), kRadius_m * std::numbers::pi, 1e-4);
  for (double s = 0; s <= curve.length_m(); s += 0.1) {
    EXPECT_NEAR(curve.at(s).curvature_1pm, 1 / kRadius_m, 5e-3 / kRadius_m) << s;
  }
}

TEST(PathCurve, GoesThroughItsPointsByArcLength) {
  const std::vector<PathPoint> points{{0, 0}, {3, 1}, {5, 4}, {4, 8}, {9, 9}};
  const PathCurve curve(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CurvePlace place = curve.at(curve.point_arc_m()[i]);
    EXPECT_NEAR(place.x_m, points[i].x_m, 1e-9);
    EXPECT_NEAR(place.y_m, points[i].y_m, 1e-9);
  }
  constexpr double kStep_m = 1e-3;
  for (double s = 0; s + kStep_m <= curve.length_m(); s += 0.37) {
    const CurvePlace a = curve.at(s), b = curve.at(s + kStep_m);
    EXPECT_NEAR(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m), kStep_m, 1e-8);
    // Twice differentiable: neither heading nor curvature jumps.
    EXPECT_NEAR(std::remainder(b.heading_rad - a.heading_rad, 2 * std::numbers::pi),
                kStep_m * a.curvature_1pm, 1e-4);
    EXPECT_NEAR(b.curvature_1pm, a.curvature_1pm, 0.05);
  }
}

TEST(PathCurve, NoPlaceOfAStretchBendsMoreThanItsSharpest) {
  const PathCurve curve({{0, 0}, {3, 1}, {3.2, 1.3}, {5, 4}, {4, 8}, {4.1, 8.4}, {9, 9}, {9, 12}});
  constexpr double kStretch_m = 0.7;
  for (double from = 0; from + kStretch_m <= curve.length_m(); from += 0.3) {
    const double sharpest_m = curve.sharpest_m(from, from + kStretch_m);
    EXPECT_GE(sharpest_m, from);
    EXPECT_LE(sharpest_m, from + kStretch_m);
    const double most_1pm = std::abs(curve.at(sharpest_m).curvature_1pm);
    for (double s = from; s <= from + kStretch_m; s += 1e-3) {
      EXPECT_LE(std::abs(curve.at(s).curvature_1pm), most_1pm * (1 + 1e-9)) << from << " " << s;
    }
  }
}

TEST(PathCurve, AHairpinIsSharpestAtItsApexHoweverNarrow) {
  for (const double apart_m : {2.0, 0.5, 1e-3}) {
    // Three points make a parabola, whose curvature at the apex follows from its two derivatives.
    const PathCurve curve({{0, 0}, {30, 0}, {0, apart_m}});
    const double apex_m = curve.sharpest_m(0, curve.length_m());
    EXPECT_NEAR(apex_m, curve.length_m() / 2, 0.05);
    EXPECT_NEAR(curve.at(apex_m).curvature_1pm, 240 / (apart_m * apart_m),
                2e-3 * 240 / (apart_m * apart_m))
        << apart_m;
  }
}

TEST(PathCurve, WhereItTurnsBackAlongItsOwnLineTheCurvatureIsInfinite) {
  const PathCurve curve({{0, 0}, {30, 0}, {0, 0}});
  EXPECT_TRUE(std::isinf(curve.at(curve.sharpest_m(0, curve.length_m())).curvature_1pm));
}

TEST(PathCurve, TheWayBackIsTheSameWithTheOppositeCurvature) {
  std::vector<PathPoint> points{{0, 0}, {3, 1}, {5, 4}, {4, 8}, {9, 9}};
  const PathCurve there(points);
  const PathCurve back({points.rbegin(), points.rend()});
  ASSERT_NEAR(there.length_m(), back.length_m(), 1e-9);
  for (double s = 0; s <= there.length_m(); s += 0.25) {
    const CurvePlace a = there.at(s), b = back.at(there.length_m() - s);
    EXPECT_NEAR(a.x_m, b.x_m, 1e-6);
    EXPECT_NEAR(a.y_m, b.y_m, 1e-6);
    EXPECT_NEAR(a.curvature_1pm, -b.curvature_1pm, 1e-6);
  }
}

TEST(PathCurve, MirroredPointsMirrorTheCurve) {
  const std::vector<PathPoint> points{{0, 0}, {3, 1}, {5, 4}, {4, 8}};
  std::vector<PathPoint> mirrored = points;
  for (PathPoint& point : mirrored) point.y_m = -point.y_m;
  const PathCurve a(points), b(mirrored);
  for (double s = 0; s <= a.length_m(); s += 0.5) {
    EXPECT_NEAR(a.at(s).curvature_1pm, -b.at(s).curvature_1pm, 1e-12);
    EXPECT_NEAR(a.at(s).y_m, -b.at(s).y_m, 1e-12);
  }
}

TEST(PathCurve, TwoPointsAreAStraightLine) {
  const PathCurve curve({{1, 2}, {4, 6}});
  EXPECT_DOUBLE_EQ(curve.length_m(), 5);
  EXPECT_EQ(curve.at(2).curvature_1pm, 0);
  EXPECT_NEAR(curve.at(2.5).x_m, 2.5, 1e-12);
}

TEST(PathCurve, RepeatedPointsAreLeftOut) {
  const PathCurve curve({{0, 0}, {0, 0}, {0.05, 0}, {2, 0}, {2, 0}, {4, 0}, {4.01, 0}});
  EXPECT_EQ(curve.thinned(), 4);
  EXPECT_NEAR(curve.length_m(), 4.01, 1e-12);
  EXPECT_NEAR(curve.at(2).curvature_1pm, 0, 1e-12);
}

TEST(PathCurve, WhatIsNoPathIsRefused) {
  EXPECT_THROW(PathCurve({}), InputError);
  EXPECT_THROW(PathCurve({{1, 1}}), InputError);
  EXPECT_THROW(PathCurve({{1, 1}, {1, 1}, {1.01, 1}}), InputError);
  EXPECT_THROW(PathCurve({{1, 1}, {std::numeric_limits<double>::quiet_NaN(), 1}}), InputError);
  EXPECT_THROW(PathCurve({{1, 1}, {std::numeric_limits<double>::infinity(), 1}}), InputError);
}

TEST(PathCurve, ItsPointsAreApartEvenWhereItEndsBesideThem) {
  // The last but one is left out for the last one, which lies between the two before it.
  const PathCurve back_again({{0, 0}, {5, 0}, {5.15, 0}, {5.06, 0}});
  EXPECT_NEAR(back_again.length_m(), 5.06, 1e-9);
  ASSERT_EQ(back_again.point_arc_m().size(), 4);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(back_again.point_arc_m()[i], 5.06, 1e-9);
  EXPECT_THROW(PathCurve({{0, 0}, {0.15, 0}, {0.06, 0}}), InputError);
}

}  // namespace
}  // namespace regoplan
