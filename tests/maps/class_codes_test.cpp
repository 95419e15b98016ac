#include "maps/class_codes.h"

#include <gtest/gtest.h>

namespace regoplan {
namespace {

constexpr std::int32_t kNone = ClassRaster::kNoData;

/// Four cells of a metre from west to east with these codes, on ground that reaches a metre
/// farther east.
TerrainMap row_of_classes(const std::vector<std::int32_t>& codes) {
  const auto frame = [](int columns) {
    return GridFrame{.columns = columns,
                     .rows = 1,
                     .west_m = 0,
                     .north_m = 1,
                     .cell_width_m = 1,
                     .cell_height_m = 1};
  };
  return {{.frame = frame(5), .height_m = std::vector<float>(5, 0.0F)},
          ClassRaster{.frame = frame(4), .code = codes},
          {.soils = {{.name = "sand"}}, .classes = {{1, 0}, {2, 0}}, .unmapped = {}},
          {}};
}

TEST(ClassCodes, ThatTheSoilsDoNotListAreCountedCommonestFirst) {
  const std::vector<UnlistedCode> unlisted = unlisted_codes(row_of_classes({1, 5, 7, 7}));
  ASSERT_EQ(unlisted.size(), 2);
  EXPECT_EQ(unlisted[0].code, 7);
  EXPECT_EQ(unlisted[0].cells, 2);
  EXPECT_EQ(unlisted[1].code, 5);
  EXPECT_EQ(unlisted[1].cells, 1);
  EXPECT_TRUE(unlisted_codes(row_of_classes({1, 2, kNone, kNone})).empty());
}

TEST(ClassCodes, APlaceWithoutSoilIsToldByWhatTheRasterHoldsThere) {
  const TerrainMap map = row_of_classes({1, 5, kNone, 5});
  EXPECT_EQ(why_no_soil(map, 1.5, 0.5),
            "the soil classes hold the code 5 there, in 2 of 4 cells, and the soils do not list it "
            "(classes: 1, 2; remedy: add 5: NAME to classes, or unmapped: NAME)");
  EXPECT_TRUE(why_no_soil(map, 2.5, 0.5)
                  .starts_with("the raster of soil classes has no class there (nodata)"));
  EXPECT_TRUE(why_no_soil(map, 4.5, 0.5).starts_with("it lies outside the raster of soil classes"));
  EXPECT_EQ(why_no_soil(map.forbidding({"sand"}), 0.5, 0.5), "class 1 is forbidden");
}

}  // namespace
}  // namespace regoplan
