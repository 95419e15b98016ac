#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/certificate/closed_boxes.h"
#include "planner/problem/known_ground.h"

namespace regoplan {

/// A map's places, side by side.
struct PlaceGrid {
  struct Place {
    int column = 0, row = 0;
  };

  double west_m = 0, south_m = 0, cell_m = 0;
  int columns = 0, rows = 0;

  std::size_t count() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t index(const Place& place) const {
    return static_cast<std::size_t>(place.row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(place.column);
  }
  bool inside(const Place& place) const {
    return place.column >= 0 && place.column < columns && place.row >= 0 && place.row < rows;
  }
  /// The one that holds a point; the nearest for points off the map.
  Place at(double x_m, double y_m) const;
};

/// Which boxes of a map's places and headings `ClosedBoxes` leaves open; each is looked at once,
/// when first asked for.
class OpenBoxes {
 public:
  using Place = PlaceGrid::Place;
  static constexpr int kHeadings = 32;
  using Headings = std::uint32_t;  ///< a bit each, of the boxes of one place
  static_assert(kHeadings == 32);
  static constexpr Headings kAll = 0xffffffff;

  /// \param problem must outlive it
  explicit OpenBoxes(const PlanningProblem& problem);

  const PlaceGrid& grid() const { return grid_; }
  static int heading_at(double heading_rad);

  /// Which headings of a place are open.
  Headings open(const Place& place);
  /// The places that touch the goal, with an open heading that the goal accepts.
  std::vector<Place> goal_places();
  /// Headings of a place that touch the goal, open or not.
  Headings goal_headings(const Place& place) const;
  /// From its middle to the goal's.
  double goal_away_m(const Place& place) const;

  /// Boxes asked for so far, by `ClosedBoxes::Reason`.
  const std::array<std::int64_t, 4>& met() const { return met_; }

 private:
  PoseBox poses(const Place& place, int heading) const;
  Headings look(const Place& place);
  void meet(ClosedBoxes::Reason reason, int boxes) {
    met_[static_cast<std::size_t>(reason)] += boxes;
  }

  struct Boxes {
    Headings open = 0;
    bool asked = false;
  };

  const PlanningProblem& problem_;
  ClosedBoxes closed_;
  KnownGround ground_;
  PlaceGrid grid_;
  std::vector<Boxes> places_;
  std::array<std::int64_t, 4> met_{};
};

}  // namespace regoplan
