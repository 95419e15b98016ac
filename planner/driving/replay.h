#pragma once

#include <optional>
#include <vector>

#include "planner/driving/replay_steps.h"
#include "planner/problem/plan_result.h"
#include "planner/problem/world.h"

namespace regoplan {

/// A moment of a replay that the margins were judged at.
struct JudgedState {
  VehicleState state;
  WheelStrain strain;
};

/// What driving a control history again comes to. It ends where the goal is reached: at rest in it,
/// or there as fast as the goal allows, if the vehicle could then stop. Else at the first state
/// that may not be, or with the controls.
struct Replay {
  std::vector<TrajectoryPoint> points;  ///< where the margins were judged
  std::vector<JudgedState> judged;      ///< the same moments
  std::vector<VehicleState> coarse;     ///< after every whole coarse step, the start first
  VehicleState end;
  std::optional<RejectedState> rejection;
  double rejection_time_s = 0;
  bool reached_goal = false;
  double energy_j = 0;
  double length_m = 0;
  double duration_s = 0;
};

/// \param with_margins false judges limits of the states only, and leaves `points` empty
Replay replay(const World& world, const std::vector<ControlSegment>& controls,
              const ReplaySteps& steps, bool with_margins = true);

/// The verdict's steps: ten times finer than the search's, margins every half second or, of slow
/// vehicles, every quarter of a metre at top speed, or every step of the search where that is
/// longer.
ReplaySteps verification_steps(const World& world);

/// Largest distance between two replays at equal times, over the time that both last.
double deviation_max_m(const Replay& a, const Replay& b);

}  // namespace regoplan
