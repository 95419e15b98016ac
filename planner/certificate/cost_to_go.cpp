#include "planner/certificate/cost_to_go.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <random>

#include "planner/certificate/room_to_pass.h"
#include "planner/problem/world.h"

namespace regoplan {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
// Times the length: rather around what cannot be passed, by the side of what hardly can.
constexpr double kAcrossObstacle = 100, kNarrow = 4;
constexpr double kFinest_m = 1;  // cells

/// Smooth noise from 0 to 1: random values on a coarse lattice, bilinear between.
class SmoothVariety {
 public:
  SmoothVariety(double width_m, double height_m, std::uint64_t seed)
      : columns_(static_cast<std::size_t>(width_m / kSpacing_m) + 2) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    values_.resize(columns_ * (static_cast<std::size_t>(height_m / kSpacing_m) + 2));
    for (double& value : values_) value = unit(random);
  }
  double at(double x_m, double y_m) const {
    const double u = x_m / kSpacing_m, v = y_m / kSpacing_m;
    const auto c = static_cast<std::size_t>(u), r = static_cast<std::size_t>(v);
    const double* cell = values_.data() + r * columns_ + c;
    const double s = u - static_cast<double>(c), t = v - static_cast<double>(r);
    return std::lerp(std::lerp(cell[0], cell[1], s),
                     std::lerp(cell[columns_], cell[columns_ + 1], s), t);
  }

 private:
  static constexpr double kSpacing_m = 20;
  std::size_t columns_;
  std::vector<double> values_;
};

}  // namespace

CostToGo::CostToGo(const PlanningProblem& problem,
                   const std::vector<std::optional<double>>& climbs_rad, double variety,
                   std::uint64_t seed)
    : goal_{problem.goal.x_m, problem.goal.y_m} {
  const GridFrame& frame = problem.map.elevation().frame;
  const double width = frame.east_m() - frame.west_m, height = frame.north_m - frame.south_m();
  constexpr double kMostCells = 512;
  west_m_ = frame.west_m;
  south_m_ = frame.south_m();
  cell_m_ = std::max(kFinest_m, std::max(width, height) / kMostCells);
  columns_ = std::max(1, static_cast<int>(std::ceil(width / cell_m_)));
  rows_ = std::max(1, static_cast<int>(std::ceil(height / cell_m_)));
  const SmoothVariety noise(columns_ * cell_m_, rows_ * cell_m_, seed);
  const std::vector<double> narrow = settle(problem);
  std::vector<double> dear = dearness(problem, climbs_rad);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Place at = centre({column, row});
      double& value = dear[index({column, row})];
      value = std::min(value + narrow[index({column, row})], std::max(value, kAcrossObstacle)) +
              variety * noise.at(at.x_m - west_m_, at.y_m - south_m_);
    }
  }
  spread(dear);
}

CostToGo::Cell CostToGo::cell_at(double x_m, double y_m) const {
  return {std::clamp(static_cast<int>((x_m - west_m_) / cell_m_), 0, columns_ - 1),
          std::clamp(static_cast<int>((y_m - south_m_) / cell_m_), 0, rows_ - 1)};
}

CostToGo::Place CostToGo::centre(const Cell& cell) const {
  return {west_m_ + (cell.column + 0.5) * cell_m_, south_m_ + (cell.row + 0.5) * cell_m_};
}

std::vector<double> CostToGo::settle(const PlanningProblem& problem) {
  // Places of coarse cells are too far apart to tell what lies between them.
  const double needed_m = World::kSearchClearance_m + (cell_m_ - kFinest_m) / 2;
  RoomToPass room(problem);
  std::vector<double> narrow(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  places_.resize(narrow.size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Place middle = centre({column, row});
      const RoomToPass::Place at = room.roomiest(middle.x_m, middle.y_m, cell_m_ / 2);
      places_[index({column, row})] = {at.x_m, at.y_m};
      const double share = (at.room_m - needed_m) / (RoomToPass::kPlenty_m - needed_m);
      narrow[index({column, row})] =
          at.room_m < needed_m ? kAcrossObstacle : kNarrow * std::max(0.0, 1 - share);
    }
  }
  return narrow;
}

