// What a scenario or a raster names beyond itself: nothing leaves the machine, nothing is read that
// lies elsewhere, and nothing is read that the memory does not hold.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/app/flat_map.h"
#include "tests/app/listener.h"
#include "tests/app/program_run.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

/// A VRT of 40 x 40 cells of one source.
std::string vrt_of(const std::string& source, bool to_vrt = true) {
  return fmt::format(
      "<VRTDataset rasterXSize=\"40\" rasterYSize=\"40\">"
      "<GeoTransform>0, 1, 0, 40, 0, -1</GeoTransform>"
      "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
      "<SourceFilename relativeToVRT=\"{}\">{}</SourceFilename><SourceBand>1</SourceBand>"
      "<SourceProperties RasterXSize=\"40\" RasterYSize=\"40\" DataType=\"Float32\" "
      "BlockXSize=\"40\" BlockYSize=\"40\"/>"
      "<SrcRect xOff=\"0\" yOff=\"0\" xSize=\"40\" ySize=\"40\"/>"
      "<DstRect xOff=\"0\" yOff=\"0\" xSize=\"40\" ySize=\"40\"/>"
      "</SimpleSource></VRTRasterBand></VRTDataset>",
      to_vrt ? 1 : 0, source);
}

class RasterSources : public testing::Test {
 protected:
  RasterSources() {
    setenv("GDAL_HTTP_TIMEOUT", "1", 1);
    setenv("GDAL_HTTP_CONNECTTIMEOUT", "1", 1);
    write_flat_scenario(folder_);
  }

  /// `map info` of a scenario whose elevation is `name`.
  ProgramRun info(const std::string& name, const std::string& options = "") const {
    folder_.write("s.yaml", replaced(flat_scenario(), "elevation: dem.tif",
                                     fmt::format("elevation: '{}'", name)));
    return run_program(folder_, "map info '" + folder_.path("s.yaml") + "' --quiet " + options);
  }

  void expect_refused(const std::string& name, const std::vector<std::string>& words) const {
    expect_refusal(info(name), words);
    EXPECT_FALSE(listener_.was_called()) << name;
  }

  ScratchFolder folder_;
  Listener listener_;
};

TEST_F(RasterSources, AreReadOverANetworkOnlyWhenAsked) {
  const std::string name = "/vsicurl/" + listener_.address() + "/dem.tif";
  expect_refused(name, {"s.yaml:2: map.elevation: ", "--allow-network"});
  EXPECT_EQ(info(name, "--allow-network").status, 1);
  EXPECT_TRUE(listener_.was_called());
}

TEST_F(RasterSources, AreNotReadOverANetworkWhateverNamesThem) {
  const std::string remote = "/vsicurl/" + listener_.address() + "/dem.tif";
  expect_refused("/vsizip//vsicurl/" + listener_.address() + "/dem.zip/dem.tif",
                 {"--allow-network"});
  expect_refused("/vsicurl_streaming/" + listener_.address() + "/dem.tif", {"--allow-network"});
  for (const char* system : {"/vsis3/", "/vsigs/", "/vsiaz/", "/vsiadls/", "/vsioss/", "/vsiswift/",
                             "/vsihdfs/", "/vsiwebhdfs/", "/vsicurl?url=", "/vsisparse/"}) {
    expect_refused(system + std::string("bucket/dem.tif"), {"--allow-network"});
  }
  // Files that name what is read in their place.
  const std::string wms = fmt::format(
      "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>{}/${{z}}</ServerUrl></Service><DataWindow>"
      "<UpperLeftX>0</UpperLeftX><UpperLeftY>40</UpperLeftY><LowerRightX>40</LowerRightX>"
      "<LowerRightY>0</LowerRightY><SizeX>40</SizeX><SizeY>40</SizeY><TileLevel>1</TileLevel>"
      "</DataWindow><BandsCount>1</BandsCount></GDAL_WMS>",
      listener_.address());
  folder_.write("wms.xml", wms);
  expect_refused("wms.xml", {"wms.xml: is not a raster"});
  folder_.write("a.vrt", vrt_of(remote, false));
  expect_refused("a.vrt", {"a.vrt: names ", "its own folder"});
  folder_.write("b.vrt", vrt_of(remote));
  expect_refused("b.vrt", {"b.vrt: names ", "its own folder"});
  folder_.write("c.vrt", vrt_of("NETCDF:\"" + listener_.address() + "/dem.nc\"", false));
  expect_refused("c.vrt", {"c.vrt: names ", "its own folder"});
  folder_.write("d.vrt", vrt_of("wms.xml"));
  EXPECT_EQ(info("d.vrt").status, 1);
  EXPECT_FALSE(listener_.was_called());
  folder_.write("e.vrt", vrt_of("a.vrt"));
  expect_refused("e.vrt", {"a.vrt: names "});
  // A mask and overviews may lie elsewhere, says a file beside the raster.
  folder_.write("dem.tif.aux.xml",
                fmt::format("<PAMDataset><Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">"
                            "{}</MDI></Metadata></PAMDataset>",
                            remote));
  EXPECT_EQ(info("dem.tif").status, 0);
  EXPECT_FALSE(listener_.was_called());
}

