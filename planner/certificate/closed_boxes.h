#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/problem/planning_problem.h"

namespace regoplan {

/// A box of places and headings.
struct PoseBox {
  double x_m = 0, y_m = 0, heading_rad = 0;  ///< its middle
  double half_m = 0;                         ///< of its side
  double half_rad = 0;                       ///< of its range of headings
};

/// Tells of boxes of poses whether every pose in one is forbidden. Errs to the open side only.
class ClosedBoxes {
 public:
  enum class Reason { kOpen, kUnknownGround, kSlope, kRock };

  /// \param problem must outlive it
  explicit ClosedBoxes(const PlanningProblem& problem);

  /// Whether every pose of the box, whatever its heading, is too steep.
  bool too_steep(const PoseBox& box) const;
  /// Whether every pose of the box is forbidden by ground or rocks.
  Reason reason(const PoseBox& box) const;

  /// Whether no rock is near enough to close a box there, whatever its heading.
  bool far_from_rocks(const PoseBox& box) const;
  /// Farthest contact from the vehicle's origin.
  double wheel_reach_m() const { return wheel_reach_m_; }

 private:
  bool wheel_off_ground(const PoseBox& box) const;
  /// What is known of a rock whatever the pose: of a vehicle whose body covers some of it.
  struct RockBound {
    bool asked = false;
    bool too_high = false;  ///< the body passes over it nowhere
    double tilt_rad = 0;    ///< the vehicle leans by no more
    /// Where the underside's outline is, seen from the contacts': the ground's slope moves it
    /// downhill, what strays from that slope by no more than the last.
    double aside_x_m = 0, aside_y_m = 0, aside_within_m = 0;
  };

  bool on_rock(const PoseBox& box) const;
  /// The same of a box or of all parts that it is halved into so often: smaller ones show more.
  bool closed_by_rocks(const PoseBox& box, int halvings) const;
  /// Whether every pose of the box covers some of one rock that is too high.
  bool covers_rock(const PoseBox& box) const;
  const RockBound& bound(const Rock& rock) const;
  RockBound looked_at(const Rock& rock) const;

  const PlanningProblem& problem_;
  double wheel_reach_m_ = 0;  ///< farthest contact from the vehicle's origin
  double body_reach_m_ = 0;   ///< farthest corner of the body
  /// How much ground that strays by +-1 m at the contacts can turn their plane, and raise or lower
  /// it at a place of the body: bounds of its slope and height.
  double slope_per_stray_1pm_ = 0, height_per_stray_ = 0;
  mutable std::vector<RockBound> bounds_;  ///< of each rock of the map
};

}  // namespace regoplan
