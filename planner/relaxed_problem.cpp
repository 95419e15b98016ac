#include "planner/relaxed_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <queue>
#include <vector>

#include "planner/closed_boxes.h"

namespace regoplan {
namespace {

using Reason = ClosedBoxes::Reason;
constexpr int kHeadings = 32;

using Headings = std::uint32_t;  ///< a bit each, of the boxes of one place
static_assert(kHeadings == 32);
constexpr Headings kAll = 0xffffffff;

/// Those headings and their neighbours.
Headings spread(Headings headings) {
  return headings | std::rotl(headings, 1) | std::rotr(headings, 1);
}

/// Tells where all ground is known, by tiles of the elevation raster that are looked at once.
class KnownGround {
 public:
  explicit KnownGround(const TerrainMap& map)
      : map_(map),
        columns_(map.elevation().frame.columns / kTile + 1),
        tiles_(static_cast<std::size_t>(columns_) *
                   static_cast<std::size_t>(map.elevation().frame.rows / kTile + 1),
               kNotAsked) {}

  /// Whether all of a square is; false also where a tile beside it is not.
  bool around(double x_m, double y_m, double half_m) {
    if (!map_.inside(x_m - half_m, y_m - half_m) || !map_.inside(x_m + half_m, y_m + half_m)) {
      return false;
    }
    const GridFrame& frame = map_.elevation().frame;
    const auto column = [&](double x) {
      return static_cast<int>((x - frame.west_m) / frame.cell_width_m) / kTile;
    };
    const auto row = [&](double y) {
      return static_cast<int>((frame.north_m - y) / frame.cell_height_m) / kTile;
    };
    for (int r = row(y_m + half_m); r <= row(y_m - half_m); ++r) {
      for (int c = column(x_m - half_m); c <= column(x_m + half_m); ++c) {
        if (!known(c, r)) return false;
      }
    }
    return true;
  }

 private:
  static constexpr int kTile = 32;
  static constexpr std::int8_t kNotAsked = -1;

  bool known(int tile_column, int tile_row) {
    std::int8_t& answer =
        tiles_[static_cast<std::size_t>(tile_row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(tile_column)];
    if (answer != kNotAsked) return answer != 0;
    const GridFrame& frame = map_.elevation().frame;
    answer = 1;
    for (int r = tile_row * kTile; r < std::min(frame.rows, (tile_row + 1) * kTile); ++r) {
      for (int c = tile_column * kTile; c < std::min(frame.columns, (tile_column + 1) * kTile);
           ++c) {
        const double x = frame.west_m + (c + 0.5) * frame.cell_width_m;
        const double y = frame.north_m - (r + 0.5) * frame.cell_height_m;
        if (std::isnan(map_.height_m(x, y)) || !map_.soil_index(x, y)) answer = 0;
      }
    }
    return answer != 0;
  }

  const TerrainMap& map_;
  int columns_;
  std::vector<std::int8_t> tiles_;
};

/// Boxes of a map, searched from the start toward the goal as far as they are open: all headings of
/// a place at once.
class BoxSearch {
 public:
  explicit BoxSearch(const PlanningProblem& problem)
      : problem_(problem), closed_(problem), ground_(problem.map) {
    const GridFrame& frame = problem.map.elevation().frame;
    west_m_ = frame.west_m;
    south_m_ = frame.south_m();
    const double width = frame.east_m() - west_m_, depth = frame.north_m - south_m_;
    // Fine enough for the outline that all poses of a box cover to be most of the body's.
    constexpr double kShareOfBody = 0.12;
    constexpr double kMostAcross = 1000;
    const BodyBox& body = problem.vehicle.body;
    cell_m_ = std::max(kShareOfBody * (body.y_max_m - body.y_min_m),
                       std::max(width, depth) / kMostAcross);
    columns_ = static_cast<int>(std::ceil(width / cell_m_));
    rows_ = static_cast<int>(std::ceil(depth / cell_m_));
    places_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  /// Whether any box of the goal is open.
  bool goal_open() {
    const Goal& goal = problem_.goal;
    const double reach = goal.radius_m + cell_m_;
    for (int row = row_of(goal.y_m - reach); row <= row_of(goal.y_m + reach); ++row) {
      for (int column = column_of(goal.x_m - reach); column <= column_of(goal.x_m + reach);
           ++column) {
        if ((goal_headings({column, row}) & asked({column, row}).open) != 0) return true;
      }
    }
    return false;
  }

  /// Whether open boxes lead from the start to the goal; nearest to the goal first.
  bool reaches_goal() {
    const StartState& start = problem_.start;
    const double turn = start.heading_rad / (2 * std::numbers::pi);
    const auto heading = static_cast<int>((turn - std::floor(turn)) * kHeadings) % kHeadings;
    reach({column_of(start.x_m), row_of(start.y_m)}, Headings{1} << heading);
    while (!open_.empty()) {
      const Place place = open_.top().place;
      open_.pop();
      const Headings reached = at(place).reached;
      if ((reached & goal_headings(place)) != 0) return true;
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          reach({place.column + dc, place.row + dr}, spread(reached));
        }
      }
    }
    return false;
  }

