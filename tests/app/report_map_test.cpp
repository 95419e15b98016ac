#include "app/page/report_map.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace regoplan {
namespace {

using Json = nlohmann::json;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Little-endian 16-bit numbers out of base64.
std::vector<int> numbers_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned> bytes;
  for (std::size_t i = 0; i < base64.size(); i += 4) {
    unsigned group = 0;
    std::size_t given = 3;
    for (std::size_t k = 0; k < 4; ++k) {
      if (base64[i + k] == '=') {
        group <<= 6;
        --given;
      } else {
        group = group << 6 | static_cast<unsigned>(digits.find(base64[i + k]));
      }
    }
    for (std::size_t k = 0; k < given; ++k) bytes.push_back(group >> (16 - 8 * k) & 255);
  }
  std::vector<int> numbers;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    numbers.push_back(static_cast<int>(bytes[i] | bytes[i + 1] << 8));
  return numbers;
}

MapSoil sand(std::string name) {
  return {.name = std::move(name),
          .source = "a test",
          .soil = {.mean = {.cohesion_pa = 800,
                            .friction_angle_rad = 0.6,
                            .kc = 1000,
                            .kphi = 8e5,
                            .density_kgpm3 = 1600,
                            .kx0_m = 0.03,
                            .ky0_m = 0.01},
                   .standard_deviation = {.cohesion_pa = 80, .n = 0, .a0 = 0, .a1 = 0}}};
}

TerrainMap map_of(int columns, int rows, std::vector<float> height_m,
                  std::optional<ClassRaster> classes = std::nullopt, std::vector<Rock> rocks = {}) {
  SoilCatalogue soils{.soils = {sand("sand")}, .classes = {}, .unmapped = 0};
  if (classes)
    soils = {.soils = {sand("firm"), sand("loose")},
             .classes = {{5, 0}, {7, 1}},
             .unmapped = std::nullopt};
  return {{.frame = {.columns = columns,
                     .rows = rows,
                     .west_m = 100,
                     .north_m = 50,
                     .cell_width_m = 2,
                     .cell_height_m = 2,
                     .crs_wkt = "PROJCRS[\"Moon south\",X]"},
           .height_m = std::move(height_m)},
          std::move(classes),
          std::move(soils),
          std::move(rocks)};
}

TEST(ReportMap, QuantisesHeightsFromLowestToHighestAndMarksTheUnknown) {
  const Json data = report_map(map_of(2, 2, {-1, 3, kUnknown, 1}));
  const Json& elevation = data["raster"]["elevation"];
  EXPECT_EQ(elevation["min_m"], -1);
  EXPECT_EQ(elevation["max_m"], 3);
  EXPECT_EQ(numbers_of(elevation["base64"]), (std::vector<int>{1, 65535, 0, 32768}));
  EXPECT_EQ(data["crs"], "Moon south");
  EXPECT_EQ(data["east_m"], 104);
}

TEST(ReportMap, DrawsLevelGround) {
  const Json elevation = report_map(map_of(3, 1, {2, 2, 2}))["raster"]["elevation"];
  EXPECT_EQ(numbers_of(elevation["base64"]), (std::vector<int>{1, 1, 1}));
}

TEST(ReportMap, AveragesWhatIsKnownAndLeavesHalfUnknownBlocksUnknown) {
  std::vector<float> height_m(2048, 4);
  height_m[0] = 0;                       // block 0: (0 + 4 + 4 + 4)/4 = 3
  height_m[2] = kUnknown;                // block 1: one unknown of four
  height_m[4] = height_m[5] = kUnknown;  // block 2: half unknown
  const Json raster = report_map(map_of(1024, 2, height_m))["raster"];
  EXPECT_EQ(raster["columns"], 512);
  EXPECT_EQ(raster["rows"], 1);
  EXPECT_EQ(raster["cell_width_m"], 4);
  const std::vector<int> steps = numbers_of(raster["elevation"]["base64"]);
  EXPECT_EQ(raster["elevation"]["min_m"], 3);
  EXPECT_EQ(steps[0], 1);
  EXPECT_EQ(steps[1], 65535);
  EXPECT_EQ(steps[2], 0);
}

TEST(ReportMap, CoversAMapThatBlocksDoNotDivide) {
  const Json data = report_map(map_of(1025, 1, std::vector<float>(1025, 1)));
  EXPECT_EQ(data["raster"]["columns"], 342);  // of 3 cells; the last stands for 2
  EXPECT_EQ(data["raster"]["cells_averaged"], 3);
  EXPECT_EQ(data["east_m"], 100 + 2 * 1025);
}

TEST(ReportMap, NumbersSoilsFromOneAndForbiddenGroundZero) {
  ClassRaster classes;
  classes.frame.columns = 3;
  classes.frame.rows = 1;
  classes.frame.west_m = 100;
  classes.frame.north_m = 50;
  classes.frame.cell_width_m = classes.frame.cell_height_m = 2;
  classes.code = {7, 5, ClassRaster::kNoData};
  const Json data = report_map(map_of(3, 1, {0, 1, 2}, classes));
  EXPECT_EQ(data["raster"]["soil_runs"], (std::vector<int>{2, 1, 1, 1, 0, 1}));
  EXPECT_EQ(data["soils"][1]["name"], "loose");
  EXPECT_EQ(data["unmapped"], "forbidden");
}

TEST(ReportMap, TellsGroundThatGoesOnOverRowsOnce) {
  const Json data = report_map(map_of(300, 200, std::vector<float>(60000, 1)));
  EXPECT_EQ(data["raster"]["soil_runs"], (std::vector<int>{1, 60000}));
}

TEST(ReportMap, GivesSoilNumbersInTheUnitsOfFiles) {
  const Json data = report_map(map_of(2, 1, {0, 1}));
  for (const Json& parameter : data["soils"][0]["parameters"]) {
    if (parameter["name"] == "friction_angle_deg") {
      EXPECT_NEAR(parameter["mean"], 34.377, 1e-3);
      return;
    }
  }
  FAIL() << "no friction_angle_deg";
}

TEST(ReportMap, OfTooManyRocksKeepsTheLargestAndSaysHowManyThereAre) {
  std::vector<Rock> rocks(25000, {.x_m = 101, .y_m = 49, .radius_m = 0.1, .height_m = 0.1});
  rocks.back().radius_m = 0.9;
  const Json data = report_map(map_of(2, 1, {0, 1}, std::nullopt, rocks));
  EXPECT_EQ(data["rocks_total"], 25000);
  EXPECT_EQ(data["rocks"].size(), 20000u);
  EXPECT_EQ(data["rocks"][0][2], 0.9);
}

}  // namespace
}  // namespace regoplan
