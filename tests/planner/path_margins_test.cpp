// What a path's margins come to: where it is worst, and how bad its worst tenth is.
#include "planner/driving/path_margins.h"

#include <gtest/gtest.h>

#include <limits>

namespace regoplan {
namespace {

/// Points a metre apart along x, all three margins alike.
std::vector<TrajectoryPoint> way(const std::vector<double>& margins) {
  std::vector<TrajectoryPoint> points;
  for (const double margin : margins) {
    points.push_back({.x_m = static_cast<double>(points.size()),
                      .cornering_margin = margin,
                      .tip_over_margin = margin,
                      .traction_margin = margin,
                      .margin = margin});
  }
  return points;
}

TEST(WorstTenth, IsTheMeanOfTheTenthOfTheWayWhereItIsSmallest) {
  // Two pieces of ten touch the weak point; the worst tenth is one of them.
  EXPECT_DOUBLE_EQ(margin_of_worst_tenth(way({.5, .5, .5, .1, .5, .5, .5, .5, .5, .5, .5})), .1);
  // Of twenty, two touch it: they are the worst tenth.
  std::vector<double> margins(21, .5);
  margins[7] = .1;
  EXPECT_DOUBLE_EQ(margin_of_worst_tenth(way(margins)), .1);
  // Of forty, two of the four metres of the worst tenth.
  margins.assign(41, .5);
  margins[7] = .1;
  EXPECT_DOUBLE_EQ(margin_of_worst_tenth(way(margins)), .3);
}

TEST(WorstTenth, CountsMetresAndNotPoints) {
  // Ten points crowd within a centimetre of the start; the rest is one good long way.
  std::vector<TrajectoryPoint> points = way(std::vector<double>(10, -.2));
  for (TrajectoryPoint& point : points) point.x_m *= 1e-3;
  points.push_back({.x_m = 10, .margin = .4});
  points.push_back({.x_m = 20, .margin = .4});
  // The piece of 10 m that starts at the last bad point is bad as a whole.
  EXPECT_NEAR(margin_of_worst_tenth(points), -.2, 1e-12);
  points[9].margin = .4;
  EXPECT_GT(margin_of_worst_tenth(points), .39);
}

TEST(WorstTenth, OfAVehicleThatStandsIsItsMargin) {
  std::vector<TrajectoryPoint> points = way({.3, .2});
  points[1].x_m = 0;
  EXPECT_EQ(margin_of_worst_tenth(points), .3);
}

TEST(LimitingPlace, SaysWhichMarginIsSmallestAndWhere) {
  std::vector<TrajectoryPoint> points = way({.5, .5, .5});
  points[1].tip_over_margin = points[1].margin = .2;
  const LimitingPlace place = limiting_place(points);
  EXPECT_EQ(place.margin, MarginKind::kTipOver);
  EXPECT_EQ(place.x_m, 1);
}

TEST(LimitingPlace, AMarginThatIsMissingComesBeforeAll) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  std::vector<TrajectoryPoint> points = way({.5, -.5, .5});
  points[2].traction_margin = points[2].margin = kMissing;
  EXPECT_EQ(smallest_margin_index(points), 2);
  EXPECT_EQ(limiting_place(points).margin, MarginKind::kTraction);
}

}  // namespace
}  // namespace regoplan