  /// What stopped it, the most frequent first: reasons of the closed boxes at the edge.
  std::string edge() const {
    const char* names[] = {"", "unknown or forbidden ground", "slope", "rocks"};
    std::array<int, 3> order{1, 2, 3};
    std::stable_sort(order.begin(), order.end(), [this](int a, int b) {
      return met_[static_cast<std::size_t>(a)] > met_[static_cast<std::size_t>(b)];
    });
    std::string text;
    for (const int reason : order) {
      if (met_[static_cast<std::size_t>(reason)] == 0) continue;
      text += fmt::format("{}{}", text.empty() ? "" : ", ", names[reason]);
    }
    return text.empty() ? "the map's edge" : text;
  }
  double cell_m() const { return cell_m_; }

 private:
  struct Place {
    int column = 0, row = 0;
  };
  struct Boxes {
    Headings open = 0, reached = 0;
    bool asked = false;
  };
  struct Entry {
    double away_m = 0;
    std::size_t order = 0;
    Place place;
    bool operator>(const Entry& other) const {
      return away_m != other.away_m ? away_m > other.away_m : order > other.order;
    }
  };

  int column_of(double x_m) const {
    return std::clamp(static_cast<int>((x_m - west_m_) / cell_m_), 0, columns_ - 1);
  }
  int row_of(double y_m) const {
    return std::clamp(static_cast<int>((y_m - south_m_) / cell_m_), 0, rows_ - 1);
  }
  Boxes& at(const Place& place) {
    return places_[static_cast<std::size_t>(place.row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(place.column)];
  }
  PoseBox poses(const Place& place, int heading) const {
    return {.x_m = west_m_ + (place.column + 0.5) * cell_m_,
            .y_m = south_m_ + (place.row + 0.5) * cell_m_,
            .heading_rad = (heading + 0.5) * 2 * std::numbers::pi / kHeadings,
            .half_m = cell_m_ / 2,
            .half_rad = std::numbers::pi / kHeadings};
  }
  double away_m(const Place& place) const {
    const PoseBox pose = poses(place, 0);
    return std::hypot(pose.x_m - problem_.goal.x_m, pose.y_m - problem_.goal.y_m);
  }
  Headings goal_headings(const Place& place) const {
    const Goal& goal = problem_.goal;
    if (away_m(place) > goal.radius_m + cell_m_ * std::numbers::sqrt2 / 2) return 0;
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

  /// Asks once which of a place's boxes are open.
  Boxes& asked(const Place& place) {
    Boxes& boxes = at(place);
    if (boxes.asked) return boxes;
    boxes.asked = true;
    const PoseBox any = poses(place, 0);
    if (closed_.too_steep(any)) {
      met_[static_cast<std::size_t>(Reason::kSlope)] += kHeadings;
      return boxes;
    }
    if (closed_.far_from_rocks(any) &&
        ground_.around(any.x_m, any.y_m, closed_.wheel_reach_m() + any.half_m)) {
      boxes.open = kAll;
      return boxes;
    }
    for (int i = 0; i < kHeadings; ++i) {
      const Reason why = closed_.reason(poses(place, i));
      ++met_[static_cast<std::size_t>(why)];
      if (why == Reason::kOpen) boxes.open |= Headings{1} << i;
    }
    return boxes;
  }

  /// Reaches what is open of these headings, and what of the place's others can be turned to.
  void reach(const Place& place, Headings headings) {
    if (place.column < 0 || place.column >= columns_ || place.row < 0 || place.row >= rows_) {
      return;
    }
    Boxes& boxes = asked(place);
    Headings reached = boxes.reached | (headings & boxes.open);
    for (Headings before = 0; before != reached;) {
      before = reached;
      reached |= spread(reached) & boxes.open;
    }
    if (reached == boxes.reached) return;
    boxes.reached = reached;
    open_.push({away_m(place), order_++, place});
  }

  const PlanningProblem& problem_;
  ClosedBoxes closed_;
  KnownGround ground_;
  double west_m_ = 0, south_m_ = 0, cell_m_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<Boxes> places_;
  std::size_t order_ = 0;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  std::array<std::int64_t, 4> met_{};  ///< boxes, by reason
};

}  // namespace

std::optional<std::string> certificate_of_infeasibility(const PlanningProblem& problem) {
  BoxSearch boxes(problem);
  const std::string how = fmt::format(
      "boxes of {:.2f} m and {:.4g} deg, each closed only where every pose in it is forbidden by "
      "ground, slope or rocks; soils, margins and controls left aside",
      boxes.cell_m(), 360.0 / kHeadings);
  if (!boxes.goal_open()) {
    return fmt::format("the vehicle may stand nowhere in the goal: every box of it is closed ({})",
                       how);
  }
  if (boxes.reaches_goal()) return std::nullopt;
  return fmt::format("no way leads from the start to the goal: {} close it off ({})", boxes.edge(),
                     how);
}

}  // namespace regoplan
