#include "maps/raster_files.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>

#include "maps/terrain_summary.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "tests/measured_data.h"
#include "tests/scratch_folder.h"
#include "written_tiff.h"

namespace regoplan {
namespace {

const std::string kMars = "+proj=eqc +R=3396190 +units=m";

TEST(RasterFiles, WhatIsWrittenReadsBackExactly) {
  const ScratchFolder folder;
  ElevationRaster elevation{{.columns = 3,
                             .rows = 2,
                             .west_m = 8142406.25,
                             .north_m = -276455.5,
                             .cell_width_m = 0.5,
                             .cell_height_m = 0.25,
                             .crs_wkt = wkt(kMars)},
                            {1.1F, -2.5F, 3e-7F, 0, std::nanf(""), 12345.678F}};
  write_elevation(elevation, folder.path("dem.tif"));
  const ElevationRaster heights = read_elevation(folder.path("dem.tif"));
  for (std::size_t i = 0; i < heights.height_m.size(); ++i) {
    if (i == 4) continue;
    EXPECT_EQ(heights.height_m[i], elevation.height_m[i]);
  }
  EXPECT_TRUE(std::isnan(heights.height_m.at(4)));
  EXPECT_FALSE(heights.frame.crs_wkt.empty());
  GridFrame frame = heights.frame;
  frame.crs_wkt = elevation.frame.crs_wkt;
  EXPECT_EQ(frame, elevation.frame);

  ClassRaster classes{elevation.frame, {1, -2, INT32_MAX, 0, ClassRaster::kNoData, 255}};
  classes.frame.crs_wkt.clear();
  write_classes(classes, folder.path("classes.tif"));
  const ClassRaster codes = read_classes(folder.path("classes.tif"));
  EXPECT_EQ(codes.code, classes.code);
  EXPECT_EQ(codes.frame, classes.frame);
  EXPECT_EQ(folder.count(), 2) << "no side files, no unfinished files";
}

TEST(RasterFiles, WritingFailsWholeWithOneLine) {
  const ScratchFolder folder;
  const ElevationRaster elevation{
      {.columns = 1, .rows = 1, .west_m = 0, .north_m = 0, .cell_width_m = 1, .cell_height_m = 1},
      {1}};
  EXPECT_TRUE(refuses([&] { write_elevation(elevation, folder.path("no/dem.tif")); },
                      {"no/dem.tif", "does not exist"}));
  std::filesystem::create_directory(folder.path("dem.tif"));
  EXPECT_TRUE(refuses([&] { write_elevation(elevation, folder.path("dem.tif")); }, {"dem.tif"}));
  EXPECT_EQ(folder.count(), 1);
}

TEST(RasterFiles, NodataOfEveryNumberTypeIsUnknown) {
  const ScratchFolder folder;
  struct Case {
    GDALDataType type;
    double nodata;
  };
  for (const auto& [type, nodata] : {Case{GDT_Byte, 0},
                                     {GDT_Int16, -32768},
                                     {GDT_UInt16, 65535},
                                     {GDT_Int32, -99999},
                                     {GDT_Float32, -3.4028234663852886e38},
                                     {GDT_Float64, -1.7976931348623157e308},
                                     {GDT_Float32, std::nan("")}}) {
    const std::string file =
        write(folder, {.type = type, .cells = {1, nodata, 3, 4}, .nodata = nodata});
    const std::vector<float> heights = read_elevation(file).height_m;
    EXPECT_EQ(heights[0], 1);
    EXPECT_TRUE(std::isnan(heights[1])) << GDALGetDataTypeName(type);
    EXPECT_EQ(heights[3], 4);
    EXPECT_EQ(read_classes(file).code, (std::vector<std::int32_t>{1, ClassRaster::kNoData, 3, 4}));
  }
}

TEST(RasterFiles, NanCellsAreUnknownWithoutANodataValue) {
  const ScratchFolder folder;
  const std::string file = write(folder, {.cells = {1, std::nan(""), 3, 4}});
  EXPECT_TRUE(std::isnan(read_elevation(file).height_m[1]));
  EXPECT_EQ(read_classes(file).code[1], ClassRaster::kNoData);
  EXPECT_TRUE(refuses(
      [&] {
        const double nan = std::nan("");
        read_elevation(write(folder, {.cells = {nan, nan, nan, nan}}));
      },
      {"in.tif", "no cell is known"}));
}

TEST(RasterFiles, UndeclaredNodataIsRefusedWithTheRemedy) {
  const ScratchFolder folder;
  EXPECT_TRUE(refuses(
      [&] {
        read_elevation(write(folder, {.cells = {1, 2, -3.4e38, 4}}));
      },
      {"column 0, row 1", "gdal_translate -a_nodata"}));
  EXPECT_TRUE(refuses(
      [&] {
        read_elevation(write(folder, {.cells = {1, 2, INFINITY, 4}}));
      },
      {"height inf m"}));
}

TEST(RasterFiles, ScaleAndOffsetOfTheBandCount) {
  const ScratchFolder folder;
  const std::string file =
      write(folder,
            {.type = GDT_Int16, .cells = {0, 10, -5, 99}, .nodata = 99, .scale = 0.1, .offset = 7});
  const std::vector<float> heights = read_elevation(file).height_m;
  EXPECT_FLOAT_EQ(heights[0], 7);
  EXPECT_FLOAT_EQ(heights[1], 8);
  EXPECT_FLOAT_EQ(heights[2], 6.5);
  EXPECT_TRUE(std::isnan(heights[3]));
}

TEST(RasterFiles, ClassCodesAreIntegersWhateverTypeHoldsThem) {
  const ScratchFolder folder;
  const std::vector<std::int32_t> codes{1, 2, 3, 4};
  for (const GDALDataType type : {GDT_Byte, GDT_Int16, GDT_UInt32, GDT_Float32, GDT_Float64}) {
    EXPECT_EQ(read_classes(write(folder, {.type = type})).code, codes);
  }
  EXPECT_TRUE(refuses(
      [&] {
        read_classes(write(folder, {.cells = {1, 2.5, 3, 4}}));
      },
      {"class code 2.5", "column 1, row 0"}));
  EXPECT_TRUE(refuses(
      [&] {
        read_classes(write(folder, {.type = GDT_UInt32, .cells = {1, 2, 3, 4e9}}));
      },
      {"class code 4000000000"}));
}

TEST(RasterFiles, AMarkOfUnknownCellsThatIsNotDeclaredIsRefusedWithTheRemedy) {
  const ScratchFolder folder;
  for (const double mark : {-9999., -32768., 9999.}) {
    const std::string file = write(folder, {.cells = {1, mark, 3, 4}});
    EXPECT_TRUE(refuses([&] { read_elevation(file); },
                        {fmt::format("{} stands in 1 cells (the first: column 1, row 0)", mark),
                         fmt::format("--nodata {}", mark), "gdal_translate -a_nodata"}));
    EXPECT_TRUE(std::isnan(read_elevation(file, {.nodata = mark}).height_m[1]));
  }
  // Ground may be as low as a mark.
  EXPECT_EQ(read_elevation(write(folder, {.cells = {-9999, -9998, -9997, -9950}})).height_m[0],
            -9999);
}

TEST(RasterFiles, APictureIsNotInMetresUnlessSomebodySaysSo) {
  const ScratchFolder folder;
  GDALAllRegister();
  const std::string file = folder.path("heights.png");
  {
    const GDALDatasetUniquePtr tiff(GDALDataset::Open(
        write(folder, {.type = GDT_UInt16, .cells = {0, 1000, 2000, 3000}}).c_str()));
    const char* options[] = {"WORLDFILE=YES", nullptr};
    GDALDatasetUniquePtr png(GetGDALDriverManager()->GetDriverByName("PNG")->CreateCopy(
        file.c_str(), tiff.get(), FALSE, const_cast<char**>(options), nullptr, nullptr));
  }
  EXPECT_TRUE(refuses([&] { read_elevation(file); },
                      {"heights.png", "16 bits", "regoplan map import --scale"}));
  const ElevationRaster raster = read_elevation(file, {.scale = 0.01, .offset_m = -5});
  EXPECT_FLOAT_EQ(raster.height_m[1], 5);
  EXPECT_EQ(raster.frame.west_m, 100);
}

TEST(RasterFiles, RotatedAndSouthUpRastersAreRefusedWithTheRemedy) {
  const ScratchFolder folder;
  for (const auto& transform :
       {std::array<double, 6>{100, 1, 0.1, 200, 0.1, -1},
        std::array<double, 6>{100, 0, 1, 200, 1, 0}, std::array<double, 6>{100, 1, 0, 200, 0, 1},
        std::array<double, 6>{100, -1, 0, 200, 0, -1}}) {
    EXPECT_TRUE(refuses([&] { read_elevation(write(folder, {.transform = transform})); },
                        {"in.tif", "remedy: gdalwarp"}));
  }
}

TEST(RasterFiles, ARasterThatLiesNowhereOnAPlaneIsRefused) {
  const ScratchFolder folder;
  for (const double west_m : {std::nan(""), HUGE_VAL}) {
    const std::string file = write(folder, {.transform = {west_m, 0.5, 0, 5060, 0, -0.5}});
    EXPECT_TRUE(refuses([&] { read_elevation(file); }, {"in.tif", "geotransform is not finite"}));
  }
  const std::string geocentric = write(folder, {.crs = "EPSG:4978"});
  EXPECT_TRUE(refuses([&] { read_elevation(geocentric); }, {"in.tif", "geocentric", "planar"}));
}

TEST(RasterFiles, WhatIsNoRasterIsRefusedByName) {
  const ScratchFolder folder;
  EXPECT_TRUE(
      refuses([&] { read_elevation(folder.path("gone.tif")); }, {"gone.tif", "no such file"}));
  EXPECT_TRUE(refuses([&] { read_elevation(folder.write("text.tif", "hello\n")); },
                      {"text.tif", "is not a raster"}));
  EXPECT_TRUE(
      refuses([&] { read_elevation(write(folder, {.type = GDT_CFloat32})); }, {"complex numbers"}));
  const std::string whole = write(folder, {}, "whole.asc");
  std::ifstream stream(whole, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_TRUE(
      refuses([&] { read_elevation(folder.write("cut.tif", bytes.substr(0, bytes.size() / 3))); },
              {"cut.tif"}));
}

TEST(RasterFiles, AsciiGridsReadLikeAnyOther) {
  const ScratchFolder folder;
  const std::string file = folder.write("grid.asc",
                                        "ncols 3\nnrows 2\nxllcorner -1.5\nyllcorner 10\n"
                                        "cellsize 0.5\nNODATA_value 0\n1 2 3\n0 5 6\n");
  const ClassRaster classes = read_classes(file);
  EXPECT_EQ(classes.code, (std::vector<std::int32_t>{1, 2, 3, ClassRaster::kNoData, 5, 6}));
  EXPECT_EQ(classes.frame, (GridFrame{.columns = 3,
                                      .rows = 2,
                                      .west_m = -1.5,
                                      .north_m = 11,
                                      .cell_width_m = 0.5,
                                      .cell_height_m = 0.5}));
  EXPECT_EQ(folder.count(), 1) << "reading leaves nothing beside the file";
}

TEST(RasterFiles, AClassRasterWithoutCrsTakesTheElevationsAndOneWithAnotherIsRefused) {
  const ScratchFolder folder;
  const GridFrame mars = read_elevation(write(folder, {.crs = kMars})).frame;
  ClassRaster classes = read_classes(write(folder, {}));
  EXPECT_NE(adopt_crs(classes, mars, "c.tif").find("c.tif: names no CRS"), std::string::npos);
  EXPECT_EQ(classes.frame.crs_wkt, mars.crs_wkt);
  EXPECT_EQ(adopt_crs(classes, mars, "c.tif"), "") << "nothing to say about the same CRS";

  ClassRaster spelt_otherwise = read_classes(
      write(folder, {.crs = "+proj=eqc +a=3396190 +b=3396190 +lat_ts=0 +lon_0=0 +units=m"}));
  EXPECT_EQ(adopt_crs(spelt_otherwise, mars, "c.tif"), "");

  ClassRaster moon = read_classes(write(folder, {.crs = "+proj=eqc +R=1737400 +units=m"}));
  EXPECT_TRUE(refuses([&] { adopt_crs(moon, mars, "c.tif"); }, {"c.tif", "CRS", "gdalwarp"}));

  ClassRaster local = read_classes(write(folder, {.crs = kMars}));
  const GridFrame nameless = read_elevation(write(folder, {})).frame;
  EXPECT_NE(adopt_crs(local, nameless, "c.tif").find("the elevation names no CRS"),
            std::string::npos);

  ClassRaster elsewhere = read_classes(write(folder, {.transform = {900, 1, 0, 200, 0, -1}}));
  EXPECT_TRUE(refuses([&] { adopt_crs(elsewhere, mars, "c.tif"); }, {"c.tif", "lies elsewhere"}));
}

TEST(RasterFiles, TheMarsMapReadsWithTheFactsThatItsOwnersState) {
  const std::string folder = measured_data() / "mars_gale_marias_pass/";
  if (const auto absence = absence_of(folder)) GTEST_SKIP() << *absence;
  ElevationRaster elevation = read_elevation(folder + "missionDEM.tif");
  EXPECT_EQ(elevation.frame.columns, 348);
  EXPECT_EQ(elevation.frame.rows, 337);
  EXPECT_EQ(elevation.frame.west_m, 8142406);
  EXPECT_EQ(elevation.frame.north_m, -276455);
  ClassRaster classes = read_classes(folder + "terrain_class.asc");
  const std::string notice = adopt_crs(classes, elevation.frame, "terrain_class.asc");
  EXPECT_NE(notice.find("terrain_class.asc: names no CRS"), std::string::npos);

  SoilCatalogue soils{
      .soils = {{.name = "any", .source = "", .soil = {}}}, .classes = {}, .unmapped = {}};
  for (std::int32_t code = 1; code <= 30; ++code) soils.classes.emplace_back(code, 0);
  const TerrainSummary summary = summarize(TerrainMap(elevation, classes, soils, {}));
  EXPECT_EQ(summary.known_share, 1);
  EXPECT_NEAR(summary.no_soil_share, 0.60, 0.01);
  EXPECT_NEAR(summary.slope_p50_rad / kDegree, 6.7, 0.1);
  EXPECT_NEAR(summary.slope_p90_rad / kDegree, 15.2, 0.1);
  EXPECT_NEAR(summary.slope_p99_rad / kDegree, 23.5, 0.2);
}

TEST(RasterFiles, TheMarsYardReads) {
  const std::string file = measured_data() / "mars_yard" / "marsyard2021_0p094m.asc";
  if (const auto absence = absence_of(file)) GTEST_SKIP() << *absence;
  const ElevationRaster elevation = read_elevation(file);
  EXPECT_EQ(elevation.height_m.size(), 250000U);
  EXPECT_NEAR(elevation.frame.east_m(), -23.5 + 47, 1e-9);
  EXPECT_EQ(elevation.height_m[0], 0.017F);
}

}  // namespace
}  // namespace regoplan
