#pragma once

#include <atomic>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "planner/ompl/drive.h"
#include "planner/ompl/lattice_edges.h"

namespace regoplan {

/// A tree of drives that keeps one active node a witness: of the states that fall into one cell of
/// place, heading and speed, the one with the least cost from the root. Others stay only while
/// active nodes descend from them, so the active nodes never outnumber the witnesses, and what was
/// pruned is given back.
class SparseTree {
 public:
  /// \param problem must outlive it
  explicit SparseTree(const PlanningProblem& problem);

  void clear();
  void plant(const VehicleSpace::Values& root);

  /// Whether a state of this cost would become the best of its witness.
  bool welcome(const VehicleState& state, double cost) const;
  /// \pre `welcome` \returns the node
  int grow(DriveNode node);
  /// Takes active nodes that have no hope away. \param hopeless of (cost, state)
  template <class Hopeless>
  void prune(Hopeless hopeless);

  /// Of the active nodes near a place (those of the nearest ring of a grid that holds any): the
  /// cheapest within a small distance of the state, else the nearest. \pre not empty
  int select(const VehicleState& near) const;

  const std::vector<DriveNode>& nodes() const { return nodes_; }
  bool empty() const { return active_ == 0; }
  std::size_t active() const { return active_; }      ///< may be read while another thread grows
  std::size_t inactive() const { return inactive_; }  ///< the same
  std::size_t witnesses() const { return witness_count_; }  ///< the same

 private:
  static constexpr int kNone = -1;
  struct Status {
    std::uint64_t cell = 0;  ///< of the witness
    int children = 0;
    int bucket = kNone;     ///< that it stands in, while active
    std::size_t place = 0;  ///< in the bucket
    bool in_use = false;
  };

  int bucket_of(const VehicleState& state) const;
  double distance_m(const VehicleState& a, const VehicleState& b) const;
  void deactivate(int node);
  void remove_dead_branch(int node);

  const PlanningProblem& problem_;
  LatticeResolution witness_size_;
  double bucket_m_;
  double near_m_;
  int columns_, rows_;
  std::vector<std::vector<int>> buckets_;
  std::vector<DriveNode> nodes_;
  std::vector<Status> status_;
  std::vector<int> free_;
  std::unordered_map<std::uint64_t, int> witnesses_;  ///< to the active node, or none
  std::atomic<std::size_t> active_ = 0, inactive_ = 0, witness_count_ = 0;
};

template <class Hopeless>
void SparseTree::prune(Hopeless hopeless) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (status_[i].in_use && status_[i].bucket != kNone && nodes_[i].parent != DriveNode::kRoot &&
        hopeless(nodes_[i].cost, nodes_[i].values.vehicle)) {
      deactivate(static_cast<int>(i));
    }
  }
}

}  // namespace regoplan
