#include "terramech/wheel_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "terramech/input_error.h"

namespace regoplan {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Soil simulant() {
  return {.cohesion_pa = 800,
          .friction_angle_rad = 37.2 * kDegree,
          .kc = 1.37e3,
          .kphi = 8.14e5,
          .n = 1,
          .a0 = 0.40,
          .a1 = 0.15,
          .lambda = 0.9,
          .density_kgpm3 = 1600,
          .kx0_m = 0.036,
          .kx1_m = 0.043,
          .ky0_m = 0.013,
          .ky1_m = 0.020};
}

Soil simulant_2004() {
  return {.cohesion_pa = 800,
          .friction_angle_rad = 37.2 * kDegree,
          .kc = 1.79e6,
          .kphi = 1.95e6,
          .n = 1,
          .a0 = 0.40,
          .a1 = 0.15,
          .lambda = 0,
          .density_kgpm3 = 1600,
          .kx0_m = 0.004,
          .ky0_m = 0.045,
          .c0_m = 0.031};
}

WheelModelSpec spec_2007() {
  return {.variant = WheelVariant::kIshigami2007,
          .wheel = {.radius_m = 0.09, .width_m = 0.10},
          .soil = simulant()};
}

WheelModelSpec spec_2004() {
  return {.variant = WheelVariant::kYoshida2004,
          .wheel = {.radius_m = 0.09, .width_m = 0.10},
          .soil = simulant_2004()};
}

using Row = std::map<std::string, std::string>;

std::vector<Row> read_rows(const std::string& file) {
  std::ifstream stream(file);
  std::string line, cell;
  std::vector<std::string> names;
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    if (line.ends_with('\r')) line.pop_back();
    std::istringstream cells(line);
    Row row;
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (rows.empty() && names.size() == i) {
        names.push_back(cell);
      } else {
        row[names[i]] = cell;
      }
    }
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

std::string golden_folder() {
  const char* data = std::getenv("REGOPLAN_DATA");
  return std::string(data ? data : "../shared/data") + "/../golden";
}

void expect_near(double value, double golden, double floor, const std::string& what) {
  EXPECT_NEAR(value, golden, std::max(1e-5 * std::abs(golden), floor)) << what;
}

}  // namespace

TEST(WheelModel, MatchesTheGoldenTables) {
  const std::string folder = golden_folder();
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const std::string file : {"wheel.csv", "soils.csv"}) {
    const std::vector<Row> rows = read_rows(folder + "/" + file);
    ASSERT_GT(rows.size(), 200u);
    for (Row row : rows) {
      WheelModelSpec spec = row["model"] == "ishigami2007" ? spec_2007() : spec_2004();
      if (row.contains("n")) {
        spec.soil.n = std::stod(row["n"]);
        spec.soil.kphi = std::stod(row["kphi"]);
        spec.soil.lambda = std::stod(row["lambda"]);
      }
      const WheelForces forces = WheelModel(spec).forces(
          std::stod(row["load_n"]),
          motion_at(std::stod(row["slip_ratio"]), std::stod(row["slip_angle_deg"]) * kDegree));
      std::string what = file;
      for (const auto& [name, cell] : row) what += " " + name + "=" + cell;
      ASSERT_TRUE(has_forces(forces.status)) << what;
      expect_near(forces.fx_n, std::stod(row["fx_n"]), 1e-4, what);
      expect_near(forces.fy_n, std::stod(row["fy_n"]), 1e-4, what);
      expect_near(forces.torque_nm, std::stod(row["torque_nm"]), 1e-6, what);
      expect_near(forces.sinkage_m, std::stod(row["sinkage_m"]), 1e-8, what);
      expect_near(forces.theta_f_rad, std::stod(row["theta_f_rad"]), 1e-8, what);
      expect_near(forces.theta_r_rad, std::stod(row["theta_r_rad"]), 1e-8, what);
    }
  }
}

}  // namespace regoplan
