#include "maps/terrain_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Far from the origin, as planetary eastings are, with cells that are not square.
const GridFrame kFrame{.columns = 40,
                       .rows = 30,
                       .west_m = 8142406,
                       .north_m = -276455,
                       .cell_width_m = 0.5,
                       .cell_height_m = 0.25};

template <typename Height>
ElevationRaster raster(const GridFrame& frame, Height height) {
  ElevationRaster elevation{frame, {}};
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      elevation.height_m.push_back(static_cast<float>(height(column, row)));
    }
  }
  return elevation;
}

ElevationRaster flat() {
  return raster(kFrame, [](int, int) { return 0; });
}

GridFrame one_cell(double west_m, double north_m, double width_m, double height_m) {
  return {.columns = 1,
          .rows = 1,
          .west_m = west_m,
          .north_m = north_m,
          .cell_width_m = width_m,
          .cell_height_m = height_m};
}

TEST(Extent, IsToldInMillimetresThatLieWithinIt) {
  EXPECT_EQ(extent_text(kFrame), "x 8142406 to 8142426 m, y -276462.5 to -276455 m");
  const double side_m = 765.685424949238;
  EXPECT_EQ(extent_text(one_cell(-282.842712474619, 482.842712474619, side_m, side_m)),
            "x -282.842 to 482.842 m, y -282.842 to 482.842 m");
  // 1000 times .57 is a little less than 570, and -0.0001 no negative zero.
  EXPECT_EQ(extent_text(one_cell(-0.0001, 0.57, 2, 0.5)), "x 0 to 1.999 m, y 0.07 to 0.57 m");
}

SoilCatalogue one_soil() {
  return {.soils = {{.name = "sand", .source = "", .soil = {}}}, .classes = {}, .unmapped = {}};
}

SoilCatalogue two_soils(std::optional<int> unmapped = {}) {
  return {.soils = {{.name = "sand", .source = "", .soil = {}},
                    {.name = "dust", .source = "", .soil = {}}},
          .classes = {{7, 0}, {-3, 1}},
          .unmapped = unmapped};
}

TerrainMap map_of(ElevationRaster elevation) {
  return {std::move(elevation), std::nullopt, one_soil(), {}};
}

double x_of(double column) {
  return kFrame.west_m + column * kFrame.cell_width_m;
}
double y_of(double row) {
  return kFrame.north_m - row * kFrame.cell_height_m;
}

/// What goes wrong, in words.
template <typename Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(TerrainMap, BilinearReproducesAPlaneBetweenTheOutermostCellCentres) {
  const TerrainMap map =
      map_of(raster(kFrame, [](int column, int row) { return 3 + 0.25 * column - 0.5 * row; }));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> column(0.5, kFrame.columns - 0.5);
  std::uniform_real_distribution<double> row(0.5, kFrame.rows - 0.5);
  for (int i = 0; i < 10000; ++i) {
    const double c = column(random);
    const double r = row(random);
    ASSERT_NEAR(map.height_m(x_of(c), y_of(r)), 3 + 0.25 * (c - 0.5) - 0.5 * (r - 0.5), 2e-9);
  }
}

TEST(TerrainMap, TheOuterHalfCellIsLevelAndTheEdgeBelongsToTheMap) {
  const TerrainMap map = map_of(raster(kFrame, [](int column, int row) { return column + row; }));
  EXPECT_EQ(map.height_m(kFrame.west_m, kFrame.north_m), 0);
  EXPECT_EQ(map.height_m(kFrame.east_m(), kFrame.south_m()), 39 + 29);
  EXPECT_TRUE(map.inside(kFrame.east_m(), kFrame.south_m()));
  for (const double outside : {x_of(-0.001), x_of(40.001), double{kUnknown}}) {
    EXPECT_FALSE(map.inside(outside, y_of(1)));
    EXPECT_TRUE(std::isnan(map.height_m(outside, y_of(1))));
  }
}