TEST_F(RasterSources, OfAVrtLieInItsFolder) {
  std::filesystem::create_directories(folder_.path("in/deeper"));
  const std::string dem = folder_.path("dem.tif");
  std::filesystem::copy(dem, folder_.path("in/deeper/dem.tif"));
  std::filesystem::copy(dem, folder_.path("in/dem.tif"));
  folder_.write("in/own.vrt", vrt_of("deeper/dem.tif"));
  EXPECT_EQ(info("in/own.vrt").errors, "");
  folder_.write("in/nested.vrt", vrt_of("own.vrt"));
  EXPECT_EQ(info("in/nested.vrt").errors, "");
  folder_.write("in/whole.vrt", vrt_of(folder_.path("in/dem.tif"), false));
  EXPECT_EQ(info("in/whole.vrt").errors, "");

  folder_.write("in/up.vrt", vrt_of("../dem.tif"));
  expect_refused("in/up.vrt", {"up.vrt: names \"../dem.tif\"", "its own folder", "gdal_translate"});
  folder_.write("in/elsewhere.vrt", vrt_of(dem, false));
  expect_refused("in/elsewhere.vrt", {"elsewhere.vrt: names ", "its own folder"});
  std::filesystem::create_symlink(dem, folder_.path("in/link.tif"));
  folder_.write("in/linked.vrt", vrt_of("link.tif"));
  expect_refused("in/linked.vrt", {"linked.vrt: names \"link.tif\""});
  folder_.write("in/text.vrt", vrt_of("&lt;VRTDataset/&gt;", false));
  expect_refused("in/text.vrt", {"text.vrt: names "});
  folder_.write("in/memory.vrt", vrt_of("MEM:::DATAPOINTER=1,PIXELS=40,LINES=40", false));
  expect_refused("in/memory.vrt", {"memory.vrt: names "});
}

TEST_F(RasterSources, AreJudgedAgainstTheMemoryBeforeTheyAreRead) {
#ifdef REGOPLAN_SANITIZED
  GTEST_SKIP() << "the sanitizer takes more address space than the limit of this test";
#endif
  std::string large = vrt_of("dem.tif");
  for (const char* size : {"rasterXSize=\"40\"", "rasterYSize=\"40\""}) {
    large = replaced(large, size, replaced(size, "40", "30000"));
  }
  folder_.write("large.vrt", large);
  expect_refusal(run_program(folder_, fmt::format("map info '{}'", folder_.path("large.vrt")),
                             "ulimit -v 4000000; "),
                 {"30000 x 30000 cells take 14.4 GB of memory", "gdal_translate -projwin"});
}

TEST_F(RasterSources, HoldOnlyVariablesThatAreMeantForThem) {
  setenv("REGOPLAN_TEST_NAME", "secret-name", 1);
  setenv("SECRET_TOKEN", "secret-name", 1);
  for (const ProgramRun& run : {info("${SECRET_TOKEN}.tif"), info("${REGOPLAN_TEST_NAME}.tif"),
                                info("/vsicurl/" + listener_.address() + "/${REGOPLAN_TEST_NAME}"),
                                info("${REGOPLAN_TEST_NAME}/${REGOPLAN_UNSET}.tif")}) {
    expect_refusal(run, {"s.yaml:2: map.elevation: ", "${"});
    EXPECT_EQ(run.errors.find("secret-name"), std::string::npos) << run.errors;
  }
  EXPECT_NE(info("${SECRET_TOKEN}.tif").errors.find("allowed: REGOPLAN_"), std::string::npos);
  std::filesystem::copy(folder_.path("dem.tif"), folder_.path("secret-name.tif"));
  EXPECT_EQ(info("${REGOPLAN_TEST_NAME}.tif").errors, "");
  EXPECT_FALSE(listener_.was_called());
}

}  // namespace
}  // namespace regoplan
