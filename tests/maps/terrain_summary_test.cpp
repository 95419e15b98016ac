#include "maps/terrain_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace regoplan {
namespace {

TEST(TerrainSummary, CountsWhatTheMapHolds) {
  GridFrame frame;
  frame.columns = 10;
  frame.rows = 10;
  frame.north_m = 20;
  frame.cell_width_m = frame.cell_height_m = 2;
  ElevationRaster elevation{frame, {}};
  ClassRaster classes{frame, {}};
  for (int i = 0; i < 100; ++i) {
    const int column = i % 10;
    elevation.height_m.push_back(static_cast<float>(column));  // rises 1 m in 2 m
    classes.code.push_back(column < 3 ? 1 : column < 5 ? 2 : 3);
  }
  elevation.height_m[0] = std::numeric_limits<float>::quiet_NaN();
  const SoilCatalogue soils{.soils = {{.name = "sand", .source = "", .soil = {}},
                                      {.name = "dust", .source = "", .soil = {}}},
                            .classes = {{1, 0}, {2, 1}},
                            .unmapped = {}};
  const Rock rock{.x_m = 5, .y_m = 5, .radius_m = 2, .height_m = 1};
  const Rock outside{.x_m = -5, .y_m = 5, .radius_m = 2, .height_m = 1};
  const TerrainSummary summary = summarize(TerrainMap(elevation, classes, soils, {rock, outside}));
  EXPECT_EQ(summary.frame, frame);
  EXPECT_DOUBLE_EQ(summary.known_share, 0.99);
  EXPECT_EQ(summary.height_min_m, 0);
  EXPECT_EQ(summary.height_max_m, 9);
  EXPECT_NEAR(summary.slope_p50_rad, std::atan(0.5), 1e-6);
  EXPECT_NEAR(summary.slope_max_rad, std::atan(0.5), 1e-6);
  ASSERT_EQ(summary.soils.size(), 2U);
  EXPECT_EQ(summary.soils[0].name, "sand");
  EXPECT_DOUBLE_EQ(summary.soils[0].share, 0.3);
  EXPECT_DOUBLE_EQ(summary.soils[1].share, 0.2);
  EXPECT_DOUBLE_EQ(summary.no_soil_share, 0.5);
  EXPECT_EQ(summary.rocks, 1U);
  EXPECT_NEAR(summary.rock_share, std::numbers::pi * 4 / 400, 1e-12);
}

TEST(TerrainSummary, SlopeQuantilesAreOrderedByTheirShare) {
  GridFrame frame;
  frame.columns = 103;
  frame.rows = 3;
  frame.north_m = 3;
  frame.cell_width_m = frame.cell_height_m = 1;
  ElevationRaster elevation{frame, {}};
  // Slope of the cell in column c is c: heights c^2 / 2.
  for (int i = 0; i < 309; ++i) {
    elevation.height_m.push_back(static_cast<float>(0.5 * (i % 103) * (i % 103)));
  }
  const TerrainSummary summary = summarize(TerrainMap(
      elevation, std::nullopt,
      {.soils = {{.name = "s", .source = "", .soil = {}}}, .classes = {}, .unmapped = {}}, {}));
  EXPECT_NEAR(std::tan(summary.slope_p50_rad), 51, 0.01);
  EXPECT_NEAR(std::tan(summary.slope_p90_rad), 91, 0.01);
  EXPECT_NEAR(std::tan(summary.slope_p99_rad), 100, 0.01);
  EXPECT_NEAR(std::tan(summary.slope_max_rad), 101, 0.01);
}

}  // namespace
}  // namespace regoplan
