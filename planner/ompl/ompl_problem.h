#pragma once

#include <ompl/base/ProblemDefinition.h>
#include <ompl/control/SpaceInformation.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "planner/certificate/cost_to_go.h"
#include "planner/certificate/least_length.h"
#include "planner/ompl/arrival.h"
#include "planner/ompl/search_run.h"
#include "planner/ompl/search_steps.h"
#include "planner/ompl/vehicle_space.h"
#include "planner/problem/world.h"

namespace regoplan {

/// A planning problem as OMPL sees it: states, controls, propagation by the vehicle's dynamics,
/// validity by the world's judgement, the goal in metres. One planner run uses it at a time; what
/// it counts is of that run.
class OmplProblem {
 public:
  /// Seeds what OMPL draws from here on, in the whole process.
  /// \param world must outlive it
  OmplProblem(const World& world, const SearchGuidance& guidance);
  OmplProblem(World&& gone, const SearchGuidance& guidance) = delete;
  OmplProblem(const OmplProblem&) = delete;
  OmplProblem& operator=(const OmplProblem&) = delete;

  const World& world() const { return world_; }
  const CostToGo& way() const { return way_; }
  const ompl::control::SpaceInformationPtr& space() const { return space_; }

  /// Sets start, goal and objective.
  void pose(ompl::base::ProblemDefinition& definition);

  /// Of the map, metres.
  double diagonal_m() const;

  /// For planners that own their random numbers.
  std::uint_fast32_t seed() const { return seed_; }

  /// Whether a search goes on for a better path once it has one.
  bool improves() const { return improves_; }

  /// For a planner that drives others: from here on any path below a cost will do, and the cost is
  /// a coordinate of states. The next planner is to be made after this, and draws anew.
  void accept_first_below(double cost);

  /// Whether a path through a state, reached at a cost, can come to less than what is asked for
  /// and than another path's cost.
  bool hopeless(double cost, const VehicleState& state, double best_cost) const;

  /// Of every propagation; controls last whole multiples of it.
  double step_s() const { return space_->getPropagationStepSize(); }

  /// Whether and how a path through a state arrives at the goal (`arrival_from`), for less than is
  /// asked for and than a cost.
  Arrival arrival(const VehicleSpace::Values& from, double cost, double best_cost);

  SearchSteps& steps() { return steps_; }
  std::int64_t propagations() const { return steps_.count(); }
  const RejectionLog& rejections() const { return steps_.rejections(); }

 private:
  const World& world_;
  CostToGo way_;
  SearchSteps steps_;
  std::uint_fast32_t seed_;
  bool improves_;
  double cost_below_ = std::numeric_limits<double>::infinity();
  mutable std::optional<LeastLength> least_length_;  ///< once there is a path to beat
  std::shared_ptr<VehicleSpace> states_;
  ompl::control::SpaceInformationPtr space_;
};

/// The controls of the solution, arrival at the goal included; empty where there is none that
/// reaches it.
std::vector<ControlSegment> exact_solution(const ompl::base::ProblemDefinition& definition);

}  // namespace regoplan
