#pragma once

#include <array>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "drive_diagnosis/comparison/compared_channel.h"
#include "drive_diagnosis/instruments/mounting.h"
#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {

/// A window as the motors see it.
struct CurrentWindow {
  std::size_t window = 0;  ///< index of its window
  std::size_t drive = 0;
  double speed_mps = 0;  ///< over ground, along the vehicle: less than 0 backwards
  double yaw_rate_rad_s = 0;
  double sin_pitch = 0;
  double driven = 1;                  ///< share of it in which anything is commanded
  std::array<double, 2> current_a{};  ///< left, right
  double duration_s = 0;
  double pace = 1;  ///< of its drive (`pace_of`)
};

/// The current of a side of a skid-steered vehicle. What nothing is asked of takes what the
/// instruments read of nothing, whether it stands, coasts or is carried; what is driven, linear in
///   1, direction           the current that overcomes rolling, gears and friction; the direction
///                          in which the side's wheels turn follows from speed and yaw rate,
///   sin(pitch)             gravity's share,
///   braking sin(pitch)     what is less of it where gravity drives (gears that do not turn back),
///   turn, direction |turn| the wheels that are dragged sideways: dry friction, full where the turn
///                          moves the sides by more than a third of the speed.
struct CurrentModel {
  static constexpr int kTerms = 7;
  using Terms = std::array<double, kTerms>;
  /// From the middle to where a side's wheels, as they slip, roll: more than half the track.
  double half_track_m = 0.4;
  std::array<Terms, 2> sides{};  ///< left, right: at rest, then those above

  static Terms terms(int side, const CurrentWindow& window, double half_track_m);
  double current_a(int side, const CurrentWindow& window) const;
  /// What a side takes straight ahead on the level.
  double level_a(int side) const {
    return sides.at(static_cast<std::size_t>(side))[1] +
           sides.at(static_cast<std::size_t>(side))[2];
  }
  /// Of a side, for the whole of gravity.
  double gravity_a(int side) const { return sides.at(static_cast<std::size_t>(side))[3]; }
};

/// How a model of the currents does on drives that it was not fitted to.
struct HeldOutCurrents {
  std::string held_out;  ///< `day`, `drive` or `stretch`: what was left out at a time
  std::array<double, 2> rms_a{}, constant_rms_a{};
  double both_rms_a = 0, both_constant_rms_a = 0;
  bool beats_constant = false;  ///< by more than a standard error over drives or stretches
  struct Charge {
    std::size_t drive = 0;
    double measured_ah = 0, predicted_ah = 0, constant_ah = 0;
    int windows = 0;
  };
  std::vector<Charge> charges;
  double median_charge_error = 0, median_constant_error = 0;  ///< shares of the measured charge
};

struct CurrentDiagnosis {
  CurrentModel model;
  HeldOutCurrents held_out;
  /// Left minus right straight ahead on the level, forwards; errors by leaving out a drive at a
  /// time, of a few drives a stretch.
  DriveEstimate left_excess_a;
  std::array<double, 2> left_excess_ci95_a{};
  double level_mean_a = 0;      ///< of both sides
  DriveEstimate gravity_ratio;  ///< left over right, 1 where both motors are alike
  std::optional<DriveEstimate> standing_excess_a;  ///< left minus right at rest
  /// The excess is beyond chance and the spread of builds, of a model that beats a constant.
  bool side_drag = false;
  std::vector<std::string> equivalent;  ///< what these drives cannot tell from it
  int windows = 0;
  int clusters = 0;
  std::vector<ComparedChannel> compared;  ///< left, right; corrected: held out
};

inline constexpr int kCurrentWindows = 30, kCurrentParts = 3;

/// What there is to fit a model of currents to.
struct CurrentsUsed {
  int windows = 0;  ///< that drive steadily with currents of both sides and attitude
  int parts = 0;    ///< days, drives or stretches that can be held out one at a time
  bool are_enough() const { return windows >= kCurrentWindows && parts >= kCurrentParts; }
};

struct CurrentComparison {
  CurrentsUsed used;
  std::optional<CurrentDiagnosis> currents;  ///< nothing of too few windows
};

/// Fits and judges the currents of both sides.
/// \param mountings by day, as `find_mountings` gives them \throws Interrupted
CurrentComparison diagnose_currents(const std::vector<DriveRecording>& drives,
                                    const std::vector<DriveWindow>& windows,
                                    const std::vector<Mounting>& mountings, bool sides_swapped,
                                    const std::stop_token& stop = {});

}  // namespace regoplan
