#pragma once

#include <ompl/base/ProblemDefinition.h>
#include <ompl/util/Console.h>

#include <memory>
#include <string>
#include <vector>

#include "planner/ompl/iteration_termination.h"
#include "planner/ompl/ompl_planners.h"
#include "planner/ompl/ompl_problem.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {

/// One planner on one problem, kept apart from all others.
class PlannerRun {
 public:
  PlannerRun(const World& world, const std::string& planner, bool improve = false,
             std::uint64_t seed = 1, double variety = 0)
      : problem(world, {.seed = seed,
                        .margin_min = world.problem().limits.margin_min,
                        .variety = variety,
                        .improve = improve}),
        definition(std::make_shared<ompl::base::ProblemDefinition>(problem.space())),
        planner_(make_planner(planner, problem)) {
    ompl::msg::noOutputHandler();
    problem.pose(*definition);
    definition->setIntermediateSolutionCallback(
        [this](const ompl::base::Planner*, const std::vector<const ompl::base::State*>& states,
               const ompl::base::Cost cost) {
          announced_costs.push_back(cost.value());
          announced_states = states.size();
        });
    planner_->setProblemDefinition(definition);
    planner_->setup();
  }

  ompl::base::PlannerStatus solve(unsigned int iterations) {
    ompl::base::IterationTerminationCondition bound(iterations);
    return planner_->solve(bound);
  }
  template <class Planner>
  const Planner& planner_as() const {
    return dynamic_cast<const Planner&>(*planner_);
  }
  ompl::base::Planner& planner() { return *planner_; }
  double duration_s() const {
    double sum = 0;
    for (const ControlSegment& segment : exact_solution(*definition)) sum += segment.duration_s;
    return sum;
  }
  /// What a progress property reads.
  std::string progress(const std::string& name) const {
    return planner_->getPlannerProgressProperties().at(name)();
  }

  OmplProblem problem;
  ompl::base::ProblemDefinitionPtr definition;
  std::vector<double> announced_costs;
  std::size_t announced_states = 0;

 private:
  ompl::base::PlannerPtr planner_;
};

/// Rocks in two staggered rows, with gaps.
inline std::vector<Rock> two_rows_of_rocks() {
  std::vector<Rock> rocks;
  for (double y = 3; y < 50; y += 2) {
    if (y < 30 || y > 36) rocks.push_back({20, y, 0.8, 2});
    if (y < 12 || y > 18) rocks.push_back({32, y, 0.8, 2});
  }
  return rocks;
}

/// The goal's own ground, closed off.
inline std::vector<Rock> ring_of_rocks(double x_m, double y_m, double radius_m) {
  std::vector<Rock> rocks;
  constexpr int kCount = 40;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCount;
    rocks.push_back({x_m + radius_m * std::cos(angle), y_m + radius_m * std::sin(angle), 0.8, 2});
  }
  return rocks;
}

}  // namespace regoplan
