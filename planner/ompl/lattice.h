#pragma once

#include <ompl/base/Planner.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <vector>

#include "planner/ompl/drive.h"
#include "planner/ompl/lattice_edges.h"

namespace regoplan {

/// Weighted A* over drives of the vehicle's own dynamics (hybrid A*; Dolgov et al. 2010), states
/// that fall into one cell of place, heading and speed counting as one. Drives are tried lazily
/// (Cohen, Phillips, Likhachev 2014): the queue holds rough ends, and only the most promising drive
/// is propagated, exactly, step by step, the goal tested at each; one whose rough end another drive
/// has reached for less is dropped. From every node near the goal it is tried to arrive
/// (`arrival_from`). Rounds with growing bounds go through finer resolutions and
/// driving in reverse until a path is found; then, where the problem asks to improve, through
/// smaller weights, each round pruned against the best cost so far. Rounds with reverse also try,
/// from slow nodes near a goal with a heading, the shortest way to its pose (`connection_to_goal`).
/// Deterministic; draws nothing.
///
/// An iteration is one drive taken from the queue. Progress: `best cost REAL`, in the units of the
/// objective.
class Lattice : public ompl::base::Planner {
 public:
  /// \param problem must outlive it
  explicit Lattice(OmplProblem& problem);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;
  void clear() override;

 private:
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();

  enum class RoundEnd { kFound, kExhausted, kBoundReached, kStopped };

  struct Entry {
    double priority = 0;
    std::uint32_t order = 0;
    int node = 0;
    std::optional<Drive> drive;  ///< to be driven from the node; nothing: the node itself is due
    double cost = 0;             ///< roughly, at the drive's end
    std::uint64_t cell = 0;      ///< of the rough end
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      // Of equals the youngest, which is the deepest.
      return a.priority != b.priority ? a.priority > b.priority : a.order < b.order;
    }
  };
  struct Cell {
    double cost = 0;
    bool closed = false;
  };

  /// One round: how it looks, how greedily, and how far it has come. It can be gone on with.
  struct Round {
    LatticeResolution resolution;
    double weight = 1;
    std::vector<DriveNode> nodes{};
    std::unordered_map<std::uint64_t, Cell> cells{};
    std::priority_queue<Entry, std::vector<Entry>, Later> open{};
    std::uint32_t pushed = 0;
    int near_goal = 0;          ///< nodes from which the goal's pose might have been tried
    double nearest = kNoBound;  ///< the smallest rough cost from a node to the goal
  };

  /// Begins a round, or goes on with it. \param drives that it may try
  RoundEnd search(Round& round, int drives, const ompl::base::PlannerTerminationCondition& stop);
  void search_for_first(const ompl::base::PlannerTerminationCondition& stop);
  void improve(const ompl::base::PlannerTerminationCondition& stop);
  void expand(Round& round, int node);
  /// Tries the way from a slow node straight to the pose of the goal. \returns whether it leads
  /// there for less
  bool connect(Round& round, int node);
  /// Ends a path from a node. \returns whether it arrives at the goal for less
  bool arrive_from(const Round& round, int node);
  /// Drives it and keeps what it leads to. \returns whether that is the goal
  bool try_drive(Round& round, int node, const Drive& drive);
  void push(Round& round, double cost, const VehicleState& state, int node,
            const std::optional<Drive>& drive);
  /// Whether a cell has been reached for no more.
  static bool covered(const Round& round, std::uint64_t cell, double cost);
  bool hopeless(double cost, const VehicleState& state) const {
    return problem_.hopeless(cost, state, bound_);
  }
  /// A round's path. \returns whether it is cheaper than all of them so far
  bool arrive(double cost, std::vector<Drive> drives);
  /// Optimises the best path of a round.
  void optimise();

  OmplProblem& problem_;
  std::vector<VehicleSpace::Values> starts_;
  double bound_ = kNoBound;   ///< the cost of the cheapest path of a round
  std::vector<Drive> found_;  ///< that path
  BestPath best_;             ///< of all, the optimised too
};

}  // namespace regoplan
