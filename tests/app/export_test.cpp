// A plan's files for other programs, read back as those read them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/export/qgis_style.h"
#include "app/settings/settings_mapping.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

/// What map_server makes of a mask: occupancy in per cent, from the south-west corner, row by row.
struct Mask {
  int columns = 0, rows = 0;
  double resolution_m = 0, west_m = 0, south_m = 0;
  std::vector<int> occupancy;

  int at(double x_m, double y_m) const {
    const int column = static_cast<int>((x_m - west_m) / resolution_m);
    const int row = static_cast<int>((y_m - south_m) / resolution_m);
    return occupancy.at(static_cast<std::size_t>(row * columns + column));
  }
};

Mask read_mask(const ScratchFolder& folder, const std::string& name) {
  const SettingsNode yaml = read_settings(folder.path("nav2/" + name + ".yaml"));
  Mask mask{.resolution_m = yaml.find("resolution")->number(kAbove0),
            .west_m = yaml.find("origin")->list().at(0).number(kAnyNumber),
            .south_m = yaml.find("origin")->list().at(1).number(kAnyNumber)};
  const bool raw = yaml.find("mode")->text() == "raw";
  EXPECT_EQ(yaml.find("negate")->number(kAnyNumber), 0);
  std::istringstream picture(folder.read("nav2/" + yaml.find("image")->text()));
  std::string magic;
  int most = 0;
  picture >> magic >> mask.columns >> mask.rows >> most;
  picture.get();
  EXPECT_EQ(magic, "P5");
  EXPECT_EQ(most, 255);
  mask.occupancy.resize(static_cast<std::size_t>(mask.columns * mask.rows));
  for (int row = mask.rows - 1; row >= 0; --row) {
    for (int column = 0; column < mask.columns; ++column) {
      const int pixel = picture.get();
      EXPECT_GE(pixel, 0) << "the picture ends early";
      const double occupied = 1 - pixel / 255.0;
      mask.occupancy[static_cast<std::size_t>(row * mask.columns + column)] =
          raw                                                           ? pixel
          : occupied > yaml.find("occupied_thresh")->number(kAnyNumber) ? 100
          : occupied < yaml.find("free_thresh")->number(kAnyNumber)     ? 0
                                                                        : -1;
    }
  }
  EXPECT_EQ(picture.get(), std::char_traits<char>::eof());
  return mask;
}

/// A rock in the way and a crater too steep to drive, both beside the path; planned and exported
/// once, each test in a copy.
class Export : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    whole_ = std::make_unique<ScratchFolder>();
    const ScratchFolder& folder = *whole_;
    std::string yaml = run_program(folder, "scenario").output;
    yaml = std::regex_replace(yaml, std::regex("craters: .*"),
                              "craters: [{x_m: 20, y_m: 45, diameter_m: 12, depth_m: 5}]\n"
                              "    rocks: [{x_m: 40, y_m: 40, radius_m: 1.2, height_m: 1.5}]");
    const std::string scenario = folder.write("scenario.yaml", yaml);
    const ProgramRun planned = run_program(
        folder, "plan '" + scenario + "' --quiet --iterations 200 --candidates 1 --out '" +
                    folder.path("result") + "'");
    ASSERT_EQ(planned.status, 0) << planned.errors;
    const ProgramRun exported =
        run_program(folder, "export '" + folder.path("result") + "' --nav2 '" +
                                folder.path("nav2") + "' --qgis '" + folder.path("qgis") + "'");
    ASSERT_EQ(exported.status, 0) << exported.errors;
  }
  static void TearDownTestSuite() { whole_.reset(); }
  Export() { folder_.copy_from(*whole_); }

  static inline std::unique_ptr<ScratchFolder> whole_;
  ScratchFolder folder_;
};

TEST_F(Export, MasksSayWhereAndHowFast) {
  const Mask keepout = read_mask(folder_, "keepout"), speed = read_mask(folder_, "speed");
  EXPECT_EQ(keepout.resolution_m, 0.5);
  EXPECT_EQ(keepout.columns, 120);
  EXPECT_EQ(keepout.rows, 120);
  EXPECT_EQ(keepout.at(10, 25), 0);    // the start
  EXPECT_EQ(keepout.at(40, 40), 100);  // the rock
  EXPECT_EQ(keepout.at(41.5, 40), 0);
  EXPECT_EQ(keepout.at(40, 20), 0);    // the rock's mirror image is free: north is up
  EXPECT_EQ(keepout.at(20, 41), 100);  // the crater's wall
  EXPECT_EQ(speed.at(10, 25), 0);      // no limit
  for (const int percent : speed.occupancy) {
    EXPECT_TRUE(percent == 0 || percent == 1 || percent == 25 || percent == 50 || percent == 75);
  }
}

