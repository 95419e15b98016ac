#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "driving/driven_world.h"
#include "driving/pose_filter.h"

namespace regoplan {

/// One kind of measurement. Noise and bias are in the unit of what is measured, or shares of it.
struct SensorChannel {
  double rate_hz = 10;
  double noise = 0;          ///< standard deviation, normal, each sample anew
  double bias = 0;           ///< added to every sample
  double latency_s = 0;      ///< how old a sample is when it arrives
  double quantum = 0;        ///< samples are multiples of it; 0: not rounded
  double stale_share = 0;    ///< of the samples that repeat the one before
  double dropped_share = 0;  ///< of the samples that do not arrive
};

/// What the ground does that no soil number says: random, correlated along the way, of the motion
/// and of what is measured. Standard deviations.
struct GroundScatter {
  double speed_share = 0;
  double drift_rad = 0;   ///< of the course
  double turn_radpm = 0;  ///< of the heading, per metre of way
  double torque_share = 0;
  double attitude_rad = 0;
  double correlation_m = 1;  ///< way over which it is forgotten (to 1/e)
};

/// What is measured on a drive. A channel that is not there is never sampled.
struct SensorSuite {
  std::optional<SensorChannel> position;     ///< m, each coordinate
  std::optional<SensorChannel> yaw;          ///< rad
  std::optional<SensorChannel> attitude;     ///< rad, roll and pitch
  std::optional<SensorChannel> wheel_speed;  ///< shares of it
  std::optional<SensorChannel> torque;       ///< shares of it
  std::optional<SensorChannel> sinkage;      ///< m
  std::optional<SensorChannel> yaw_rate;     ///< rad/s; not recorded, the filter uses it
  GroundScatter scatter;
  double steer_noise_rad = 0;  ///< of the angles that steering reports
};

/// A row of a recording: what arrived at a time; NaN where nothing did.
struct SensedRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double time_s = 0;
  double x_m = kNone, y_m = kNone, yaw_rad = kNone, roll_rad = kNone, pitch_rad = kNone;
  double yaw_rate_rad_s = kNone;
  std::vector<double> wheel_speed_rad_s, steer_rad, torque_nm, sinkage_m;  ///< by wheel
};

/// What there is to be measured at a moment.
struct SensedTruth {
  double time_s = 0;
  VehicleState state;
  double roll_rad = 0, pitch_rad = 0;  ///< left side up, nose up
  std::vector<WheelNow> wheels;
};

/// Ground scatter as it goes on along the way.
class ScatterWalk {
 public:
  ScatterWalk(const GroundScatter& scatter, std::uint64_t seed);
  /// Goes on by so much way.
  void advance(double way_m);

  double speed_share() const { return scatter_.speed_share * values_[0]; }
  double drift_rad() const { return scatter_.drift_rad * values_[1]; }
  double turn_radpm() const { return scatter_.turn_radpm * values_[2]; }
  double roll_rad() const { return scatter_.attitude_rad * values_[3]; }
  double pitch_rad() const { return scatter_.attitude_rad * values_[4]; }
  /// Of one wheel.
  double torque_share(std::size_t wheel) const {
    return scatter_.torque_share * values_[5 + wheel];
  }

 private:
  GroundScatter scatter_;
  std::mt19937_64 random_;
  std::array<double, 5 + kMaxWheels> values_{};  ///< of variance 1
};

/// Samples what is sensed, at the rows of a recording.
class Sensors {
 public:
  Sensors(const SensorSuite& suite, const Vehicle& vehicle, std::uint64_t seed);

  /// Called at every row, in the order of time.
  SensedRow sample(const SensedTruth& truth);

  /// A fix of the pose from a row, where it brings a fresh one: of the time that it tells of.
  std::optional<PoseFix> fix(const SensedRow& row) const;

 private:
  /// When a channel is sampled next, what it has measured and not yet delivered.
  struct Line {
    std::optional<SensorChannel> channel;
    double due_s = 0;
    std::vector<double> last;
    std::mt19937_64 random;
    bool fresh = false;  ///< what it delivered last was no repetition
  };
  std::optional<std::vector<double>> sampled(Line& line, double time_s,
                                             const std::vector<double>& values, bool shares);
  const SensedTruth& at(double time_s) const;

  double radius_m_;
  double steer_noise_rad_;
  Line position_, yaw_, attitude_, wheel_speed_, torque_, sinkage_, yaw_rate_;
  std::mt19937_64 steer_random_;
  std::deque<SensedTruth> past_;
};

}  // namespace regoplan
