#pragma once

#include <ompl/base/Planner.h>
#include <ompl/util/RandomNumbers.h>

#include <vector>

#include "planner/ompl/sparse_tree.h"

namespace regoplan {

/// Stable sparse tree (SST; Li, Littlefield, Bekris 2016): grows from the cheapest node near a
/// drawn state by a drawn drive, and keeps the cheapest node of each witness. Half of the drives
/// follow the cheapest way of `CostToGo`. Each node carries the cost of the whole path to it, by
/// the problem's objective; what cannot come to less than the best path is pruned. The goal is
/// tested at every step, and from every new node near it, it is tried to arrive (`arrival_from`).
/// It owns its random numbers: the same seed gives the same tree.
///
/// An iteration is one drive. Progress: `best cost REAL` in the units of the objective, `nodes
/// INTEGER` (active), `inactive nodes INTEGER` (kept for what descends from them), `witnesses
/// INTEGER`.
class StableSparse : public ompl::base::Planner {
 public:
  /// \param problem must outlive it
  explicit StableSparse(OmplProblem& problem);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;
  void clear() override;

  const SparseTree& tree() const { return tree_; }

 private:
  bool hopeless(double cost, const VehicleState& state) const;
  VehicleState drawn_state();
  Drive drawn_drive(const VehicleState& from, const VehicleState& toward);
  /// Ends a path from the end of a node's drive. \returns whether it arrives at the goal for less
  bool arrive_from(const DriveNode& node);
  /// Grows a node from another. \returns whether it is a better way to the goal
  bool extend(int node, const Drive& drive);

  OmplProblem& problem_;
  SparseTree tree_;
  ompl::RNG random_;
  VehicleSpace::Values start_;
  BestPath best_;
};

}  // namespace regoplan
