#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "planner/course/path_curve.h"
#include "planner/course/speed_profile.h"
#include "planner/problem/world.h"

namespace regoplan {

/// A moment of a path that was driven before, with what was commanded there.
struct RecordedMoment {
  double s_m = 0;  ///< along the curve
  double time_s = 0;
  VehicleState state;
};

/// What is to be driven: a curve and the speed along it. The commanded curvature is the curve's, or
/// that of a record, where there is one.
struct ReferencePath {
  std::string name;  ///< of a file or a manoeuvre
  PathCurve curve;
  SpeedProfile speed;
  std::vector<RecordedMoment> recorded = {};
  bool reverse = false;  ///< all of it is driven backwards
  bool goes_on = false;  ///< a piece of a drive: where it ends at speed, no room to stop is asked

  /// Commanded curvature, as the vehicle counts it: in reverse a path that bends to the left of the
  /// way lies to the right of the vehicle.
  double curvature_1pm(double s_m) const;
  /// The vehicle on the path at s_m, slip-free: it heads where Ackermann steering has it head.
  VehicleState state_at(const Vehicle& vehicle, double s_m) const;
};

/// The steering law:
///   commanded curvature = curvature of the path a reaction length ahead
///                         - offset / L^2 - 2 damping (course - heading of the path) / L
/// (in reverse, what the vehicle is told has the other sign) with the offset to the left of the
/// nearest place of the path, the course that of the velocity, and L the longer of
/// `lookahead_wheelbases` wheelbases and the way of `lookahead_s`. Rim speed: the path's speed over
/// the ratio of speed and rim speed that the wheels have lately had.
struct SteeringLaw {
  double lookahead_wheelbases = 1;
  double lookahead_s = 0.8;
  double damping = 1;
  double reaction_s = 0.1;  ///< besides the vehicle's own rate of steering
  double slip_memory_s = 1;
};

/// Distance between the foremost and the rearmost axle.
double wheelbase_m(const Vehicle& vehicle);

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
TrackingRun track(const World& world, const ReferencePath& path, const SteeringLaw& law,
                  double deviation_max_m, const std::stop_token& stop = {});

/// The time step of `track`: a twentieth of a metre at top speed, at most a quarter of a second.
double tracking_step_s(double speed_max_mps);

}  // namespace regoplan