TEST(TerrainMap, UnknownGroundIsNotFree) {
  const TerrainMap map = map_of(raster(
      kFrame, [](int column, int row) { return column == 10 && row == 5 ? kUnknown : 1.0F; }));
  EXPECT_TRUE(map.inside(x_of(10.5), y_of(5.5)));
  EXPECT_TRUE(std::isnan(map.height_m(x_of(10.5), y_of(5.5))));
  EXPECT_TRUE(std::isnan(map.height_m(x_of(9.6), y_of(4.6)))) << "its cell is a neighbour";
  EXPECT_TRUE(std::isnan(map.height_m(x_of(11.4), y_of(6.4)))) << "its cell is a neighbour";
  EXPECT_EQ(map.height_m(x_of(9.5), y_of(5.5)), 1) << "a cell centre needs its own cell only";
  EXPECT_EQ(map.height_m(x_of(11.6), y_of(5.5)), 1);
  EXPECT_TRUE(std::isnan(map.max_height_m(x_of(3), x_of(10), y_of(8), y_of(3))));
  EXPECT_EQ(map.max_height_m(x_of(3), x_of(9.5), y_of(8), y_of(3)), 1);
}

TEST(TerrainMap, MaxHeightBoundsEveryHeightInTheRectangleAndIsReachedNearIt) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> share(0, 1);
  const TerrainMap map = map_of(raster(kFrame, [&](int, int) { return share(random); }));
  for (int i = 0; i < 300; ++i) {
    const double west = kFrame.columns * share(random);
    const double east = west + (kFrame.columns - west) * share(random);
    const double north = kFrame.rows * share(random);
    const double south = north + (kFrame.rows - north) * share(random);
    const double bound = map.max_height_m(x_of(west), x_of(east), y_of(south), y_of(north));
    for (int k = 0; k < 50; ++k) {
      const double x_m = x_of(std::lerp(west, east, share(random)));
      const double y_m = y_of(std::lerp(south, north, share(random)));
      ASSERT_LE(map.height_m(x_m, y_m), bound);
    }
    double reached = 0;
    for (int row = 0; row < kFrame.rows; ++row) {
      for (int column = 0; column < kFrame.columns; ++column) {
        if (column < west - 1.5 || column > east + 0.5 || row < north - 1.5 || row > south + 0.5) {
          continue;
        }
        reached = std::max(reached, map.height_m(x_of(column + 0.5), y_of(row + 0.5)));
      }
    }
    ASSERT_LE(bound, reached);
  }
  EXPECT_TRUE(std::isnan(map.max_height_m(x_of(-1), x_of(3), y_of(3), y_of(1))));
}

TEST(TerrainMap, ClassesMayLieOnAnotherGridAndWhatTheyDoNotCoverIsUnmapped) {
  // Three by two cells of 4 m x 2 m over part of the elevation and beyond its east edge.
  ClassRaster classes;
  classes.frame.columns = 3;
  classes.frame.rows = 2;
  classes.frame.west_m = kFrame.west_m + 10;
  classes.frame.north_m = kFrame.north_m - 1;
  classes.frame.cell_width_m = 4;
  classes.frame.cell_height_m = 2;
  classes.code = {7, -3, 7, ClassRaster::kNoData, 99, -3};
  const auto at = [&](const TerrainMap& map, double east_m, double south_m) {
    return map.soil_index(kFrame.west_m + east_m, kFrame.north_m - south_m);
  };
  const TerrainMap strict(flat(), classes, two_soils(), {});
  EXPECT_EQ(at(strict, 12, 2), 0);
  EXPECT_EQ(at(strict, 13.99, 2.99), 0);
  EXPECT_EQ(at(strict, 14.01, 2.99), 1);
  EXPECT_EQ(at(strict, 22, 5), 1) << "the edge belongs to the raster";
  EXPECT_EQ(at(strict, 12, 4), std::nullopt) << "nodata";
  EXPECT_EQ(at(strict, 15, 4), std::nullopt) << "a code that the catalogue does not list";
  EXPECT_EQ(at(strict, 9.99, 2), std::nullopt) << "outside the class raster";
  const TerrainMap lenient(flat(), classes, two_soils(1), {});
  EXPECT_EQ(at(lenient, 12, 2), 0);
  for (const auto& [east_m, south_m] : {std::pair{12.0, 4.0}, {15.0, 4.0}, {9.99, 2.0}}) {
    EXPECT_EQ(at(lenient, east_m, south_m), 1);
  }
}

TEST(TerrainMap, WithoutClassesTheOneSoilIsEverywhere) {
  const TerrainMap map = map_of(flat());
  EXPECT_EQ(map.soil_index(x_of(0), y_of(0)), 0);
  EXPECT_EQ(map.soil_index(x_of(20), y_of(20)), 0);
  EXPECT_NE(
      error_of([] { TerrainMap(flat(), std::nullopt, two_soils(), {}); }).find("2 soils without"),
      std::string::npos);
}

