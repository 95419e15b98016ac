// What a suite may vary: soils, vehicles, planners; and what is refused, with its place.
#include <gtest/gtest.h>

#include "app/settings/scenario_settings.h"
#include "app/settings/suite_settings.h"
#include "app/settings/vehicle_settings.h"
#include "terramech/basics/angles.h"
#include "tests/app/flat_map.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

class SuiteSweep : public testing::Test {
 protected:
  Suite suite(const std::string& planners, const std::string& sweep) {
    return read_suite(folder_.write("suite.yaml",
                                    "name: sweep\nscenarios: [scenario.yaml]\nseeds: 1\ntime_s: 1\n"
                                    "planners: [" +
                                        planners + "]\nsweep: {" + sweep + "}\n"));
  }
  PlanningProblem problem() { return read_scenario(folder_.path("scenario.yaml"), {}).problem; }
  PlanningProblem at(const Suite& suite, std::size_t point) {
    return at_sweep_point(problem(), suite, 0, point);
  }
  std::string refusal(const std::string& sweep) {
    return error_text([&] {
      const Suite read = suite("RRT", sweep);
      for (std::size_t point = 0; point < read.sweep.size(); ++point) at(read, point);
    });
  }

  ScratchFolder folder_;
  std::string scenario_ = write_flat_scenario(folder_);
};

TEST_F(SuiteSweep, SetsTheMeanOfOneSoilOrOfAll) {
  const Suite one = suite("RRT", "soils.mare.friction_angle_deg: [30, 36]");
  ASSERT_EQ(one.sweep.size(), 2U);
  EXPECT_EQ(at(one, 0).map.soils()[0].soil.mean.friction_angle_rad, 30 * kDegree);
  EXPECT_EQ(at(one, 1).map.soils()[0].soil.mean.friction_angle_rad, 36 * kDegree);
  EXPECT_EQ(at(one, 1).map.soils()[0].soil.mean.kphi, problem().map.soils()[0].soil.mean.kphi);
  EXPECT_EQ(at(suite("RRT", "soil.n: [0.8]"), 0).map.soils()[0].soil.mean.n, 0.8);
}

TEST_F(SuiteSweep, SetsEveryNumberOfAVehicleInItsUnit) {
  int varied = 0;
  for (const VehicleNumber& number : vehicle_numbers()) {
    const double before = problem().vehicle.*number.member / number.unit;
    const std::string key = std::string("vehicle.") + std::string(number.key);
    if (refusal(key + ": [" + std::to_string(before) + "]").find("cannot be varied") !=
        std::string::npos) {
      continue;  // a limit, which is varied as such
    }
    ++varied;
    // What a vehicle can do must stay more than what is asked of it.
    const double after = (number.key == "curvature_max_1pm" ? 0.97 : 1.03) * before;
    const Suite read = suite("RRT", key + ": [" + std::to_string(after) + "]");
    EXPECT_NEAR(at(read, 0).vehicle.*number.member, after * number.unit, 1e-6) << key;
  }
  EXPECT_EQ(varied, 10);
  EXPECT_EQ(at(suite("RRT", "vehicle.wheel.width_m: [0.3]"), 0).vehicle.wheel.width_m, 0.3);
  EXPECT_EQ(at(suite("RRT", "vehicle.torque_max_nm: [50]"), 0).vehicle.torque_max_nm, 50);
}

TEST_F(SuiteSweep, RefusesWithFileLineAndRange) {
  EXPECT_EQ(refusal("soil.n: [0.2]"), folder_.path("suite.yaml") +
                                          ":6: sweep.soil.n[0]: 0.2 is not valid "
                                          "(allowed: 0.3 to 2)");
  EXPECT_EQ(refusal("vehicle.mass_kg: [700, -1]"),
            folder_.path("suite.yaml") +
                ":6: sweep.vehicle.mass_kg[1]: -1 is not valid (allowed: 0.1 to 1000000)");
  for (const auto& [sweep, words] : std::vector<std::pair<std::string, std::string>>{
           {"soils.dust.n: [1]",
            ":6: sweep.soils.dust.n: scenario,soils.dust.n=1: the map has no "
            "soil dust (it has: mare)"},
           {"soil.phi: [1]",
            ":6: sweep.soil.phi: phi is no number of a soil (allowed: "
            "cohesion_pa, friction_angle_deg"},
           {"vehicle.slip_max: [0.5]", ":6: sweep.vehicle.slip_max: cannot be varied (allowed: "},
           {"vehicle.name: [1]", "cannot be varied"},
           {"\"soils.a,b.n\": [1]", "a comma"},
           {"soil.n: one", "one is not valid (allowed: a list)"},
           {"soil.n: [one]", "one is not valid (allowed: a number, 0.3 to 2)"},
           {"soil.n: []", "is empty"},
           {"soil.n: [1, 0.9, 1.0]", ":6: sweep.soil.n[2]: 1 stands twice"},
           {"soil.a0: [0.95]", ":6: sweep: scenario,soil.a0=0.95: a1: 0.15 is not valid"},
           {"vehicle.speed_max_mps: [0.1]",
            ":6: sweep: scenario,vehicle.speed_max_mps=0.1: "
            "speed_mps.max"}}) {
    EXPECT_NE(refusal(sweep).find(words), std::string::npos) << sweep << ": " << refusal(sweep);
  }
}

TEST_F(SuiteSweep, APlannersListedParametersArePlannersOfTheirOwn) {
  const Suite read = suite(
      "{planner: SST, parameters: {goal_bias: [0.1, 0.2], pruning_radius: 1, "
      "selection_radius: [2, 3]}}, RRT",
      "");
  std::vector<std::string> labels;
  for (const SuitePlanner& planner : read.planners) labels.push_back(planner.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"SST-goal_bias-0.1-selection_radius-2",
                                              "SST-goal_bias-0.1-selection_radius-3",
                                              "SST-goal_bias-0.2-selection_radius-2",
                                              "SST-goal_bias-0.2-selection_radius-3", "RRT"}));
  EXPECT_EQ(read.planners[1].parameters,
            (std::map<std::string, std::string>{
                {"goal_bias", "0.1"}, {"pruning_radius", "1"}, {"selection_radius", "3"}}));
}

TEST_F(SuiteSweep, APlannersParametersAreRefusedWhereTheyStand) {
  const auto planners = [this](const std::string& text) {
    return error_text([&] { suite(text, ""); });
  };
  EXPECT_NE(planners("{planner: RRT, parameters: {goal_bias: []}}")
                .find(":5: planners[0].parameters.goal_bias: is empty"),
            std::string::npos);
  EXPECT_NE(planners("{planner: RRT, parameters: {goal_bias: [0.1, 0.1]}}")
                .find("RRT-goal_bias-0.1 stands twice"),
            std::string::npos);
}

}  // namespace
}  // namespace regoplan
