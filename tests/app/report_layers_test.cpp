#include "app/page/report_layers.h"

#include <gtest/gtest.h>

#include <limits>

namespace regoplan {
namespace {

TEST(ReportLayers, KeepTheSmallestOfTheCellsThatOneStandsForAndWhatIsUnknown) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  TerrainRasters rasters{
      .frame = {
          .columns = 512, .rows = 2, .cell_width_m = 0.5, .cell_height_m = 0.5, .crs_wkt = {}}};
  rasters.margin.assign(1024, kUnknown);
  rasters.margin[0] = 0.2F;
  rasters.margin[513] = -1;
  rasters.margin[2] = 0.5F;
  rasters.speeds_mps = {1.5};
  rasters.supply_n.assign(1, std::vector<float>(1024, 400));

  const nlohmann::json layers = report_layers(rasters);
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0]["of"], "margin");
  EXPECT_EQ(layers[0]["columns"], 256);
  EXPECT_EQ(layers[0]["rows"], 1);
  EXPECT_EQ(layers[0]["cell_width_m"], 1);
  EXPECT_EQ(layers[0]["min"], -1);
  EXPECT_EQ(layers[0]["max"], 0.5);
  // The bytes 1, 255 and 0: the smallest, the largest, unknown.
  EXPECT_EQ(layers[0]["base64"].get<std::string>().substr(0, 4), "Af8A");
  EXPECT_EQ(layers[1]["of"], "supply");
  EXPECT_EQ(layers[1]["speed_mps"], 1.5);
  EXPECT_EQ(layers[1]["min"], layers[1]["max"]);
}

}  // namespace
}  // namespace regoplan
