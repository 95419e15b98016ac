// `evaluate --chart` as a person meets it.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>

#include "tests/app/evaluate_program.h"

namespace regoplan {
namespace {

TEST_F(Evaluate, AChartTakesNothingThatIsOfPaths) {
  const std::string chart = "--chart '" + folder_.path("chart") + "'";
  const std::string scenario = " '" + folder_.path("scenario.yaml") + "' ";
  const std::string model = file("m.yaml", "soil_name: dry_sand\n");
  for (const auto& [given, error] : {
           std::pair{scenario + "--speed 1", "--chart takes no --speed"},
           std::pair{scenario + "--deviation-max-m 1", "--chart takes no --deviation-max-m"},
           std::pair{scenario + "--follower pursuit", "--chart takes no --follower"},
           std::pair{scenario + "--draws 9", "--chart takes no --draws"},
           std::pair{scenario + "--seed 3", "--chart takes no --seed"},
           std::pair{scenario + "--json", "--chart takes no --json"},
           std::pair{scenario + "--vehicle nope",
                     "regoplan: --vehicle: nope is not valid (allowed: tohoku | lrv | curiosity, "
                     "or a vehicle file; there is no such file)"},
           std::pair{" --vehicle lrv --model " + model, "--model only with a SCENARIO.yaml"},
       }) {
    const ProgramRun run = run_program(folder_, "evaluate " + chart + given);
    EXPECT_EQ(run.status, 1) << given;
    EXPECT_NE(run.errors.find(error), std::string::npos) << given << ": " << run.errors;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path("chart")));
}

TEST_F(Evaluate, AChartGoesAsFastAsTheVehicleDoesAndNoFaster) {
  const std::string soils = file("s.yaml",
                                 "soils: {r: {source: t, cohesion_pa: 170, friction_angle_deg: 36, "
                                 "kc: 1400, kphi: 820000, n: 1, a0: 0.4, a1: 0.15, lambda: 0.9, "
                                 "density_kgpm3: 1500, kx0_m: 0.018, ky0_m: 0.013}}\n");
  const std::string chart = "evaluate --chart '" + folder_.path("chart") + "' --vehicle curiosity" +
                            " --gravity-mps2 3.71 --chart-slopes-deg 0 --quiet --soils " + soils;
  const ProgramRun beyond = run_program(folder_, chart + " --chart-speed-mps 0.05");
  EXPECT_EQ(beyond.status, 1);
  EXPECT_NE(beyond.errors.find("--chart-speed-mps: 0.05 is not valid (allowed: above 0 to 0.04, "
                               "the largest of curiosity)"),
            std::string::npos)
      << beyond.errors;
  const ProgramRun run = run_program(folder_, chart);
  ASSERT_EQ(run.status, 0) << run.errors;
  const std::string rows = folder_.read("chart/safe-curvature.csv");
  EXPECT_TRUE(rows.substr(rows.rfind('\n', rows.size() - 2) + 1).starts_with("r,0,0.04,")) << rows;
}

TEST_F(Evaluate, AChartNamesEveryCurveOfALineThatIsSeveral) {
  const std::string numbers =
      "source: t, cohesion_pa: 170, friction_angle_deg: 36, kc: 1400, kphi: 820000, n: 1, a0: 0.4, "
      "a1: 0.15, lambda: 0.9, density_kgpm3: 1500, kx0_m: 0.018, ky0_m: 0.013}";
  const std::string soils = file("s.yaml", "soils: {r: {" + numbers + ", s: {" + numbers + "}\n");
  const ProgramRun run =
      run_program(folder_, "evaluate --chart '" + folder_.path("chart") + "' --vehicle curiosity" +
                               " --gravity-mps2 3.71 --chart-slopes-deg 0 --chart-slopes-deg 15" +
                               " --chart-speed-mps 0.04 --quiet --soils " + soils);
  ASSERT_EQ(run.status, 0) << run.errors;
  const std::string picture = folder_.read("chart/feasibility.svg");
  for (const char* told : {"1 is one line for r, s, turns on ground that rises 0 deg",
                           "is one line for r, s, straight across a slope"}) {
    EXPECT_NE(picture.find(told), std::string::npos) << told;
  }
}

TEST_F(Evaluate, AChartIsAPictureAndTables) {
  const ProgramRun run =
      run_program(folder_, "evaluate '" + folder_.path("scenario.yaml") + "' --chart '" +
                               folder_.path("chart") + "' --chart-slopes-deg 0 --quiet");
  ASSERT_EQ(run.status, 0) << run.errors;
  const std::string picture = folder_.read("chart/feasibility.svg");
  EXPECT_TRUE(picture.starts_with("<svg"));
  // Told below the panels only, where no curve runs through it.
  const std::size_t limit = picture.find("smallest margin allowed");
  EXPECT_EQ(limit,
            picture.find("end of the steering; ") + std::string("end of the steering; ").size());
  EXPECT_EQ(picture.find("smallest margin allowed", limit + 1), std::string::npos);
  EXPECT_TRUE(folder_.read("chart/side-slope.csv").starts_with("soil,slope_deg,"));
  std::istringstream rows(folder_.read("chart/safe-curvature.csv"));
  std::string line;
  std::getline(rows, line);
  double before = 1e9;
  int count = 0;
  while (std::getline(rows, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int k = 0; k < 4; ++k) std::getline(cells, cell, ',');
    EXPECT_LE(std::stod(cell), before * 1.01);  // faster is never safer
    before = std::stod(cell);
    ++count;
  }
  EXPECT_EQ(count, 19);
}

}  // namespace
}  // namespace regoplan
