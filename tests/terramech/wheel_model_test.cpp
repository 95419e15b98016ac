#include "terramech/wheel/wheel_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "terramech/basics/input_error.h"
#include "tests/measured_data.h"
#include "tests/terramech/csv_rows.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

using wheel_specs::NamedSpec;

WheelModelSpec spec_2007() {
  return wheel_specs::ishigami2007();
}
WheelModelSpec spec_2004() {
  return wheel_specs::yoshida2004();
}

void expect_near(double value, double golden, double floor, const std::string& what) {
  EXPECT_NEAR(value, golden, std::max(1e-5 * std::abs(golden), floor)) << what;
}

}  // namespace

TEST(WheelModel, MatchesTheGoldenTables) {
  const std::string folder = measured_data() / ".." / "golden";
  if (const auto absence = absence_of(folder)) GTEST_SKIP() << *absence;
  for (const std::string file : {"wheel.csv", "soils.csv"}) {
    const std::vector<csv_rows::Row> rows = csv_rows::read(folder + "/" + file);
    ASSERT_GT(rows.size(), 200u);
    for (csv_rows::Row row : rows) {
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
