#pragma once

#include <ompl/base/Planner.h>

#include <atomic>
#include <limits>
#include <vector>

#include "planner/ompl/ompl_problem.h"

namespace regoplan {

/// Steps of a search under one control.
struct Drive {
  VehicleControl control;
  int steps = 0;
};

/// A node of a tree of drives.
struct DriveNode {
  static constexpr int kRoot = -1;

  VehicleSpace::Values values;
  double cost = 0;  ///< of the whole way from the root
  int parent = kRoot;
  Drive drive{};  ///< from the parent
};

/// From the root to a node.
std::vector<Drive> drives_to(const std::vector<DriveNode>& nodes, int node);

/// The same, as replays take them, and back again.
std::vector<ControlSegment> controls_of(const std::vector<Drive>& drives, double step_s);
std::vector<Drive> drives_of(const std::vector<ControlSegment>& controls, double step_s);

/// The best path that a planner has found so far. Its cost may be read while the planner runs.
class BestPath {
 public:
  void clear();
  /// \returns whether it is better than what there was
  bool offer(double cost, std::vector<Drive> drives);

  bool found() const { return !drives_.empty(); }
  double cost() const { return cost_; }  ///< infinite where there is none
  const std::vector<Drive>& drives() const { return drives_; }

 private:
  std::atomic<double> cost_ = std::numeric_limits<double>::infinity();
  std::vector<Drive> drives_;
};

/// Tells who listens to intermediate solutions. \param start the root
void announce(const ompl::base::Planner& planner, const OmplProblem& problem,
              const VehicleSpace::Values& start, const BestPath& best);

/// Enters the best path in the planner's problem definition.
void enter_solution(const ompl::base::Planner& planner, const OmplProblem& problem,
                    const VehicleSpace::Values& start, const BestPath& best);

}  // namespace regoplan
