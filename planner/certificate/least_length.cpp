#include "planner/certificate/least_length.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace regoplan {

namespace {
constexpr std::int32_t kNoWay = -1;
}

LeastLength::LeastLength(const PlanningProblem& problem) : goal_(problem.goal) {
  OpenBoxes boxes(problem);
  grid_ = boxes.grid();
  moves_.assign(grid_.count(), kNoWay);
  std::vector<PlaceGrid::Place> edge = boxes.goal_places(), next;
  for (const PlaceGrid::Place& place : edge) moves_[grid_.index(place)] = 0;
  for (std::int32_t moves = 1; !edge.empty(); ++moves) {
    next.clear();
    for (const PlaceGrid::Place& from : edge) {
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          const PlaceGrid::Place to{from.column + dc, from.row + dr};
          if (!grid_.inside(to)) continue;
          std::int32_t& known = moves_[grid_.index(to)];
          if (known != kNoWay || boxes.open(to) == 0) continue;
          known = moves;
          next.push_back(to);
        }
      }
    }
    edge.swap(next);
  }
}

double LeastLength::to_goal_m(double x_m, double y_m) const {
  const std::int32_t moves = moves_[grid_.index(grid_.at(x_m, y_m))];
  if (moves == kNoWay) return std::numeric_limits<double>::infinity();
  const double straight_m = std::hypot(x_m - goal_.x_m, y_m - goal_.y_m) - goal_.radius_m;
  return std::max({0.0, straight_m, (moves - 2) * grid_.cell_m});
}

}  // namespace regoplan
