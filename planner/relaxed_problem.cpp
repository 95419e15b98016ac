#include "planner/relaxed_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// Boxes of a map, searched from the start toward the goal as far as they are open.
class BoxSearch {
 public:
  explicit BoxSearch(const PlanningProblem& problem) : problem_(problem), closed_(problem) {
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
    const std::size_t places = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    steep_.assign(places, kNotAsked);
    visited_.assign(places * kHeadings, false);
  }

  /// Whether any box of the goal is open.
  bool goal_open() {
    const Goal& goal = problem_.goal;
    const double reach = goal.radius_m + cell_m_;
    for (int row = row_of(goal.y_m - reach); row <= row_of(goal.y_m + reach); ++row) {
      for (int column = column_of(goal.x_m - reach); column <= column_of(goal.x_m + reach);
           ++column) {
        for (int heading = 0; heading < kHeadings; ++heading) {
          const Box box{column, row, heading};
          if (is_goal(box) && reason(box) == Reason::kOpen) return true;
        }
      }
    }
    return false;
  }

  /// Whether open boxes lead from the start to the goal; nearest to the goal first.
  bool reaches_goal() {
    const StartState& start = problem_.start;
    const double turn = start.heading_rad / (2 * std::numbers::pi);
    add({column_of(start.x_m), row_of(start.y_m),
         static_cast<int>((turn - std::floor(turn)) * kHeadings) % kHeadings});
    while (!open_.empty()) {
      const Box box = open_.top().box;
      open_.pop();
      if (is_goal(box)) return true;
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          for (int dh = -1; dh <= 1; ++dh) {
            add({box.column + dc, box.row + dr, (box.heading + dh + kHeadings) % kHeadings});
          }
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
  static constexpr std::int8_t kNotAsked = -1;
  struct Box {
    int column = 0, row = 0, heading = 0;
  };
  struct Entry {
    double away_m = 0;
    std::size_t order = 0;
    Box box;
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
  PoseBox poses(const Box& box) const {
    return {.x_m = west_m_ + (box.column + 0.5) * cell_m_,
            .y_m = south_m_ + (box.row + 0.5) * cell_m_,
            .heading_rad = (box.heading + 0.5) * 2 * std::numbers::pi / kHeadings,
            .half_m = cell_m_ / 2,
            .half_rad = std::numbers::pi / kHeadings};
  }
  double away_m(const Box& box) const {
    const PoseBox pose = poses(box);
    return std::hypot(pose.x_m - problem_.goal.x_m, pose.y_m - problem_.goal.y_m);
  }
  bool is_goal(const Box& box) const {
    const Goal& goal = problem_.goal;
    if (away_m(box) > goal.radius_m + cell_m_ * std::numbers::sqrt2 / 2) return false;
    const PoseBox pose = poses(box);
    return !goal.heading_rad ||
           std::abs(std::remainder(pose.heading_rad - *goal.heading_rad, 2 * std::numbers::pi)) <=
               goal.heading_tolerance_rad + pose.half_rad;
  }
  Reason reason(const Box& box) {
    std::int8_t& steep =
        steep_[static_cast<std::size_t>(box.row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(box.column)];
    if (steep == kNotAsked) steep = closed_.too_steep(poses(box)) ? 1 : 0;
    return steep != 0 ? Reason::kSlope : closed_.reason(poses(box));
  }
  void add(const Box& box) {
    if (box.column < 0 || box.column >= columns_ || box.row < 0 || box.row >= rows_) return;
    const std::size_t number =
        (static_cast<std::size_t>(box.row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(box.column)) *
            kHeadings +
        static_cast<std::size_t>(box.heading);
    if (visited_[number]) return;
    visited_[number] = true;
    const Reason why = reason(box);
    ++met_[static_cast<std::size_t>(why)];
    if (why == Reason::kOpen) open_.push({away_m(box), open_.size(), box});
  }

  const PlanningProblem& problem_;
  ClosedBoxes closed_;
  double west_m_ = 0, south_m_ = 0, cell_m_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::int8_t> steep_;  ///< by place
  std::vector<bool> visited_;
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
