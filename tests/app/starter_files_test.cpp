// Files to copy: the readers take them as they are, and every number says what it is.
#include <gtest/gtest.h>

#include <regex>

#include "app/settings/preset_soils.h"
#include "app/settings/scenario_settings.h"
#include "app/settings/soil_settings.h"
#include "app/settings/vehicle_settings.h"
#include "planner/plan.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

class StarterFiles : public testing::Test {
 protected:
  std::string printed(const std::string& arguments) {
    const ProgramRun run = run_program(folder_, arguments);
    EXPECT_EQ(run.status, 0) << run.errors;
    EXPECT_EQ(run.errors, "");
    return run.output;
  }

  ScratchFolder folder_;
};

/// Lines with a number behind their key and no comment behind that.
std::vector<std::string> without_comment(const std::string& yaml) {
  static const std::regex bare(R"(\s*\w+: (-?[0-9.][^#]*|\{mean[^#]*))");
  std::vector<std::string> lines;
  std::istringstream stream(yaml);
  for (std::string line; std::getline(stream, line);) {
    if (std::regex_match(line, bare)) lines.push_back(line);
  }
  return lines;
}

TEST_F(StarterFiles, AVehicleReadsBackToThePresetWithEveryNumberExplained) {
  for (const std::string& name : preset_vehicle_names()) {
    const std::string yaml = printed("vehicle " + name);
    const Vehicle read = read_vehicle(parse_settings(yaml, name + ".yaml"));
    EXPECT_EQ(vehicle_text(read), vehicle_text(preset_vehicle(name)));
    EXPECT_LE(without_comment(yaml).size(), 4U);  // the four sides of the body
    for (const std::string& line : without_comment(yaml)) {
      EXPECT_TRUE(line.starts_with("  x_m") || line.starts_with("  y_m")) << line;
    }
  }
}

TEST_F(StarterFiles, ASoilReadsBackWithEveryNumberExplained) {
  for (const MapSoil& soil : preset_soils("scenarios/demo/soils.yaml")) {
    const std::string yaml = printed("soil " + soil.name);
    const SoilCatalogue read =
        read_soil_catalogue(parse_settings(yaml, "soils.yaml"), WheelVariant::kIshigami2007);
    ASSERT_EQ(read.soils.size(), 1U);
    EXPECT_EQ(soil_keys_text(read.soils[0].soil, ""), soil_keys_text(soil.soil, ""));
    EXPECT_EQ(read.soils[0].source, soil.source);
    std::vector<std::string> bare = without_comment(yaml);
    std::erase_if(bare, [](const std::string& line) { return line.starts_with("  1:"); });
    EXPECT_EQ(bare, std::vector<std::string>());
  }
}

TEST_F(StarterFiles, ASoilThatIsNotKnownIsRefusedWithThoseThatAre) {
  expect_refusal(run_program(folder_, "soil dust"),
                 {"dust is not known (allowed: firm_regolith | loose_regolith | soft_patch | "
                  "simulant_2004)"});
}

TEST_F(StarterFiles, TheScenarioPlansAsItIsAndWithTheOtherFilesInIt) {
  std::string yaml = printed("scenario");
  const ScenarioOverrides quick{.iterations = 200, .candidates = 1};
  const Scenario as_it_is = read_scenario(folder_.write("scenario.yaml", yaml), quick);
  EXPECT_EQ(plan(as_it_is.problem).status, PlanStatus::kFeasible);

  folder_.write("vehicle.yaml", printed("vehicle lrv"));
  folder_.write("soils.yaml", printed("soil soft_patch"));
  yaml = std::regex_replace(yaml, std::regex("vehicle: lrv"), "vehicle: vehicle.yaml");
  const std::size_t soils = yaml.find("  soils:"), vehicle = yaml.find("vehicle: vehicle.yaml");
  yaml.replace(soils, vehicle - soils, "  soils: soils.yaml\n");
  const Scenario copied = read_scenario(folder_.write("copied.yaml", yaml), quick);
  EXPECT_EQ(copied.problem.map.soils()[0].name, "soft_patch");
  EXPECT_EQ(copied.problem.vehicle.mass_kg, as_it_is.problem.vehicle.mass_kg);
}

}  // namespace
}  // namespace regoplan
