// An OMPL program of one's own: our states, controls, propagation, validity and goal, with OMPL's
// RRT and with our Lattice; the verdict of each path is the one that `plan` would give.
#include <ompl/control/planners/rrt/RRT.h>

#include <cstdio>

#include "level_map.h"

int main() {
  using namespace regoplan;
  const PlanningProblem problem = thirty_metres();
  const World searched(problem, WorldUse::kSearch, 1), verdict(problem, WorldUse::kVerdict, 1);
  for (const char* name : {"RRT of OMPL", "Lattice"}) {
    OmplProblem ours(searched, {.seed = 7, .margin_min = problem.limits.margin_min});
    const auto definition = std::make_shared<ompl::base::ProblemDefinition>(ours.space());
    ours.pose(*definition);
    const ompl::base::PlannerPtr planner = std::string(name) == "Lattice"
                                               ? make_planner("Lattice", ours)
                                               : std::make_shared<ompl::control::RRT>(ours.space());
    planner->setProblemDefinition(definition);
    planner->setup();
    planner->solve(ompl::base::timedPlannerTerminationCondition(30));
    const VerifiedPath path =
        verify(verdict, searched, {.planner = name, .controls = exact_solution(*definition)});
    std::printf(
        "%s: %.1f m, %s\n", name, path.candidate.length_m,
        path.candidate.verified.passed ? "verified" : path.candidate.verified.reason.c_str());
    if (!path.candidate.verified.passed) return 1;
  }
  return 0;
}
