#pragma once

#include <vector>

#include "planner/ompl/drive.h"

namespace regoplan {

/// A way to the goal's pose, with where the vehicle should be before each of its steps.
struct GoalConnection {
  struct Step {
    VehicleControl control;
    VehicleState due;  ///< place, heading, commanded speed and curvature, slip-free
  };
  std::vector<Step> steps;
};

/// The shortest slip-free way from a state to the pose that the goal asks for, ahead and in reverse
/// (Reeds and Shepp 1990): braking to a stop first, turns of 1.25 times the tightest radius, the
/// wheels steered at rest wherever the curvature changes, slow in between. Turns leave a fifth of
/// the steering for coming back to the way where wheels slip. No steps where a pose on the way
/// touches an obstacle or lies off the known ground, where it is longer than asked for, or where
/// the goal asks for no heading.
GoalConnection connection_to_goal(const OmplProblem& problem, const VehicleState& from,
                                  double longest_m);

}  // namespace regoplan
