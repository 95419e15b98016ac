#include "planner/ompl/sparse_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace regoplan {

SparseTree::SparseTree(const PlanningProblem& problem) : problem_(problem) {
  const double radius_m = 1 / problem.vehicle.curvature_max_1pm;
  witness_size_ = {
      .cell_m = radius_m / 2, .headings = 16, .speeds = 3, .speed_max_mps = problem.speed_max_mps};
  bucket_m_ = 2 * radius_m;
  near_m_ = 2 * radius_m;
  const GridFrame& frame = problem.map.elevation().frame;
  const auto cells = [&](double extent_m) {
    return std::max(1, static_cast<int>(std::ceil(extent_m / bucket_m_)));
  };
  columns_ = cells(frame.east_m() - frame.west_m);
  rows_ = cells(frame.north_m - frame.south_m());
  clear();
}

void SparseTree::clear() {
  buckets_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), {});
  nodes_.clear();
  status_.clear();
  free_.clear();
  witnesses_.clear();
  active_ = inactive_ = witness_count_ = 0;
}

void SparseTree::plant(const VehicleSpace::Values& root) {
  if (welcome(root.vehicle, 0)) grow({.values = root});
}

bool SparseTree::welcome(const VehicleState& state, double cost) const {
  const auto witness = witnesses_.find(lattice_cell(witness_size_, problem_, state));
  return witness == witnesses_.end() || witness->second == kNone ||
         cost < nodes_[static_cast<std::size_t>(witness->second)].cost;
}

int SparseTree::grow(DriveNode node) {
  const std::uint64_t cell = lattice_cell(witness_size_, problem_, node.values.vehicle);
  const int bucket = bucket_of(node.values.vehicle);
  if (node.parent != DriveNode::kRoot) ++status_[static_cast<std::size_t>(node.parent)].children;
  if (free_.empty()) {
    free_.push_back(static_cast<int>(nodes_.size()));
    nodes_.emplace_back();
    status_.emplace_back();
  }
  const int number = free_.back();
  free_.pop_back();
  std::vector<int>& there = buckets_[static_cast<std::size_t>(bucket)];
  nodes_[static_cast<std::size_t>(number)] = node;
  status_[static_cast<std::size_t>(number)] = {
      .cell = cell, .bucket = bucket, .place = there.size(), .in_use = true};
  there.push_back(number);
  ++active_;
  const auto [witness, is_new] = witnesses_.try_emplace(cell, kNone);
  const int before = witness->second;
  witness->second = number;
  witness_count_ = witnesses_.size();
  // Last: what it takes away may be an ancestor's only other branch, never one of the new node.
  if (!is_new && before != kNone) deactivate(before);
  return number;
}

void SparseTree::deactivate(int node) {
  Status& status = status_[static_cast<std::size_t>(node)];
  std::vector<int>& bucket = buckets_[static_cast<std::size_t>(status.bucket)];
  bucket[status.place] = bucket.back();
  status_[static_cast<std::size_t>(bucket.back())].place = status.place;
  bucket.pop_back();
  status.bucket = kNone;
  const auto witness = witnesses_.find(status.cell);
  if (witness->second == node) witness->second = kNone;
  --active_;
  ++inactive_;
  remove_dead_branch(node);
}

void SparseTree::remove_dead_branch(int node) {
  for (int at = node; at != DriveNode::kRoot;) {
    Status& status = status_[static_cast<std::size_t>(at)];
    if (status.children > 0 || status.bucket != kNone) return;
    const int parent = nodes_[static_cast<std::size_t>(at)].parent;
    status.in_use = false;
    free_.push_back(at);
    --inactive_;
    if (parent != DriveNode::kRoot) --status_[static_cast<std::size_t>(parent)].children;
    at = parent;
  }
}

int SparseTree::bucket_of(const VehicleState& state) const {
  const GridFrame& frame = problem_.map.elevation().frame;
  // Clamped before it is an integer: samples of a wide goal may lie farther off than integers
  // reach.
  const auto nearest = [this](double offset_m, int count) {
    return static_cast<int>(std::clamp(offset_m / bucket_m_, 0.0, count - 1.0));
  };
  return nearest(state.y_m - frame.south_m(), rows_) * columns_ +
         nearest(state.x_m - frame.west_m, columns_);
}

double SparseTree::distance_m(const VehicleState& a, const VehicleState& b) const {
  // The metric of `VehicleSpace`.
  const double turn = std::abs(std::remainder(a.yaw_rad - b.yaw_rad, 2 * std::numbers::pi));
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) + turn / problem_.vehicle.curvature_max_1pm +
         std::abs(a.motion.vx_mps - b.motion.vx_mps) / problem_.speed_max_mps;
}

int SparseTree::select(const VehicleState& near) const {
  const int centre = bucket_of(near);
  const int column = centre % columns_, row = centre / columns_;
  int cheapest = kNone, nearest = kNone;
  double least = std::numeric_limits<double>::infinity(), shortest = least;
  const auto consider = [&](int c, int r) {
    if (c < 0 || c >= columns_ || r < 0 || r >= rows_) return;
    const int bucket = r * columns_ + c;
    for (const int node : buckets_[static_cast<std::size_t>(bucket)]) {
      const DriveNode& known = nodes_[static_cast<std::size_t>(node)];
      const double away = distance_m(known.values.vehicle, near);
      if (away < shortest) {
        shortest = away;
        nearest = node;
      }
      if (away < near_m_ && known.cost < least) {
        least = known.cost;
        cheapest = node;
      }
    }
  };
  for (int ring = 0; nearest == kNone && ring < std::max(columns_, rows_); ++ring) {
    for (int i = -ring; i <= ring; ++i) {
      consider(column + i, row - ring);
      if (ring > 0) consider(column + i, row + ring);
      if (std::abs(i) < ring) {
        consider(column - ring, row + i);
        consider(column + ring, row + i);
      }
    }
  }
  return cheapest != kNone ? cheapest : nearest;
}

}  // namespace regoplan
