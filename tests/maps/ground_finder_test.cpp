#include "maps/ground_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

const GridFrame kFrame{.columns = 80,
                       .rows = 80,
                       .west_m = -20,
                       .north_m = 20,
                       .cell_width_m = 0.5,
                       .cell_height_m = 0.5};

/// Heights by a function of the cell's centre; soil 0 west of x = 0, soil 1 east of it.
template <typename Height>
TerrainMap map_with(Height height) {
  ElevationRaster elevation;
  elevation.frame = kFrame;
  ClassRaster classes;
  classes.frame = kFrame;
  for (int row = 0; row < kFrame.rows; ++row) {
    for (int column = 0; column < kFrame.columns; ++column) {
      const double x = kFrame.west_m + (column + 0.5) * kFrame.cell_width_m;
      const double y = kFrame.north_m - (row + 0.5) * kFrame.cell_height_m;
      elevation.height_m.push_back(static_cast<float>(height(x, y)));
      classes.code.push_back(x < 0 ? 10 : 20);
    }
  }
  return {std::move(elevation),
          std::move(classes),
          {.soils = {{.name = "west", .source = "", .soil = {}},
                     {.name = "east", .source = "", .soil = {}}},
           .classes = {{10, 0}, {20, 1}},
           .unmapped = {}},
          {}};
}

/// Slopes that floats hold exactly.
double sloping(double x, double y) {
  return 3 + 0.25 * x - 0.125 * y;
}

TEST(GroundFinder, TellsTheCurvatureAlongTheHeading) {
  // A trough along y: hollow for who crosses it, straight for who follows it.
  const TerrainMap map = map_with([](double x, double) { return 0.02 * x * x; });
  const Vehicle vehicle = preset_vehicle("lrv");
  const GroundFinder finder(map, vehicle);
  EXPECT_NEAR(finder.at(0, 0, 0).curvature_1pm, 0.04, 0.002);
  EXPECT_NEAR(finder.at(0, 0, 180 * kDegree).curvature_1pm, 0.04, 0.002);
  EXPECT_NEAR(finder.at(0, 0, 90 * kDegree).curvature_1pm, 0, 1e-5);
  const TerrainMap slope = map_with(sloping);
  EXPECT_NEAR(GroundFinder(slope, vehicle).at(1, 2, 0.4).curvature_1pm, 0, 1e-5);
}

TEST(GroundFinder, ReproducesAPlaneAtEveryHeading) {
  const TerrainMap map = map_with(sloping);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(-15, 15), heading(-4, 4);
  for (const std::string& name : preset_vehicle_names()) {
    const Vehicle vehicle = preset_vehicle(name);
    const GroundFinder finder(map, vehicle);
    for (int i = 0; i < 50; ++i) {
      const double x = place(random), y = place(random), yaw = heading(random);
      const GroundPatch patch = finder.at(x, y, yaw);
      const GroundPatch plane = Plane{0.25, -0.125}(x, y, yaw);
      ASSERT_TRUE(patch.known);
      EXPECT_NEAR(patch.z_m, plane.z_m + 3, 1e-9) << name;
      EXPECT_NEAR(patch.slope_forward, plane.slope_forward, 1e-9) << name;
      EXPECT_NEAR(patch.slope_left, plane.slope_left, 1e-9) << name;
      EXPECT_NEAR(patch.tilt_rad(), std::atan(std::hypot(0.25, 0.125)), 1e-9);
    }
  }
}

TEST(GroundFinder, FitsWhatIsNoPlaneBetweenItsWheels) {
  // A step under the front wheels tilts the plane by its height over the wheelbase.
  const TerrainMap map = map_with([](double x, double) { return x < 0 ? 0 : 0.2; });
  const Vehicle lrv = preset_vehicle("lrv");
  const GroundPatch patch = GroundFinder(map, lrv).at(0, 0, 0);
  EXPECT_NEAR(patch.slope_forward, 0.2 / (2 * 1.143), 1e-6);
  EXPECT_NEAR(patch.slope_left, 0, 1e-9);
  EXPECT_NEAR(patch.z_m, 0.1, 1e-6);
}

TEST(GroundFinder, TellsTheSoilUnderEachWheel) {
  const TerrainMap map = map_with(sloping);
  const Vehicle lrv = preset_vehicle("lrv");
  const GroundFinder finder(map, lrv);
  const auto soils = [&](double yaw_rad) {
    const GroundPatch patch = finder.at(0, 0, yaw_rad);
    return std::array<int, 4>{patch.soil[0], patch.soil[1], patch.soil[2], patch.soil[3]};
  };
  // Front left, front right, rear left, rear right.
  EXPECT_EQ(soils(0), (std::array{1, 1, 0, 0}));
  EXPECT_EQ(soils(180 * kDegree), (std::array{0, 0, 1, 1}));
  EXPECT_EQ(soils(90 * kDegree), (std::array{0, 1, 0, 1}));
  EXPECT_EQ(soils(-90 * kDegree), (std::array{1, 0, 1, 0}));
}

TEST(GroundFinder, IsUnknownWhereAnyWheelStandsOnUnknownGround) {
  const Vehicle lrv = preset_vehicle("lrv");
  for (const WheelMount& wheel : lrv.wheels) {
    // Unknown within a metre around this wheel alone.
    const TerrainMap map = map_with([&](double x, double y) {
      const bool near_it = std::abs(x - wheel.x_m) < 0.6 && std::abs(y - wheel.y_m) < 0.6;
      return near_it ? std::numeric_limits<double>::quiet_NaN() : 0.0;
    });
    EXPECT_FALSE(GroundFinder(map, lrv).at(0, 0, 0).known) << wheel.name;
  }
}

TEST(GroundFinder, IsUnknownWhereAWheelStandsOffTheMap) {
  const TerrainMap map = map_with(sloping);
  const Vehicle lrv = preset_vehicle("lrv");
  const GroundFinder finder(map, lrv);
  EXPECT_TRUE(finder.at(20 - 1.15, 0, 0).known);
  EXPECT_FALSE(finder.at(20 - 1.13, 0, 0).known);
  EXPECT_TRUE(finder.at(20 - 1.13, 0, 90 * kDegree).known);
}

TEST(GroundFinder, IsUnknownWhereAWheelStandsOnForbiddenSoil) {
  ElevationRaster elevation;
  elevation.frame = kFrame;
  elevation.height_m.assign(6400, 0.0F);
  ClassRaster classes;
  classes.frame = kFrame;
  for (int i = 0; i < 6400; ++i) classes.code.push_back(i % 80 < 40 ? 1 : 99);  // 99 east of x = 0
  const TerrainMap map(
      std::move(elevation), std::move(classes),
      {.soils = {{.name = "west", .source = "", .soil = {}}}, .classes = {{1, 0}}, .unmapped = {}},
      {});
  const Vehicle lrv = preset_vehicle("lrv");
  const GroundFinder finder(map, lrv);
  EXPECT_FALSE(finder.at(-1.13, 0, 0).known);
  EXPECT_TRUE(finder.at(-1.15, 0, 0).known);
}

}  // namespace
}  // namespace regoplan
