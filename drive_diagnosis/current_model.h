#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "drive_diagnosis/drive_windows.h"
#include "drive_diagnosis/mounting.h"

namespace regoplan {

/// A window as the motors of one side see it.
struct CurrentWindow {
  std::size_t window = 0;  ///< index of its window
  std::size_t drive = 0;
  std::array<double, 2> direction{1, 1};  ///< of each side's wheels, left, right; -1 backwards
  double sin_pitch = 0;
  double yaw_rate_rad_s = 0;
  std::array<double, 2> current_a{};  ///< left, right
  double duration_s = 0;
};

/// The current of a side of a skid-steered vehicle, as linear in
///   1, direction           the current that overcomes rolling, gears and friction,
///   sin(pitch)             gravity's share,
///   braking sin(pitch)     what is less of it where gravity drives (gears that do not turn back),
///   tanh(r / r0), |.|      the wheels that are dragged sideways in a turn with yaw rate r: dry
///                          friction, so full in all but the widest turns.
struct CurrentModel {
  static constexpr int kTerms = 6;
  static constexpr double kTurn_rad_s = 0.1;  ///< r0
  using Terms = std::array<double, kTerms>;
  std::array<Terms, 2> sides{};  ///< left, right

  static Terms terms(int side, const CurrentWindow& window);
  double current_a(int side, const CurrentWindow& window) const;
  /// What a side takes straight ahead on the level.
  double level_a(int side) const {
    return sides.at(static_cast<std::size_t>(side))[0] +
           sides.at(static_cast<std::size_t>(side))[1];
  }
};

/// How a model of the currents does on drives that it was not fitted to.
struct HeldOutCurrents {
  std::string held_out;  ///< `day`, `drive` or `stretch`: what was left out at a time
  std::array<double, 2> rms_a{}, constant_rms_a{};
  double both_rms_a = 0, both_constant_rms_a = 0;
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
  /// Left minus right straight ahead on the level, forwards, over drawn drives.
  DriveEstimate left_excess_a;
  std::array<double, 2> left_excess_ci95_a{};
  double level_mean_a = 0;      ///< of both sides
  DriveEstimate gravity_ratio;  ///< left over right, 1 where both motors are alike
  std::optional<DriveEstimate> standing_excess_a;  ///< left minus right at rest
  bool side_drag = false;               ///< the excess is beyond chance and the spread of builds
  std::vector<std::string> equivalent;  ///< what these drives cannot tell from it
  int windows = 0;
  int clusters = 0;
};

/// Fits and judges the currents of both sides. Nothing where fewer than 30 windows drive steadily
/// with currents and attitude.
/// \param mountings by day, as `find_mountings` gives them \throws Interrupted
std::optional<CurrentDiagnosis> diagnose_currents(const std::vector<DriveRecording>& drives,
                                                  const std::vector<DriveWindow>& windows,
                                                  const std::vector<Mounting>& mountings,
                                                  bool sides_swapped, std::uint64_t seed,
                                                  const std::stop_token& stop = {});

}  // namespace regoplan
