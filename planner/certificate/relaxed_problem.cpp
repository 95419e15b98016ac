#include "planner/certificate/relaxed_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <queue>
#include <vector>

#include "planner/certificate/open_boxes.h"

namespace regoplan {
namespace {

using Headings = OpenBoxes::Headings;
using Place = OpenBoxes::Place;

/// Those headings and their neighbours.
Headings spread(Headings headings) {
  return headings | std::rotl(headings, 1) | std::rotr(headings, 1);
}

/// Searches from the start toward the goal as far as boxes are open: all headings of a place at
/// once.
class BoxSearch {
 public:
  BoxSearch(const PlanningProblem& problem, OpenBoxes& boxes)
      : problem_(problem), boxes_(boxes), grid_(boxes.grid()), reached_(grid_.count()) {}

  /// Whether open boxes lead from the start to the goal; nearest to the goal first.
  bool reaches_goal() {
    const StartState& start = problem_.start;
    reach(grid_.at(start.x_m, start.y_m), Headings{1} << OpenBoxes::heading_at(start.heading_rad));
    while (!open_.empty()) {
      const Place place = open_.top().place;
      open_.pop();
      const Headings reached = reached_[grid_.index(place)];
      if ((reached & boxes_.goal_headings(place)) != 0) return true;
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          reach({place.column + dc, place.row + dr}, spread(reached));
        }
      }
    }
    return false;
  }

 private:
  struct Entry {
    double away_m = 0;
    std::size_t order = 0;
    Place place;
    bool operator>(const Entry& other) const {
      return away_m != other.away_m ? away_m > other.away_m : order > other.order;
    }
  };

  /// Reaches what is open of these headings, and what of the place's others can be turned to.
  void reach(const Place& place, Headings headings) {
    if (!grid_.inside(place)) return;
    const Headings open = boxes_.open(place);
    Headings& known = reached_[grid_.index(place)];
    Headings reached = known | (headings & open);
    for (Headings before = 0; before != reached;) {
      before = reached;
      reached |= spread(reached) & open;
    }
    if (reached == known) return;
    known = reached;
    open_.push({boxes_.goal_away_m(place), order_++, place});
  }

  const PlanningProblem& problem_;
  OpenBoxes& boxes_;
  const PlaceGrid& grid_;
  std::vector<Headings> reached_;
  std::size_t order_ = 0;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

/// What closed the boxes that were met, the most frequent reason first.
std::string met(const OpenBoxes& boxes) {
  const char* names[] = {"", "unknown or forbidden ground", "slope", "rocks"};
  std::array<std::size_t, 3> order{1, 2, 3};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return boxes.met()[a] > boxes.met()[b]; });
  std::string text;
  for (const std::size_t reason : order) {
    if (boxes.met()[reason] == 0) continue;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", names[reason]);
  }
  return text.empty() ? "the map's edge" : text;
}

}  // namespace

std::optional<std::string> certificate_of_infeasibility(const PlanningProblem& problem) {
  OpenBoxes boxes(problem);
  const std::string how = fmt::format(
      "boxes of {:.2f} m and {:.4g} deg, each closed only where every pose in it is forbidden by "
      "ground, slope or rocks; soils, margins and controls left aside",
      boxes.grid().cell_m, 360.0 / OpenBoxes::kHeadings);
  if (boxes.goal_places().empty()) {
    return fmt::format("the vehicle may stand nowhere in the goal: every box of it is closed ({})",
                       how);
  }
  if (BoxSearch(problem, boxes).reaches_goal()) return std::nullopt;
  return fmt::format("no way leads from the start to the goal: {} close it off ({})", met(boxes),
                     how);
}

}  // namespace regoplan