TEST(TerrainMap, PartsThatDoNotFitAreRefused) {
  const auto refusal = [](ElevationRaster elevation, std::optional<ClassRaster> classes,
                          const SoilCatalogue& soils, std::vector<Rock> rocks) {
    return error_of(
        [&] { TerrainMap(std::move(elevation), std::move(classes), soils, std::move(rocks)); });
  };
  const ClassRaster classes{kFrame, std::vector<std::int32_t>(flat().height_m.size(), 7)};
  EXPECT_EQ(refusal(flat(), classes, two_soils(), {}), "no error");

  ElevationRaster unknown = raster(kFrame, [](int, int) { return kUnknown; });
  EXPECT_NE(refusal(unknown, std::nullopt, one_soil(), {}).find("no cell is known"),
            std::string::npos);
  ElevationRaster short_of_cells = flat();
  short_of_cells.height_m.pop_back();
  EXPECT_NE(refusal(short_of_cells, std::nullopt, one_soil(), {}).find("1199 cells"),
            std::string::npos);
  EXPECT_NE(refusal(flat(), std::nullopt, {}, {}).find("no soil"), std::string::npos);

  ClassRaster elsewhere = classes;
  elsewhere.frame.west_m += 1000;
  EXPECT_NE(refusal(flat(), elsewhere, two_soils(), {}).find("do not overlap"), std::string::npos);
  ClassRaster touching = classes;
  touching.frame.west_m = kFrame.east_m();
  EXPECT_NE(refusal(flat(), touching, two_soils(), {}).find("do not overlap"), std::string::npos);
  const ClassRaster foreign{kFrame, std::vector<std::int32_t>(flat().height_m.size(), 5)};
  EXPECT_NE(refusal(flat(), foreign, two_soils(), {}).find("codes [5]"), std::string::npos);
  SoilCatalogue twice = two_soils();
  twice.classes.push_back({7, 1});
  EXPECT_NE(refusal(flat(), classes, twice, {}).find("code 7 is given twice"), std::string::npos);

  const Rock rock{.x_m = x_of(1), .y_m = y_of(1), .radius_m = 1, .height_m = 1};
  Rock endless = rock;
  endless.radius_m = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(flat(), std::nullopt, one_soil(), {rock, endless}).find("rock 2"),
            std::string::npos);
  Rock afar = rock;
  afar.x_m = 0;
  EXPECT_NE(refusal(flat(), std::nullopt, one_soil(), {afar}).find("none of 1"), std::string::npos);
}

TEST(TerrainMap, OtherSoilsOfTheSameNamesShareTheTerrain) {
  const TerrainMap map(flat(),
                       ClassRaster{kFrame, std::vector<std::int32_t>(flat().height_m.size(), -3)},
                       two_soils(), {});
  std::vector<MapSoil> drawn = map.soils();
  drawn[1].soil.mean.cohesion_pa = 123;
  const TerrainMap other = map.with_soils(drawn);
  EXPECT_EQ(other.soils()[1].soil.mean.cohesion_pa, 123);
  EXPECT_EQ(other.soil_index(x_of(5), y_of(5)), 1);
  EXPECT_EQ(&other.elevation(), &map.elevation());
  std::swap(drawn[0], drawn[1]);
  EXPECT_THROW(map.with_soils(drawn), InputError);
}

TEST(TerrainMap, GroundOfASoilCanBeForbiddenWithinTheRasterAndBeyondIt) {
  std::vector<std::int32_t> codes(flat().height_m.size(), -3);
  codes.front() = 77;  // on no list: unmapped, the first soil
  const TerrainMap map(flat(), ClassRaster{kFrame, codes}, two_soils(0), {});
  const double west_m = x_of(0), north_m = y_of(0);
  ASSERT_EQ(map.soil_index(west_m, north_m), 0);
  ASSERT_EQ(map.soil_index(x_of(5), y_of(5)), 1);
  const TerrainMap without_second = map.forbidding({map.soils()[1].name});
  EXPECT_EQ(without_second.soil_index(west_m, north_m), 0);
  EXPECT_EQ(without_second.soil_index(x_of(5), y_of(5)), std::nullopt);
  const TerrainMap without_first = map.forbidding({map.soils()[0].name});
  EXPECT_EQ(without_first.soil_index(west_m, north_m), std::nullopt);
  EXPECT_EQ(without_first.soil_index(x_of(5), y_of(5)), 1);
  EXPECT_EQ(map.soil_index(x_of(5), y_of(5)), 1) << "the map itself stays";
}

}  // namespace
}  // namespace regoplan
