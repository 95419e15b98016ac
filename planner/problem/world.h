#pragma once

#include <optional>
#include <span>
#include <vector>

#include "maps/ground_finder.h"
#include "planner/problem/known_ground.h"
#include "planner/problem/obstacles.h"
#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"
#include "terramech/force_table/force_table.h"
#include "terramech/margins/margin_judge.h"
#include "terramech/vehicle/vehicle_dynamics.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// How a world answers: fast, as searches need it, or as exactly as a verdict needs it.
enum class WorldUse {
  kSearch,  ///< tabled wheel forces and supply, obstacles enlarged, limits kept with reserve
  kVerdict  ///< exact wheel model, every manoeuvre solved, limits as they are
};

/// What is thought of a state: everything about it, and why it may not be.
struct Judgement {
  TrajectoryPoint point;  ///< without margins (NaN) where the ground is unknown
  std::optional<RejectedState> rejected;
};

/// A vehicle in its map: how it moves, and what it may not do.
class World {
 public:
  /// \param problem must outlive it \param threads that build the tables
  World(const PlanningProblem& problem, WorldUse use, int threads);
  World(PlanningProblem&& gone, WorldUse use, int threads) = delete;
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const PlanningProblem& problem() const { return problem_; }
  const VehicleDynamics& dynamics() const { return dynamics_; }
  const Obstacles& obstacles() const { return obstacles_; }

  /// Demand, supply and margins of a state on known ground.
  StateMargins margins(const VehicleState& state, const GroundPatch& patch) const {
    return judge_.margins(state, patch);
  }
  const MarginJudge& margin_judge() const { return judge_; }

  /// The first reason, in the order of `Rejection`, why a state may not be; nothing where it may.
  /// \param strain of the wheels in the step that led there
  std::optional<RejectedState> rejected(const VehicleState& state,
                                        const WheelStrain& strain) const {
    return rejected(state, strain, problem_.limits.margin_min);
  }
  /// The same with another smallest margin; none leaves traction, tip-over and cornering out.
  std::optional<RejectedState> rejected(const VehicleState& state, const WheelStrain& strain,
                                        std::optional<double> margin_min) const;

  /// `describe` and `rejected` in one, the margins solved once.
  Judgement judge(const VehicleState& state, const WheelStrain& strain, double time_s) const;

  /// The wheel's forces on each soil of the map.
  std::span<const WheelLaw> soil_laws() const { return laws_; }

  /// Everything that decides about a state. \pre it stands on known ground
  TrajectoryPoint describe(const VehicleState& state, const WheelStrain& strain,
                           double time_s) const;

  /// What the soil of a place gives sideways to a vehicle that drives straight on, on level ground,
  /// over its weight, less the least margin; beyond the soils, the most of any soil. Of searches,
  /// which draw their turns by it; 0 where no soil carries the vehicle.
  double lateral_share(double x_m, double y_m) const;

  /// The start of the problem, rolling at its speed.
  VehicleState start() const;
  /// Whether a state lies in the goal's circle, heading as it asks.
  bool within_goal(const VehicleState& state) const;
  /// Whether a state has reached the goal: within it, at rest or no faster than it allows.
  bool at_goal(const VehicleState& state) const;

  /// Search steps: as far as a third of a metre at top speed, and within one elevation cell.
  double search_step_s() const;

  /// What a search keeps in reserve, so that what it finds survives a finer replay: clearance to
  /// obstacles and to the edge of the map, the share of the goal's radius and of each limit that it
  /// uses.
  static constexpr double kSearchClearance_m = 0.1;
  static constexpr double kSearchGoalShare = 0.9;
  static constexpr double kSearchLimitShare = 0.97;

 private:
  double lateral_share_of(int soil) const;
  std::optional<Exceeded> too_fast(const VehicleState& state) const;
  /// Whether the ground ends within the clearance of a search.
  bool beside_the_edge(const VehicleState& state) const;
  TrajectoryPoint point_of(const VehicleState& state, const WheelStrain& strain, double time_s,
                           const GroundPatch& patch, const StateMargins& margins) const;

  const PlanningProblem& problem_;
  WorldUse use_;
  std::vector<WheelModel> models_;  ///< by soil
  /// By soil; of a search, where a table comes near enough to the model.
  std::vector<std::optional<ForceTable>> force_tables_;
  std::vector<WheelLaw> laws_;  ///< by soil, views of what there is
  /// From the vehicle's origin to its farthest corner, a cell of the map and a search's clearance.
  double edge_reach_m_;
  GroundFinder ground_;
  KnownGround known_;
  VehicleDynamics dynamics_;
  MarginJudge judge_;
  std::vector<double> lateral_shares_;  ///< by soil; search only
  Obstacles obstacles_;
};

}  // namespace regoplan
