#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "maps/raster_files.h"
#include "terramech/basics/input_error.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

const GridFrame kBandFrame{.columns = 3,
                           .rows = 2,
                           .west_m = 500010,
                           .north_m = 4649990,
                           .cell_width_m = 0.5,
                           .cell_height_m = 2,
                           .crs_wkt = {}};

TEST(RasterBands, ReadBackInPlaceWithTheirNames) {
  const ScratchFolder folder;
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const std::string file = folder.path("bands.tif");
  write_bands(kBandFrame,
              {{"first", {1, 2, 3, 4, 5, 6}}, {"second", {-1, -2, kUnknown, -4, -5, -6}}}, file);
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
  ASSERT_NE(dataset, nullptr);
  ASSERT_EQ(dataset->GetRasterCount(), 2);
  std::array<double, 6> transform{};
  ASSERT_EQ(dataset->GetGeoTransform(transform.data()), CE_None);
  EXPECT_EQ(transform, (std::array<double, 6>{500010, 0.5, 0, 4649990, 0, -2}));
  GDALRasterBand& second = *dataset->GetRasterBand(2);
  EXPECT_STREQ(second.GetDescription(), "second");
  std::array<float, 6> cells{};
  ASSERT_EQ(second.RasterIO(GF_Read, 0, 0, 3, 2, cells.data(), 3, 2, GDT_Float32, 0, 0, nullptr),
            CE_None);
  EXPECT_EQ(cells[1], -2);
  EXPECT_TRUE(std::isnan(cells[2]));
  EXPECT_EQ(cells[3], -4);
  int has_nodata = 0;
  EXPECT_TRUE(std::isnan(second.GetNoDataValue(&has_nodata)));
  EXPECT_TRUE(has_nodata != 0);
}

TEST(RasterBands, OfTheWrongSizeAreRefused) {
  const ScratchFolder folder;
  EXPECT_THROW(write_bands(kBandFrame, {{"first", {1, 2}}}, folder.path("bands.tif")), InputError);
  EXPECT_THROW(write_bands(kBandFrame, {}, folder.path("bands.tif")), InputError);
}

}  // namespace
}  // namespace regoplan
