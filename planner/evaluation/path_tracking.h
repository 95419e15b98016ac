#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "planner/following/follower.h"
#include "planner/problem/world.h"

namespace regoplan {

/// Why a run ended early, beyond what `Rejection` names.
enum class TrackingEnd {
  kArrived,
  kRejected,     ///< a limit of the state, see `rejected`
  kStrayed,      ///< farther from the path than allowed
  kStalled,      ///< does not get on
  kDynamics,     ///< no balance of forces was found
  kInterrupted,  ///< asked to stop; the run says nothing about the path
};

struct TrackingRun {
  struct Moment {
    double time_s = 0;
    double s_m = 0;
    double offset_m = 0;
    VehicleState state;
    WheelStrain strain;
    double energy_j = 0;  ///< that the drives have given since the start
  };
  TrackingEnd end = TrackingEnd::kArrived;
  std::optional<RejectedState> rejected;
  Moment last;
  std::vector<Moment> moments;  ///< every `kRecordEvery_m` of the path
  double deviation_max_m = 0;
  PathPoint deviation_at;
  WheelStrain strain_max;  ///< the largest of each on the way
  double duration_s = 0;
  double energy_j = 0;
  double step_s = 0;

  static constexpr double kRecordEvery_m = 0.5;
};

/// The larger of each strain.
WheelStrain largest_of(const WheelStrain& a, const WheelStrain& b);

/// Drives a path in closed loop, with the limits of states checked at every step: bounds, unknown
/// ground, obstacles, slope, sinkage, slip, slip angle. Margins are not judged: they belong to the
/// commanded path.
TrackingRun track(const World& world, const ReferencePath& path, const FollowerChoice& follower,
                  double deviation_max_m, const std::stop_token& stop = {});

/// The time step of `track`: a twentieth of a metre at top speed, at most a quarter of a second.
double tracking_step_s(double speed_max_mps);

}  // namespace regoplan
