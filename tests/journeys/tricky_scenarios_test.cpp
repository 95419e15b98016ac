// Problems that are hard to search but have a path, each as a promise: the lattice finds one that
// passes its verification, within a budget of drives that takes about a second.
#include <gtest/gtest.h>

#include "app/settings/scenario_settings.h"
#include "planner/certificate/relaxed_problem.h"
#include "planner/driving/crash_ahead.h"
#include "planner/ompl/search_run.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {
namespace {

constexpr std::int64_t kDrives = 60000;

PlanningProblem tricky(const std::string& name) {
  return read_scenario(REGOPLAN_SOURCE_DIR "/benchmarks/scenarios/tricky/" + name + ".yaml", {})
      .problem;
}

std::vector<ControlSegment> found(const World& world) {
  return search(world, {.planner = "Lattice",
                        .guidance = {.seed = 1,
                                     .margin_min = world.problem().limits.margin_min + 0.05,
                                     .variety = 0,
                                     .improve = false},
                        .time_s = {},
                        .iterations = kDrives})
      .controls;
}

class TrickyScenario : public testing::TestWithParam<const char*> {};

TEST_P(TrickyScenario, HasAPathThatPassesItsVerification) {
  const PlanningProblem problem = tricky(GetParam());
  const World world(problem, WorldUse::kSearch, 2), verdict(problem, WorldUse::kVerdict, 2);
  const std::vector<ControlSegment> controls = found(world);
  ASSERT_FALSE(controls.empty());
  EXPECT_TRUE(
      verify(verdict, world, {.planner = {}, .controls = controls}).candidate.verified.passed);
}

INSTANTIATE_TEST_SUITE_P(All, TrickyScenario,
                         testing::Values("gate_2_5_m", "gate_2_7_m", "alley_2_5_m",
                                         "dead_end_alley", "soft_soil_detour", "facing_a_rock",
                                         "u_turn_to_3_m_behind", "u_turn_to_3_m_beside",
                                         "three_gates_in_500_m", "along_unmapped_ground"));

}  // namespace

TEST(TrickyScenario, AGateOf1_6MetresIsCertifiedToBeNoWay) {
  EXPECT_TRUE(certificate_of_infeasibility(tricky("infeasible_gate_1_6_m")));
}

TEST(TrickyScenario, ACrashThatCannotBeAvoidedIsNamed) {
  const PlanningProblem problem = tricky("infeasible_crash");
  EXPECT_TRUE(found(World(problem, WorldUse::kSearch, 2)).empty());
  EXPECT_TRUE(crash_ahead(World(problem, WorldUse::kVerdict, 2)));
}

}  // namespace regoplan
