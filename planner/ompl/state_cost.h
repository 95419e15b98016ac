#pragma once

#include <ompl/base/Planner.h>

#include <string>
#include <vector>

#include "planner/ompl/drive.h"

namespace regoplan {

/// An asymptotically optimal planner made of planners that know nothing of costs (AO-x; Hauser and
/// Zhou 2016): in rounds, each for any path below the cost of the best one so far. A tree of the
/// inner planner grows in state-cost space, where what cannot come to less is no valid state. A
/// round that finds nothing within its share of the work is followed by longer ones, so that every
/// path below the bound that the inner planner can find is found in the end.
///
/// By default the lattice and RRT take turns, the lattice first. With OMPL's random numbers seeded
/// before, deterministic in iterations: those of the inner planners. Progress: `best cost REAL` in
/// the units of the objective, `rounds INTEGER`. Parameter: `inner`, the name of the one planner to
/// drive (not `auto`, nor this one).
class StateCost : public ompl::base::Planner {
 public:
  /// \param problem must outlive it; it is this planner's alone
  explicit StateCost(OmplProblem& problem);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;
  void clear() override;

 private:
  /// \returns whether it found a better path
  bool round(const ompl::base::PlannerTerminationCondition& stop, const std::string& inner,
             unsigned int iterations);

  OmplProblem& problem_;
  bool improves_;
  std::vector<std::string> inner_{"Lattice", "RRT"};
  VehicleSpace::Values start_;
  BestPath best_;
  std::atomic<int> rounds_ = 0;
};

}  // namespace regoplan
