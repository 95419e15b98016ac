#include "planner/ompl/search_run.h"

#include <chrono>
#include <limits>

#include "planner/ompl/iteration_termination.h"
#include "planner/ompl/muted_ompl.h"
#include "planner/ompl/ompl_planners.h"
#include "planner/ompl/ompl_problem.h"

namespace regoplan {

namespace ob = ompl::base;

SearchOutcome search(const World& world, const SearchRun& run) {
  const auto start = std::chrono::steady_clock::now();
  const MutedOmpl muted;
  OmplProblem problem(world, run.guidance);
  const ob::PlannerPtr planner = make_planner(run.planner, problem);
  const auto definition = std::make_shared<ob::ProblemDefinition>(problem.space());
  problem.pose(*definition);
  planner->setProblemDefinition(definition);
  planner->setup();
  ob::IterationTerminationCondition iterations(
      static_cast<unsigned int>(run.iterations.value_or(std::numeric_limits<int>::max())));
  planner->solve(run.iterations ? ob::PlannerTerminationCondition(iterations)
                                : ob::timedPlannerTerminationCondition(*run.time_s));
  return {
      .controls = exact_solution(*definition),
      .rejected = problem.rejections().counts(),
      .rejected_states = problem.rejections().sample(),
      .propagations = problem.propagations(),
      .time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

}  // namespace regoplan