std::vector<double> CostToGo::dearness(const PlanningProblem& problem,
                                       const std::vector<std::optional<double>>& climbs_rad) const {
  const TerrainMap& map = problem.map;
  const BodyBox& body = problem.vehicle.body;
  // Slopes at the vehicle's own scale.
  const double span = std::max({body.y_max_m, -body.y_min_m, cell_m_});
  std::vector<double> dear(places_.size(), kFar);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& at = places_[i];
    const double across = map.height_m(at.x_m + span, at.y_m) - map.height_m(at.x_m - span, at.y_m);
    const double along = map.height_m(at.x_m, at.y_m + span) - map.height_m(at.x_m, at.y_m - span);
    const double slope = std::atan(std::hypot(across, along) / (2 * span));
    const std::optional<int> soil = map.soil_index(at.x_m, at.y_m);
    if (std::isnan(slope) || !soil) continue;
    const std::optional<double>& climb = climbs_rad[static_cast<std::size_t>(*soil)];
    // Down it may go where it cannot climb.
    const double allowed = problem.limits.slope_max_rad;
    if (!climb || slope > allowed) {
      dear[i] = kAcrossObstacle;
      continue;
    }
    constexpr double kLeastShare = 0.05;
    const double steepness = slope / std::max(*climb, kLeastShare * allowed);
    dear[i] = std::min(1 + 3 * steepness * steepness, kAcrossObstacle);
  }
  return dear;
}

void CostToGo::spread(const std::vector<double>& dearness) {
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost_m_.assign(dearness.size(), kFar);
  next_.resize(dearness.size());
  std::iota(next_.begin(), next_.end(), 0U);
  const std::size_t goal = index(cell_at(goal_.x_m, goal_.y_m));
  cost_m_[goal] = 0;
  open.emplace(0, goal);
  while (!open.empty()) {
    const auto [cost, at] = open.top();
    open.pop();
    if (cost > cost_m_[at]) continue;
    const int column = static_cast<int>(at % static_cast<std::size_t>(columns_));
    const int row = static_cast<int>(at / static_cast<std::size_t>(columns_));
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        const Cell next{column + dc, row + dr};
        if ((dr == 0 && dc == 0) || next.column < 0 || next.column >= columns_ || next.row < 0 ||
            next.row >= rows_) {
          continue;
        }
        const std::size_t i = index(next);
        const double there = cost + cell_m_ * std::hypot(dr, dc) * (dearness[at] + dearness[i]) / 2;
        if (there < cost_m_[i]) {
          cost_m_[i] = there;
          next_[i] = static_cast<std::uint32_t>(at);
          open.emplace(there, i);
        }
      }
    }
  }
}

CostToGo::Place CostToGo::ahead(double x_m, double y_m, double distance_m) const {
  std::size_t at = index(cell_at(x_m, y_m));
  const std::size_t goal = index(cell_at(goal_.x_m, goal_.y_m));
  const auto columns = static_cast<std::size_t>(columns_);
  double travelled = 0;
  while (travelled < distance_m && at != goal) {
    const std::size_t next = next_[at];
    if (next == at) break;  // the goal cannot be reached from here
    const bool diagonal = next % columns != at % columns && next / columns != at / columns;
    travelled += diagonal ? cell_m_ * std::numbers::sqrt2 : cell_m_;
    at = next;
  }
  if (at == goal) return goal_;
  return places_[at];
}

double CostToGo::cost_m(double x_m, double y_m) const {
  const Cell own = cell_at(x_m, y_m);
  const double own_cost = cost_m_[index(own)];
  const double u = (x_m - west_m_) / cell_m_ - 0.5, v = (y_m - south_m_) / cell_m_ - 0.5;
  const Cell corner{static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v))};
  if (corner.column < 0 || corner.row < 0 || corner.column + 1 >= columns_ ||
      corner.row + 1 >= rows_) {
    return own_cost;
  }
  const double* south = cost_m_.data() + index(corner);
  const double* north = south + columns_;
  const double across = u - corner.column, up = v - corner.row;
  const double cost =
      std::lerp(std::lerp(south[0], south[1], across), std::lerp(north[0], north[1], across), up);
  return std::isfinite(cost) ? cost : own_cost;
}

}  // namespace regoplan
