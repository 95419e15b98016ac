#include "maps/grid_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maps/raster_files.h"
#include "terramech/basics/input_error.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

class GridTable : public testing::Test {
 protected:
  ElevationRaster read(const std::string& text, const HeightReading& reading = {}) const {
    return read_elevation(folder_.write("grid.csv", text), reading);
  }
  /// Behind the file's name.
  std::string error_of(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& bad) {
      const std::string what = bad.what();
      return what.substr(what.find("grid.csv") + 8);
    }
    return "";
  }

  ScratchFolder folder_;
};

constexpr const char* kSix = "x,y,z\n10,5,1\n10.5,5,2\n11,5,3\n10,5.5,4\n10.5,5.5,5\n11,5.5,6\n";

TEST_F(GridTable, PointsAreTheCentresOfCellsFromTheNorth) {
  const ElevationRaster raster = read(kSix);
  EXPECT_EQ(raster.frame, (GridFrame{.columns = 3,
                                     .rows = 2,
                                     .west_m = 9.75,
                                     .north_m = 5.75,
                                     .cell_width_m = 0.5,
                                     .cell_height_m = 0.5}));
  EXPECT_EQ(raster.height_m, (std::vector<float>{4, 5, 6, 1, 2, 3}));
}

TEST_F(GridTable, TheOrderOfRowsAndColumnsAndTheSeparatorDoNotMatter) {
  const std::vector<float> cells = read(kSix).height_m;
  EXPECT_EQ(read("Elevation; Northing;Easting;note\r\n3;5;11;a\r\n6;5.5;11;b\r\n1;5;10;\r\n"
                 "4;5.5;10;c\r\n5;5.5;10.5;d\r\n2;5;10.5;e\r\n")
                .height_m,
            cells);
  EXPECT_EQ(read("10 5 1\n10.5  5 2\n11 5 3\n10 5.5 4\n10.5 5.5 5\n11 5.5 6\n").height_m, cells);
}

TEST_F(GridTable, APointThatIsMissingOrHasNoHeightIsUnknown) {
  const ElevationRaster raster = read("x,y,z\n10,5,1\n10.5,5,nan\n11,5,3\n10,5.5,\n11,5.5,6\n");
  ASSERT_EQ(raster.height_m.size(), 6U);
  EXPECT_TRUE(std::isnan(raster.height_m[0]));
  EXPECT_TRUE(std::isnan(raster.height_m[1]));
  EXPECT_EQ(raster.height_m[2], 6);
  EXPECT_TRUE(std::isnan(raster.height_m[4]));
}

TEST_F(GridTable, RoundedCoordinatesAreStillAGrid) {
  std::string text = "x_m,y_m,height_m\n";
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 60; ++column) {
      char line[64];
      std::snprintf(line, sizeof line, "%.2f,%.2f,%d\n", 500000 + column / 3.0, 4e6 + row / 3.0,
                    column);
      text += line;
    }
  }
  const ElevationRaster raster = read(text);
  EXPECT_EQ(raster.frame.columns, 60);
  EXPECT_EQ(raster.frame.rows, 30);
  EXPECT_NEAR(raster.frame.cell_width_m, 1 / 3.0, 1e-3);
  EXPECT_EQ(raster.height_m[59], 59);
}

TEST_F(GridTable, WhatIsSaidOfTheHeightsCounts) {
  const ElevationRaster raster = read(kSix, {.scale = 0.5, .offset_m = 10, .nodata = 6});
  EXPECT_EQ(raster.height_m[0], 12);
  EXPECT_TRUE(std::isnan(raster.height_m[2]));
}

TEST_F(GridTable, WhatIsNoGridIsAnErrorWithItsLine) {
  EXPECT_EQ(error_of("x,y,z\n0,0,1\n1,0,high\n0,1,1\n1,1,1\n"),
            ":3: height: high is not valid (allowed: metres, -1e6 to 1e6, nan or an empty cell "
            "where it is not known)");
  EXPECT_EQ(error_of("x,y,z\n0,0,1\none,0,1\n"),
            ":3: x: one is not valid (allowed: metres, -1e9 to 1e9)");
  EXPECT_EQ(error_of("x,y,z\n0,0,1\n1,0,1\n0,1,1\n1,0,2\n"), ":5: the point (1, 0) is given twice");
  EXPECT_EQ(error_of("x,y,z\n0,0,1\n1,0\n"), ":3: 2 cells (x, y and height need more)");
  EXPECT_EQ(error_of("x,y\n0,0\n").substr(0, 3), ":1:");
  EXPECT_EQ(error_of("x,y,z\n0,0,1\n0,1,1\n"),
            ": all points have x = 0 (a grid needs two or more)");
  EXPECT_NE(error_of("x,y,z\n0,0,1\n1,0,1\n2.4,0,1\n3,0,1\n4,0,1\n5,0,1\n0,1,1\n1,1,1\n")
                .find(":4: x: 2.4 does not lie on a grid of 1 m from 0 on"),
            std::string::npos);
  EXPECT_NE(error_of("x,y,z\n0,0,-9999\n1,0,1\n0,1,2\n1,1,3\n")
                .find("remedy: regoplan map import --nodata -9999"),
            std::string::npos);
}

}  // namespace
}  // namespace regoplan
