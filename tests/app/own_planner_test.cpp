// A planner of somebody else's in a suite, from a program of theirs.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ompl/control/PathControl.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/app.h"
#include "tests/app/flat_map.h"

namespace regoplan {
namespace {

struct Answer {
  int status = -1;
  std::string errors;
};

class OwnPlanner : public testing::Test {
 protected:
  Answer run(const std::string& planners, const OwnPlanners& own) {
    const std::string suite = folder_.write(
        "suite.yaml",
        fmt::format("name: own\nscenarios: [scenario.yaml]\nplanners: [{}]\nseeds: 2\ntime_s: 30\n"
                    "iterations: 60\nsoil_draws: 2\n",
                    planners));
    std::filesystem::remove_all(folder_.path("out"));
    const std::string out = folder_.path("out");
    const std::array<const char*, 5> arguments{"mine", suite.c_str(), "--out", out.c_str(),
                                               "--quiet"};
    testing::internal::CaptureStderr();
    const int status = benchmark_main(static_cast<int>(arguments.size()), arguments.data(), own);
    return {.status = status, .errors = testing::internal::GetCapturedStderr()};
  }

  /// By planner and seed, without what depends on the clock or the allocator.
  std::map<std::string, nlohmann::json> outcomes() const {
    std::istringstream lines(folder_.read("out/runs.jsonl"));
    std::map<std::string, nlohmann::json> all;
    for (std::string line; std::getline(lines, line);) {
      const nlohmann::json json = nlohmann::json::parse(line);
      if (json.contains("origin")) continue;
      nlohmann::json properties = json.at("properties");
      properties.erase("time REAL");
      properties.erase("memory REAL");
      all[fmt::format("{} {}", json.at("planner").get<std::string>(), json.at("seed").get<int>())] =
          properties;
    }
    return all;
  }

  ScratchFolder folder_;
  std::string scenario_ = write_flat_scenario(folder_);
};

const OwnPlanners& rrt_as_mine() {
  static const OwnPlanners own{
      {"Mine", [](OmplProblem& problem) { return make_planner("RRT", problem); }}};
  return own;
}

TEST_F(OwnPlanner, IsMeasuredAsOursAre) {
  const Answer answer =
      run("RRT, Mine, {name: greedy, planner: Mine, parameters: {goal_bias: 0.5}}", rrt_as_mine());
  ASSERT_EQ(answer.status, 0) << answer.errors;
  const auto all = outcomes();
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(all.at("Mine 1"), all.at("RRT 1"));
  EXPECT_EQ(all.at("Mine 2"), all.at("RRT 2"));
  EXPECT_NE(all.at("greedy 1"), all.at("RRT 1"));
}

/// Fails in `solve` as it is told to.
class Failing : public ompl::base::Planner {
 public:
  Failing(const OmplProblem& problem, bool lies)
      : ompl::base::Planner(problem.space(), "Failing"), space_(problem.space()), lies_(lies) {}
  ompl::base::PlannerStatus solve(
      const ompl::base::PlannerTerminationCondition& /*stop*/) override {
    if (!lies_) throw std::logic_error("out of its depth");
    auto path = std::make_shared<ompl::control::PathControl>(space_);
    path->append(pdef_->getStartState(0));
    pdef_->addSolutionPath(path, /*approximate=*/false, 0, getName());
    return ompl::base::PlannerStatus::EXACT_SOLUTION;
  }

 private:
  ompl::control::SpaceInformationPtr space_;
  bool lies_;
};

TEST_F(OwnPlanner, ThatThrowsIsCrashedAndOneThatLiesIsOverturned) {
  const auto failing = [](bool lies) {
    return [lies](OmplProblem& problem) { return std::make_shared<Failing>(problem, lies); };
  };
  const Answer answer =
      run("Thrower, Liar", {{"Thrower", failing(false)}, {"Liar", failing(true)}});
  ASSERT_EQ(answer.status, 0) << answer.errors;
  EXPECT_EQ(outcomes().at("Thrower 1").at("failure STRING"), "out of its depth");
  const nlohmann::json whole = nlohmann::json::parse(folder_.read("out/benchmark.json"));
  for (const nlohmann::json& planner : whole.at("experiments").at(0).at("planners")) {
    const bool lies = planner.at("planner") == "Liar";
    EXPECT_EQ(planner.at("verified"), 0);
    EXPECT_EQ(planner.at("overturned"), lies ? 2 : 0);
    EXPECT_EQ(planner.at("crashed"), lies ? 0 : 2);
  }
}

TEST_F(OwnPlanner, IsRefusedWithItsPlaceWhereItCannotBeMade) {
  const auto refused = [&](const std::string& planners, const OwnPlanners& own,
                           const std::string& words) {
    const Answer answer = run(planners, own);
    EXPECT_EQ(answer.status, 1);
    EXPECT_NE(answer.errors.find(words), std::string::npos) << answer.errors;
  };
  refused("Other", rrt_as_mine(),
          "suite.yaml:3: planners[0]: Other is not valid (allowed: Lattice");
  refused("Other", rrt_as_mine(), "| Mine)");
  refused("Mine", {{"Mine", [](OmplProblem&) { return nullptr; }}},
          "suite.yaml:3: planners[0]: Mine: its maker gives no planner");
  refused("RRT", {{"Mine", {}}}, "Mine: no function that makes it");
  refused("RRT", {{"RRT", rrt_as_mine().at("Mine")}}, "RRT: a planner of regoplan has this name");
  refused("RRT", {{"my planner", rrt_as_mine().at("Mine")}}, "is no name of a planner");
  refused("{planner: Mine, parameters: {bias: 1}}", rrt_as_mine(),
          "suite.yaml:3: planners[0]: Mine: parameter bias is not known");
}

}  // namespace
}  // namespace regoplan
