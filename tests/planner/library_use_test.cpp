// What somebody else's program relies on: the same verdict as plan's, OMPL's log and the process's
// threads left alone, no reference to what is gone.
#include <gtest/gtest.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <condition_variable>
#include <mutex>
#include <thread>
#include <type_traits>

#include "planner/ompl/iteration_termination.h"
#include "planner/ompl/ompl_planners.h"
#include "planner/ompl/ompl_problem.h"
#include "planner/plan.h"
#include "planner/search/run_schedule.h"
#include "planner/verdict/verified_path.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

PlanningProblem across_open_ground(const std::string& planner) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.search.planner = planner;
  problem.search.improve = false;
  return problem;
}

/// What an OMPL program of one's own does: the problem's space, OMPL's RRT or our planner, and the
/// verdict of what it finds.
Candidate own_verdict(const World& searched, const World& verdict, const SearchRun& run) {
  OmplProblem ours(searched, run.guidance);
  ompl::base::PlannerPtr planner;  // first, as in plan: OMPL hands out seeds in order of creation
  if (run.planner == "RRT") {
    auto rrt = std::make_shared<ompl::control::RRT>(ours.space());
    rrt->setGoalBias(0.1);
    rrt->setIntermediateStates(false);
    planner = rrt;
  } else {
    planner = make_planner(run.planner, ours);
  }
  const auto definition = std::make_shared<ompl::base::ProblemDefinition>(ours.space());
  ours.pose(*definition);
  planner->setProblemDefinition(definition);
  planner->setup();
  ompl::base::IterationTerminationCondition bound(static_cast<unsigned int>(*run.iterations));
  planner->solve(bound);
  return verify(verdict, searched,
                {.planner = run.planner,
                 .seed = run.guidance.seed,
                 .controls = exact_solution(*definition)})
      .candidate;
}

class OwnOmplProgram : public testing::TestWithParam<const char*> {};

TEST_P(OwnOmplProgram, ComesToTheVerdictOfPlan) {
  const PlanningProblem problem = across_open_ground(GetParam());
  const PlanResult planned = plan(problem);
  ASSERT_EQ(planned.status, PlanStatus::kFeasible) << planned.reason;
  const World searched(problem, WorldUse::kSearch, 1), verdict(problem, WorldUse::kVerdict, 1);
  RunSchedule schedule(problem.search, problem.limits.margin_min);
  int same = 0;
  while (const auto run = schedule.next(0, 0)) {
    const Candidate own = own_verdict(searched, verdict, *run);
    for (const Candidate& candidate : planned.candidates) {
      if (candidate.seed != run->guidance.seed) continue;
      ++same;
      EXPECT_TRUE(own.verified.passed);
      EXPECT_EQ(own.margin_min, candidate.margin_min);
      EXPECT_EQ(own.duration_s, candidate.duration_s);
      EXPECT_EQ(own.length_m, candidate.length_m);
    }
  }
  EXPECT_EQ(same, static_cast<int>(planned.candidates.size()));
}

INSTANTIATE_TEST_SUITE_P(Both, OwnOmplProgram, testing::Values("RRT", "Lattice"),
                         [](const auto& planner) { return std::string(planner.param); });

/// Remembers what OMPL says.
class Listener : public ompl::msg::OutputHandler {
 public:
  void log(const std::string& /*text*/, ompl::msg::LogLevel /*level*/, const char* /*file*/,
           int /*line*/) override {
    ++count;
  }
  int count = 0;
};

TEST(LibraryUse, ASearchGivesTheLogOfOmplBack) {
  Listener listener;
  ompl::msg::OutputHandler* const before = ompl::msg::getOutputHandler();
  ompl::msg::useOutputHandler(&listener);
  const PlanningProblem problem = across_open_ground("RRT");
  const World world(problem, WorldUse::kSearch, 1);
  search(world, {.planner = "RRT", .guidance = {}, .time_s = {}, .iterations = 50});
  EXPECT_EQ(listener.count, 0);
  EXPECT_EQ(ompl::msg::getOutputHandler(), &listener);
  OMPL_ERROR("heard");
  EXPECT_EQ(listener.count, 1);
  ompl::msg::useOutputHandler(before);
}

TEST(LibraryUse, ASeedGivesTheSameNumbersAgainAndOmplHasNothingToSayOfIt) {
  Listener listener;
  ompl::msg::OutputHandler* const before = ompl::msg::getOutputHandler();
  ompl::msg::useOutputHandler(&listener);
  const PlanningProblem problem = across_open_ground("RRT");
  const World world(problem, WorldUse::kSearch, 1);
  const auto first_number = [&](std::uint64_t seed) {
    const OmplProblem ours(world, {.seed = seed});
    return ompl::RNG().uniform01();
  };
  const double first = first_number(7);
  EXPECT_NE(first_number(8), first);
  EXPECT_EQ(first_number(7), first);
  EXPECT_EQ(listener.count, 0);
  ompl::msg::useOutputHandler(before);
}

TEST(LibraryUse, APlanAmongThreadsIsRefusedWithTheReason) {
  std::mutex mutex;
  std::condition_variable_any told;
  std::jthread other([&](const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    told.wait(lock, stop, [] { return false; });
  });
  try {
    plan(across_open_ground("RRT"));
    FAIL() << "planned among threads";
  } catch (const std::logic_error& refused) {
    EXPECT_NE(std::string(refused.what()).find("the process has 2 threads"), std::string::npos)
        << refused.what();
  }
  other.request_stop();
  other.join();
  EXPECT_NO_THROW(SingleThread());
}

TEST(LibraryUse, NothingThatIsKeptByReferenceBindsToATemporary) {
  using Laws = std::vector<WheelLaw>;
  static_assert(std::is_constructible_v<WheelLaw, const WheelModel&>);
  static_assert(!std::is_constructible_v<WheelLaw, WheelModel>);
  static_assert(std::is_copy_constructible_v<WheelLaw> && std::is_move_constructible_v<WheelLaw>);
  using Ground = VehicleDynamics::Ground;
  static_assert(std::is_constructible_v<VehicleDynamics, Vehicle&, Laws&, Ground, double>);
  static_assert(!std::is_constructible_v<VehicleDynamics, Vehicle, Laws&, Ground, double>);
  static_assert(!std::is_constructible_v<VehicleDynamics, Vehicle&, Laws, Ground, double>);
  static_assert(std::is_constructible_v<MarginJudge, VehicleDynamics&, Laws&, StrainLimits>);
  static_assert(!std::is_constructible_v<MarginJudge, VehicleDynamics, Laws&, StrainLimits>);
  static_assert(!std::is_constructible_v<MarginJudge, VehicleDynamics&, Laws, StrainLimits>);
  static_assert(std::is_constructible_v<GroundFinder, TerrainMap&, Vehicle&>);
  static_assert(!std::is_constructible_v<GroundFinder, TerrainMap, Vehicle&>);
  static_assert(!std::is_constructible_v<GroundFinder, TerrainMap&, Vehicle>);
  static_assert(!std::is_constructible_v<Obstacles, TerrainMap, Vehicle&, double>);
  static_assert(!std::is_constructible_v<Obstacles, TerrainMap&, Vehicle, double>);
  static_assert(!std::is_constructible_v<World, PlanningProblem, WorldUse, int>);
  static_assert(!std::is_constructible_v<OmplProblem, World, SearchGuidance>);
}

}  // namespace
}  // namespace regoplan
