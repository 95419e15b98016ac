#pragma once

#include <optional>
#include <vector>

#include "planner/ompl/search_steps.h"
#include "planner/problem/plan_result.h"

namespace regoplan {

struct ImprovedPath {
  std::vector<ControlSegment> controls;
  Improvement improvement;
};

/// A path that costs less than a given one, by the problem's objective, and keeps every limit and
/// the margin of the steps. The path's knots are optimised (Ceres): shorter, straighter, no
/// sharper than can be driven at speed, clear of rocks and of slopes that are too steep. What comes
/// of it, and steps halfway there, are driven at the speed that curvature and acceleration allow,
/// in closed loop and by the exact dynamics of the search, every state judged; the cheapest that
/// reaches the goal counts, and is optimised in its turn while that gains. Deterministic. Nothing
/// for paths that drive in reverse, and where nothing better is found. \param steps of the world of
/// searches that the path was found in; they count what is driven
std::optional<ImprovedPath> improved(SearchSteps& steps,
                                     const std::vector<ControlSegment>& controls);

/// The same, keeping the smallest margin of the given path.
std::optional<ImprovedPath> improved(const World& searched,
                                     const std::vector<ControlSegment>& controls);

}  // namespace regoplan
