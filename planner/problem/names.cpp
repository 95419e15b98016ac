// The words under which the planner's enumerations stand in files.
#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

std::string_view name(MarginKind kind) {
  switch (kind) {
    case MarginKind::kCornering:
      return "cornering";
    case MarginKind::kTipOver:
      return "tip_over";
    case MarginKind::kTraction:
      return "traction";
  }
  return "";
}

std::string_view name(PlanStatus status) {
  switch (status) {
    case PlanStatus::kFeasible:
      return "feasible";
    case PlanStatus::kInfeasible:
      return "infeasible";
    case PlanStatus::kUndecided:
      return "undecided";
  }
  return "";
}

const std::vector<std::string>& planner_names() {
  static const std::vector<std::string> names{"auto", "Lattice",   "StableSparse", "StateCost",
                                              "SST",  "RRT",       "KPIECE1",      "EST",
                                              "PDST", "SyclopRRT", "SyclopEST"};
  return names;
}

}  // namespace regoplan
