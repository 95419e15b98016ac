#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Rough cost of the way from everywhere to the goal, by Dijkstra's algorithm over a grid of about
/// a metre: length, dearer on slopes that the soil hardly lets it climb, in narrow places, and most
/// of all where it can neither climb nor pass. Each cell's place is the roomiest in it, so that the
/// way leads through the middle of gates. It knows nothing of the vehicle's dynamics; searches use
/// it to choose where to steer, and nothing is decided by it.
class CostToGo {
 public:
  /// \param climbs_rad the steepest slope that each soil lets the vehicle climb; nothing: none
  /// \param variety 0: the cheapest way; above: cells are made dearer at random by up to so many
  /// times, smoothly over some metres, so that other ways round become the cheapest
  CostToGo(const PlanningProblem& problem, const std::vector<std::optional<double>>& climbs_rad,
           double variety, std::uint64_t seed);

  struct Place {
    double x_m = 0;
    double y_m = 0;
  };
  /// The place that lies a distance ahead on the cheapest way to the goal; the goal where that is
  /// nearer.
  Place ahead(double x_m, double y_m, double distance_m) const;

  /// The cost of the way from a place, between the centres of cells bilinear; infinite where there
  /// is none. Metres: no less than the way's length on a grid.
  double cost_m(double x_m, double y_m) const;

 private:
  struct Cell {
    int column = 0;
    int row = 0;
  };
  Cell cell_at(double x_m, double y_m) const;
  Place centre(const Cell& cell) const;
  std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.column);
  }
  /// Finds the roomiest place in each cell. \returns how dear the narrow ones are, 0 where there is
  /// plenty of room
  std::vector<double> settle(const PlanningProblem& problem);
  std::vector<double> dearness(const PlanningProblem& problem,
                               const std::vector<std::optional<double>>& climbs_rad) const;
  void spread(const std::vector<double>& dearness);

  Place goal_;
  double west_m_, south_m_, cell_m_;
  int columns_, rows_;
  std::vector<Place> places_;  ///< of the cells
  std::vector<double> cost_m_;
  std::vector<std::uint32_t> next_;  ///< the cell after each on the way
};

}  // namespace regoplan
