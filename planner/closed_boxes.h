#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "planner/planning_problem.h"

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
  bool on_rock(const PoseBox& box) const;
  /// Whether the body passes over the rock nowhere.
  bool too_high(const Rock& rock) const;
  bool stands_too_high(const Rock& rock) const;

  const PlanningProblem& problem_;
  double wheel_reach_m_ = 0;  ///< farthest contact from the vehicle's origin
  double body_reach_m_ = 0;   ///< farthest corner of the body
  /// How much a deviation of the ground by a metre at the contacts can turn their plane: bounds of
  /// its slopes, |forward| and |left|.
  double slope_per_deviation_1pm_ = 0;
  enum class Answer : std::int8_t { kNotAsked, kNo, kYes };
  mutable std::vector<Answer> too_high_;  ///< of each rock of the map
};

}  // namespace regoplan
