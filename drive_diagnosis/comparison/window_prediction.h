#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "drive_diagnosis/comparison/deviating_wheels.h"
#include "drive_diagnosis/comparison/soil_deviation.h"
#include "drive_diagnosis/comparison/vehicle_deviation.h"
#include "drive_diagnosis/recording/drive_windows.h"
#include "maps/ground_finder.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/ground_patch.h"
#include "terramech/parameters/vehicle.h"
#include "terramech/vehicle/steered_wheel.h"

namespace regoplan {

/// Where the search for a motion starts.
struct MotionStart {
  BodyMotion motion;
  /// By how much the motion changes against what is out of balance; 0 where it is not known.
  Eigen::Matrix3d response = Eigen::Matrix3d::Zero();
};

/// What a window gives the model: where the vehicle is while it is smoothed, and what its wheels
/// are set to there.
struct WindowInput {
  struct Place {
    WindowPart part;
    double acceleration_mps2 =
        0;  ///< measured, of wheels that roll: of the speed along the heading
    double yaw_acceleration_rps2 = 0;
    /// What the model is to take for more than its own accelerations.
    double more_mps2 = 0, more_rps2 = 0;
    /// By how much the ground rises more than the map says, along and to the left, per metre.
    double more_slope_forward = 0, more_slope_left = 0;
    MotionStart near;   ///< where the search for the motion starts
    MotionStart start;  ///< and where it starts again if that leads nowhere
    std::array<double, kMaxWheels> rim_rad_s{};
    std::array<double, kMaxWheels> rim_rad_s2{};  ///< by how much rim speeds change
    std::array<double, kMaxWheels> steer_rad{};
  };
  std::vector<Place> places;
  double yaw_rad = 0;      ///< what velocities are told along
  double forward_mps = 0;  ///< measured: by it wheels are ahead of the body in time
  double pace = 1;         ///< of its drive (`pace_of`)
};

/// What the model says of a window; velocities are horizontal, angles those of the ground.
struct WindowPrediction {
  double forward_mps = 0, left_mps = 0, yaw_rate_rad_s = 0;
  double pitch_rad = 0, roll_rad = 0;
  std::array<double, kMaxWheels> torque_nm{};
  std::vector<MotionStart> found;  ///< motions of the body at each place
};

/// Whatever soil the map has below each wheel.
inline constexpr int kAsMapped = -1;

/// When a wheel is somewhere, along and across the way.
struct WheelTime {
  double at_s = 0;    ///< when the middle of the body is, was or will be as far on as the wheel is
  double left_s = 0;  ///< in which the vehicle goes as far as the wheel is to the left
};

/// One soil on a stretch of the way, whatever the map says there: from when the middle of the body
/// comes to it until it leaves it. Each wheel does so when it is there itself.
struct SoilStretch {
  double starts_s = 0, ends_s = 0;
  int soil = 0;           ///< of the map, that its numbers are told from; may be kAsMapped
  SoilNumbers numbers{};  ///< on top of the deviations of that soil
  /// By how much farther on each border lies per length to the left of the track: the tangent of
  /// the angle by which it is crossed obliquely.
  double starts_slant = 0, ends_slant = 0;

  bool holds(const WheelTime& wheel) const {
    return wheel.at_s - starts_slant * wheel.left_s >= starts_s &&
           wheel.at_s - ends_slant * wheel.left_s < ends_s;
  }
  bool operator==(const SoilStretch&) const = default;
};

/// What the model finds at the places of a window, and what it was asked of.
struct WindowMotions {
  struct Place {
    MotionStart found;
    PatchAxes axes;
    double slope_forward = 0, slope_left = 0;
    std::array<double, kMaxWheels> torque_nm{};  ///< of the soil alone
    /// Each wheel's load times the share by which it is above the mean of all.
    std::array<double, kMaxWheels> uneven_load_n{};
  };
  VehicleDeviation deviation;
  std::vector<SoilStretch> stretches;
  /// Nothing where the ground is not known or no motion balances.
  std::optional<std::vector<Place>> places;
  std::vector<bool>
      on_soil;  ///< of each soil of the map: whether some wheel's numbers come from it
};

/// The motion of a vehicle whose wheels rolled without slip, as nearly as they can (least squares).
BodyMotion rolling_motion(const Vehicle& vehicle, const std::array<double, kMaxWheels>& rim_rad_s,
                          const std::array<double, kMaxWheels>& steer_rad);

/// Motion of a vehicle whose wheels turn and steer as measured: the body's velocities at the places
/// of a window, one after the other, at which the wheels' forces and gravity give what the body
/// accelerates from the two places before (backward differences, BDF2); at the first, what rolling
/// wheels accelerate. Slip thus lags behind the wheels as it does. What it says of a window is what
/// the smoothing makes of these motions.
class WindowModel {
 public:
  /// All must outlive it.
  WindowModel(const TerrainMap& map, const Vehicle& vehicle, double gravity_mps2);

  /// Whether the ground is known at each of its places.
  bool knows_ground(const WindowInput& input) const;
  /// When each wheel is where it is at a place of a window.
  std::vector<WheelTime> wheel_times(const WindowInput& input, const WindowInput::Place& place,
                                     const VehicleDeviation& deviation) const;
  /// The motions in a window.
  /// \param stretches the first that a wheel is on counts
  WindowMotions motions(const WindowInput& input, const VehicleDeviation& deviation,
                        const std::vector<SoilStretch>& stretches = {}) const;
  /// Nothing where the ground is not known or no motion balances.
  /// \param known motions at the same input: where nothing that moves the vehicle there is
  /// otherwise they are not sought again, to the same bits
  std::optional<WindowPrediction> predict(const WindowInput& input,
                                          const VehicleDeviation& deviation,
                                          const std::vector<SoilStretch>& stretches = {},
                                          const WindowMotions* known = nullptr) const;

 private:
  const TerrainMap& map_;
  const Vehicle& vehicle_;
  GroundFinder ground_;
  double gravity_mps2_;
  DeviatingWheels wheels_;
};

}  // namespace regoplan
