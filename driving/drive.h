#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "driving/drive_truth.h"
#include "driving/driven_world.h"
#include "driving/sensors.h"
#include "planner/following/follower.h"
#include "planner/problem/rejection.h"

namespace regoplan {

struct DriveSettings {
  /// With sensors its `lookahead_s` is lengthened by the wait for their pose fixes.
  FollowerChoice follower;
  /// Nothing: the follower sees the true pose, and the recording has every channel without noise.
  std::optional<SensorSuite> sensors = {};
  /// How far the vehicle may stray from the path before the drive is given up.
  double deviation_max_m = 1;
  std::uint64_t seed = 1;
  bool judge_margins = true;
  std::stop_token stop = {};
};

/// A limit that was broken: where first, and how far at worst.
struct LimitBroken {
  Rejection limit = Rejection::kSlope;
  double x_m = 0, y_m = 0, s_m = 0, time_s = 0;
  Exceeded first;    ///< there
  double worst = 0;  ///< SI
};

/// The truth at a row of the recording, and what was asked for.
struct DriveMoment {
  double time_s = 0;
  double s_m = 0;
  double offset_m = 0;           ///< true, left of the path
  double heading_error_rad = 0;  ///< true course less heading of the path
  VehicleState state;
  VehicleState seen;  ///< what the follower saw
  VehicleControl asked;
  std::vector<WheelNow> wheels;
};

/// True margins at a moment, of the manoeuvre that the path asks for there.
struct MarginMoment {
  double time_s = 0, s_m = 0;
  double cornering = -1, tip_over = -1, traction = -1;

  double smallest() const;
};

/// How a drive went.
struct DriveResult {
  bool reached = false;  ///< the goal, or the end of a path that does not lead there
  bool interrupted = false;
  /// Why it was not reached, or which limit was broken first; nothing where neither was.
  std::optional<Rejection> reason;
  std::optional<Exceeded> exceeded;              ///< of a reason that has a number
  double x_m = 0, y_m = 0, s_m = 0, time_s = 0;  ///< of what the reason names, else of the end

  SteeringLaw law;  ///< as it was in effect
  std::vector<LimitBroken> broken;
  double cross_track_rms_m = 0;  ///< over the way
  double cross_track_max_m = 0;
  double duration_s = 0, length_m = 0, energy_j = 0;
  std::optional<MarginMoment> smallest_margin;
  double margin_cornering_min = 1, margin_tip_over_min = 1, margin_traction_min = 1;

  std::vector<SensedRow> rows;        ///< the recording
  std::vector<DriveMoment> moments;   ///< the truth at the same rows
  std::vector<MarginMoment> margins;  ///< every half second, or quarter of a metre at top speed

  bool within_limits() const { return broken.empty(); }
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

/// Drives a path in closed loop in the true world.
///
/// Ends where the path ends and the vehicle has braked to rest, or the goal takes it at its speed;
/// or where it leaves the map, the known ground or the deviation allowed, hits a rock, does not get
/// on, or no forces balance. Limits that wear (slope, slip, slip angle, sinkage, margins) are noted
/// where they are broken, and the drive goes on, as a rover would.
/// \param planned a world for verdicts; its problem's top speed is what may be driven at
/// \param ends_in_goal the path leads to the problem's goal
DriveResult drive(const World& planned, const DrivenWorld& truth, const ReferencePath& path,
                  bool ends_in_goal, const DriveSettings& settings,
                  const std::function<void(double share)>& progress = {});

/// Rows of a recording are so far apart: a tenth of a second, or a step of slow vehicles.
double row_interval_s(double step_s);

/// The integrator's step: at most `tracking_step_s`, and a whole part of a tenth of a second where
/// it is shorter than that.
double drive_step_s(double speed_max_mps);

}  // namespace regoplan
