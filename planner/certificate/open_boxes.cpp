#include "planner/certificate/open_boxes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regoplan {

using Reason = ClosedBoxes::Reason;

PlaceGrid::Place PlaceGrid::at(double x_m, double y_m) const {
  // Clamped before it is an integer: a goal may reach farther than integers do.
  const auto nearest = [this](double offset_m, int count) {
    return static_cast<int>(std::clamp(offset_m / cell_m, 0.0, count - 1.0));
  };
  return {nearest(x_m - west_m, columns), nearest(y_m - south_m, rows)};
}

OpenBoxes::OpenBoxes(const PlanningProblem& problem)
    : problem_(problem), closed_(problem), ground_(problem.map) {
  const GridFrame& frame = problem.map.elevation().frame;
  const double width = frame.east_m() - frame.west_m, depth = frame.north_m - frame.south_m();
  // Fine enough for the outline that all poses of a box cover to be most of the body's.
  constexpr double kShareOfBody = 0.12;
  constexpr double kMostAcross = 1000;
  const BodyBox& body = problem.vehicle.body;
  const double cell_m =
      std::max(kShareOfBody * (body.y_max_m - body.y_min_m), std::max(width, depth) / kMostAcross);
  grid_ = {.west_m = frame.west_m,
           .south_m = frame.south_m(),
           .cell_m = cell_m,
           .columns = static_cast<int>(std::ceil(width / cell_m)),
           .rows = static_cast<int>(std::ceil(depth / cell_m))};
  places_.resize(grid_.count());
}

int OpenBoxes::heading_at(double heading_rad) {
  const double turn = heading_rad / (2 * std::numbers::pi);
  return static_cast<int>((turn - std::floor(turn)) * kHeadings) % kHeadings;
}

PoseBox OpenBoxes::poses(const Place& place, int heading) const {
  return {.x_m = grid_.west_m + (place.column + 0.5) * grid_.cell_m,
          .y_m = grid_.south_m + (place.row + 0.5) * grid_.cell_m,
          .heading_rad = (heading + 0.5) * 2 * std::numbers::pi / kHeadings,
          .half_m = grid_.cell_m / 2,
          .half_rad = std::numbers::pi / kHeadings};
}

double OpenBoxes::goal_away_m(const Place& place) const {
  const PoseBox pose = poses(place, 0);
  return std::hypot(pose.x_m - problem_.goal.x_m, pose.y_m - problem_.goal.y_m);
}

OpenBoxes::Headings OpenBoxes::goal_headings(const Place& place) const {
  const Goal& goal = problem_.goal;
  if (goal_away_m(place) > goal.radius_m + grid_.cell_m * std::numbers::sqrt2 / 2) return 0;
  if (!goal.heading_rad) return kAll;
  Headings headings = 0;
  for (int i = 0; i < kHeadings; ++i) {
    const PoseBox pose = poses(place, i);
    const double off =
        std::abs(std::remainder(pose.heading_rad - *goal.heading_rad, 2 * std::numbers::pi));
    if (off <= goal.heading_tolerance_rad + pose.half_rad) headings |= Headings{1} << i;
  }
  return headings;
}

std::vector<OpenBoxes::Place> OpenBoxes::goal_places() {
  const Goal& goal = problem_.goal;
  const double reach = goal.radius_m + grid_.cell_m;
  const Place low = grid_.at(goal.x_m - reach, goal.y_m - reach);
  const Place high = grid_.at(goal.x_m + reach, goal.y_m + reach);
  std::vector<Place> places;
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      if ((goal_headings({column, row}) & open({column, row})) != 0)
        places.push_back({column, row});
    }
  }
  return places;
}

OpenBoxes::Headings OpenBoxes::open(const Place& place) {
  Boxes& boxes = places_[grid_.index(place)];
  if (!boxes.asked) boxes = {.open = look(place), .asked = true};
  return boxes.open;
}

OpenBoxes::Headings OpenBoxes::look(const Place& place) {
  const PoseBox any = poses(place, 0);
  if (closed_.too_steep(any)) {
    meet(Reason::kSlope, kHeadings);
    return 0;
  }
  if (closed_.far_from_rocks(any) &&
      ground_.around(any.x_m, any.y_m, closed_.wheel_reach_m() + any.half_m)) {
    return kAll;
  }
  Headings open = 0;
  for (int i = 0; i < kHeadings; ++i) {
    const Reason why = closed_.reason(poses(place, i));
    meet(why, 1);
    if (why == Reason::kOpen) open |= Headings{1} << i;
  }
  return open;
}

}  // namespace regoplan
