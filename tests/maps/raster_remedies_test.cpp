// What a refused raster is told to be mended with, and that it mends it.
#include <gdal_utils.h>
#include <gtest/gtest.h>
#include <wordexp.h>

#include <filesystem>
#include <string>
#include <vector>

#include "maps/raster_files.h"
#include "tests/error_text.h"
#include "written_tiff.h"

namespace regoplan {
namespace {

TEST(RasterRemedies, DegreesAreRefusedNamingARemedyThatWorks) {
  const ScratchFolder folder;
  for (const char* crs : {"EPSG:4326", "+proj=longlat +R=3396190"}) {
    const std::string file = write(folder, {.transform = {137, 1e-5, 0, -4, 0, -1e-5}, .crs = crs});
    const std::vector<std::string> words{"in.tif", "degrees", "gdalwarp -r ", "-t_srs '+proj=tmerc",
                                         "+lat_0=-4.0000 +lon_0=137.0000"};
    EXPECT_TRUE(refuses([&] { read_elevation(file); }, words));
    EXPECT_TRUE(refuses([&] { read_classes(file); }, words));
  }
}

/// Runs the command that a refusal names, as a shell in `folder` would. \returns the raster that it
/// makes
std::string mended_by(const std::string& refusal, const ScratchFolder& folder) {
  const std::string mark = "remedy: gdalwarp ";
  const std::size_t at = refusal.find(mark);
  if (at == std::string::npos) return "no gdalwarp in: " + refusal;
  wordexp_t words{};
  EXPECT_EQ(wordexp(refusal.substr(at + mark.size()).c_str(), &words, WRDE_NOCMD), 0) << refusal;
  EXPECT_GE(words.we_wordc, 2u) << refusal;
  const std::filesystem::path here = folder.path("");
  const std::string from = words.we_wordv[words.we_wordc - 2];
  EXPECT_FALSE(from.starts_with('-')) << from << " would be read as an option";
  std::string out = here / words.we_wordv[words.we_wordc - 1];
  EXPECT_FALSE(std::filesystem::exists(out)) << out << " would be written over";
  const GDALDatasetUniquePtr source(GDALDataset::Open((here / from).c_str()));
  EXPECT_NE(source, nullptr) << from;
  std::vector<char*> options(words.we_wordv, words.we_wordv + words.we_wordc - 2);
  options.push_back(nullptr);
  GDALWarpAppOptions* warp = GDALWarpAppOptionsNew(options.data(), nullptr);
  GDALDatasetH given = source.get();
  GDALClose(GDALWarp(out.c_str(), nullptr, 1, &given, warp, nullptr));
  GDALWarpAppOptionsFree(warp);
  wordfree(&words);
  return out;
}

TEST(RasterRemedies, TheCommandThatARefusalNamesMendsTheRaster) {
  const ScratchFolder folder;
  for (const Tiff& tiff :
       {Tiff{.transform = {15, 1e-5, 0, 48, 0, -1e-5}, .crs = "EPSG:4326"},
        Tiff{.transform = {137, 1e-5, 0, -4, 0, -1e-5}, .crs = "+proj=longlat +R=3396190"},
        Tiff{.transform = {1640000, 3, 0, 13900000, 0, -3}, .crs = "EPSG:2225"},  // feet
        Tiff{.transform = {500000, 0.8, 0.6, 5300000, 0.6, -0.8}, .crs = "EPSG:32633"}}) {
    const std::string file = write(folder, tiff, "it's a map.tif");
    for (const bool heights : {true, false}) {
      const auto read = [&](const std::string& raster) {
        return heights ? read_elevation(raster).frame : read_classes(raster).frame;
      };
      const std::string refusal = error_text([&] { read(file); });
      EXPECT_NE(refusal.find(heights ? "-r bilinear " : "-r near "), std::string::npos) << refusal;
      const std::string out = mended_by(refusal, folder);
      const GridFrame mended = read(out);
      EXPECT_GT(mended.cell_width_m, 0.1) << refusal;
      EXPECT_LT(mended.cell_width_m, 2) << refusal;
      std::filesystem::remove(out);
    }
  }
}

TEST(RasterRemedies, TheCommandMendsARasterWhoseNameIsTheOutputsOrLooksLikeAnOption) {
  const ScratchFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path(""));
  for (const char* name : {"out.tif", "./out.tif", "-x.tif", "-r"}) {
    write(folder, {.transform = {15, 1e-5, 0, 48, 0, -1e-5}, .crs = "EPSG:4326"}, name);
    const std::string refusal = error_text([&] { read_elevation(name); });
    const std::string mended = mended_by(refusal, folder);
    EXPECT_GT(read_elevation(mended).frame.cell_width_m, 0.1) << refusal;
    std::filesystem::remove(mended);
    std::filesystem::remove(name);
  }
  std::filesystem::current_path(before);
}

TEST(RasterRemedies, ClassesInAnotherCrsAreBroughtIntoTheElevationsByTheCommandNamed) {
  const ScratchFolder folder;
  const Tiff classes{
      .type = GDT_Byte, .transform = {500000, 1, 0, 5300000, 0, -1}, .crs = "EPSG:32633"};
  const std::string file = write(folder, classes);
  const std::array<double, 6> around{-20000, 20000, 0, 20000, 0, -20000};
  for (const auto& [crs, transform] :
       {std::pair{"EPSG:25833", classes.transform},
        std::pair{"+proj=tmerc +lat_0=47.85 +lon_0=15 +ellps=WGS84 +units=m", around}}) {
    const GridFrame elevation =
        read_elevation(write(folder, {.transform = transform, .crs = crs}, "dem.tif")).frame;
    ClassRaster raster = read_classes(file);
    const std::string refusal = error_text([&] { adopt_crs(raster, elevation, file); });
    const std::string out = mended_by(refusal, folder);
    ClassRaster mended = read_classes(out);
    EXPECT_EQ(adopt_crs(mended, elevation, out), "") << refusal;
    std::filesystem::remove(out);
  }
}

TEST(RasterRemedies, FeetAreRefused) {
  const ScratchFolder folder;
  EXPECT_TRUE(refuses(
      [&] { read_elevation(write(folder, {.crs = "+proj=tmerc +R=6371000 +units=us-ft"})); },
      {"0.3048", "gdalwarp -r bilinear -t_srs"}));
  EXPECT_TRUE(refuses([&] { read_elevation(write(folder, {.unit = "ft"})); }, {"\"ft\""}));
  EXPECT_EQ(read_elevation(write(folder, {.unit = "metre"})).height_m[0], 1);
}

TEST(RasterRemedies, HeightsInAnotherUnitAreRefusedWithTheScaleThatMendsThem) {
  const ScratchFolder folder;
  struct UnitAndScale {
    const char *unit, *scale;
  };
  for (const UnitAndScale& in :
       {UnitAndScale{"ft", "--scale 0.3048"},
        UnitAndScale{"US survey foot", "--scale 0.3048006096"}, UnitAndScale{"cm", "--scale 0.01"},
        UnitAndScale{"kilometre", "--scale 1000"},
        UnitAndScale{"furlong", "--scale METRES_A_UNIT"}}) {
    EXPECT_TRUE(
        refuses([&] { read_elevation(write(folder, {.unit = in.unit})); }, {in.unit, in.scale}));
  }
  write(folder, {});
  const std::string virtual_raster = folder.write(
      "feet.vrt",
      "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><SRS>EPSG:32633+6360</SRS>"
      "<GeoTransform>100, 1, 0, 200, 0, -1</GeoTransform><VRTRasterBand dataType=\"Float32\" "
      "band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">in.tif</SourceFilename>"
      "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  EXPECT_TRUE(refuses([&] { read_elevation(virtual_raster); },
                      {"vertical CRS", "US survey foot", "--scale 0.3048006096"}));
  const std::string feet = write(folder, {.scale = 2, .offset = 10, .unit = "ft"});
  EXPECT_TRUE(refuses([&] { read_elevation(feet); }, {"--scale 0.6096 --offset 3.048"}));
  const ElevationRaster mended = read_elevation(feet, {.scale = 0.6096, .offset_m = 3.048});
  EXPECT_NEAR(mended.height_m[3], 18 * 0.3048, 1e-6);
}

TEST(RasterRemedies, ACrsInAnotherUnitIsRefusedWithARemedyThatCanBeCopied) {
  const ScratchFolder folder;
  EXPECT_TRUE(refuses(
      [&] {
        read_elevation(write(folder, {.crs = "+proj=tmerc +lon_0=9 +R=6371000 +units=us-ft"}));
      },
      {"0.3048006096 m", "gdalwarp -r bilinear -t_srs '+proj=tmerc +lat_0=0 +lon_0=9",
       "+units=m'"}));
  for (const auto& [unit, corners] :
       {std::pair{R"(UNIT["centimetre",0.01])", "-a_ullr 1 2 1.02 1.98"},
        std::pair{R"(UNIT["kilometre",1000])", "-a_ullr 100000 200000 102000 198000"}}) {
    const std::string crs = std::string(R"(LOCAL_CS["bed",)") + unit + "]";
    EXPECT_TRUE(refuses([&] { read_elevation(write(folder, {.crs = crs})); },
                        {"metres are needed", "gdal_translate -a_srs", corners}));
  }
}

}  // namespace
}  // namespace regoplan