TEST_F(Export, TheRouteIsAGraphFromStartToGoal) {
  const auto route = nlohmann::json::parse(folder_.read("nav2/route.geojson"));
  std::map<int, std::array<double, 2>> nodes;
  int edges = 0;
  for (const auto& feature : route.at("features")) {
    const auto& properties = feature.at("properties");
    const auto& geometry = feature.at("geometry");
    if (geometry.at("type") == "Point") {
      nodes[properties.at("id")] = geometry.at("coordinates");
      continue;
    }
    EXPECT_EQ(geometry.at("type"), "MultiLineString");
    EXPECT_FALSE(nodes.contains(properties.at("id")));
    const auto& ends = geometry.at("coordinates").at(0);
    const std::array<double, 2> from = ends.at(0), to = ends.at(1);
    EXPECT_EQ(from, nodes.at(properties.at("startid")));
    EXPECT_EQ(to, nodes.at(properties.at("endid")));
    ++edges;
  }
  ASSERT_GT(nodes.size(), 10U);
  EXPECT_EQ(edges + 1, static_cast<int>(nodes.size()));
  EXPECT_NEAR(nodes.begin()->second[0], 10, 0.01);
  EXPECT_LT(std::hypot(nodes.rbegin()->second[0] - 40, nodes.rbegin()->second[1] - 25), 3);
}

TEST_F(Export, NodesOfTheRouteLieNoFartherApartThanAsked) {
  for (const double spacing_m : {0.3, 2.0, 5.0}) {
    const ProgramRun run =
        run_program(folder_, fmt::format("export '{}' --force --nav2 '{}' --spacing-m {}",
                                         folder_.path("result"), folder_.path("nav2"), spacing_m));
    ASSERT_EQ(run.status, 0) << run.errors;
    const auto route = nlohmann::json::parse(folder_.read("nav2/route.geojson"));
    double longest_m = 0;
    for (const auto& feature : route.at("features")) {
      if (feature.at("geometry").at("type") == "Point") continue;
      const auto& ends = feature.at("geometry").at("coordinates").at(0);
      const std::array<double, 2> from = ends.at(0), to = ends.at(1);
      longest_m = std::max(longest_m, std::hypot(to[0] - from[0], to[1] - from[1]));
    }
    EXPECT_LE(longest_m, spacing_m + 1e-9);
    EXPECT_GT(longest_m, 0.8 * spacing_m);
  }
  expect_refusal(run_program(folder_, "export '" + folder_.path("result") + "' --nav2 '" +
                                          folder_.path("nav2") + "' --spacing-m 1e-9"),
                 {"--spacing-m", "0.01"});
}

TEST_F(Export, TheStyleOfQgisRisesThroughTheLeastMargin) {
  EXPECT_EQ(folder_.read("qgis/margin.tif"), folder_.read("result/margin.tif"));
  const std::string style = folder_.read("qgis/margin.qml");
  EXPECT_EQ(style, qgis_margin_style(0.05));
  static const std::regex item(
      R"re(<item value="([-0-9.]+)" color="#[0-9a-f]{6}" alpha="255" label="[^"<>&]+"/>)re");
  std::vector<double> values;
  for (std::sregex_iterator at(style.begin(), style.end(), item), end; at != end; ++at) {
    values.push_back(std::stod((*at)[1]));
  }
  EXPECT_EQ(values, (std::vector<double>{-1, 0, 0.05, 0.2, 0.5}));
  for (const char* tag : {"qgis", "pipe", "rasterrenderer", "rastershader", "colorrampshader"}) {
    EXPECT_NE(style.find(std::string("<") + tag), std::string::npos);
    EXPECT_NE(style.find(std::string("</") + tag + ">"), std::string::npos);
  }
}

TEST_F(Export, TheStyleIsOfThePlanWhateverBecameOfTheScenario) {
  const std::string export_to =
      "export '" + folder_.path("result") + "' --force --qgis '" + folder_.path("qgis") + "'";
  const std::string scenario = folder_.read("scenario.yaml");
  const std::regex least("margin_min: 0.05");
  ASSERT_TRUE(std::regex_search(scenario, least));
  folder_.write("scenario.yaml", std::regex_replace(scenario, least, "margin_min: 0.3"));
  const ProgramRun changed = run_program(folder_, export_to);
  EXPECT_EQ(changed.status, 0) << changed.errors;
  EXPECT_EQ(folder_.read("qgis/margin.qml"), qgis_margin_style(0.05));
  std::filesystem::remove(folder_.path("scenario.yaml"));
  const ProgramRun gone = run_program(folder_, export_to);
  EXPECT_EQ(gone.status, 0) << gone.errors;
}

TEST_F(Export, TheMasksAreOfTheScenarioAsItIsAndSaySo) {
  folder_.write("scenario.yaml", folder_.read("scenario.yaml") + "# edited\n");
  const ProgramRun run = run_program(
      folder_, "export '" + folder_.path("result") + "' --nav2 '" + folder_.path("again") + "'");
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.errors.find("scenario has changed since the plan; the masks are of what it is now"),
            std::string::npos)
      << run.errors;
}

TEST_F(Export, RefusesWhatIsNoResult) {
  expect_refusal(run_program(folder_, "export '" + folder_.path("result") + "'"),
                 {"export: --nav2 DIR or --qgis DIR is needed"});
  expect_refusal(run_program(folder_, "export '" + folder_.path("nav2") + "' --nav2 '" +
                                          folder_.path("other") + "'"),
                 {"RESULT: ", "nav2: no result of plan (allowed: a folder with plan.json)"});
}

}  // namespace
}  // namespace regoplan
