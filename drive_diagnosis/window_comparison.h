#pragma once

#include <Eigen/Core>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "drive_diagnosis/drive_windows.h"
#include "drive_diagnosis/window_prediction.h"

namespace regoplan {

/// Something of vehicle, sensors or soil that may be otherwise, by one number.
struct VehicleTrial {
  std::string id;         ///< of the effect, `steering_offset`; empty: a parameter, never claimed
  std::string parameter;  ///< what it is told in, `steer_front_deg`
  double unit = 1;        ///< of the parameter: what a sound vehicle is off, one standard deviation
  VehicleDeviation deviation;  ///< of that size
};

/// Everything that may be otherwise all along: faults, and numbers of the map's soils.
/// \param soils that were driven on, by index
std::vector<VehicleTrial> vehicle_trials(const Vehicle& vehicle, const TerrainMap& map,
                                         const std::vector<bool>& soils);

/// Soil of its own in some windows, by how much of each lies in it.
struct WindowZone {
  std::vector<double> share;  ///< of each compared window
  SoilNumbers numbers{};
};

/// Windows that the model can be asked of, with what was measured in them.
class WindowComparison {
 public:
  /// All must outlive it.
  WindowComparison(const std::vector<DriveRecording>& drives,
                   const std::vector<DriveWindow>& windows, const TerrainMap& map,
                   const Vehicle& vehicle, double gravity_mps2);

  std::size_t size() const { return windows_of_.size(); }
  /// Index of the window that comparison `i` is of.
  std::size_t window(std::size_t i) const { return windows_of_[i]; }
  /// Whether comparison `i` follows the one before without a gap.
  bool consecutive(std::size_t i) const;
  const std::vector<std::string>& channels() const { return channels_; }
  const std::vector<bool>& soils_driven() const { return soils_driven_; }
  std::size_t left_out() const { return left_out_; }  ///< windows beyond what is compared
  std::size_t unsteady() const { return unsteady_; }  ///< windows of starts and stops
  bool has_torque() const { return !torque_wheels_.empty(); }
  const WindowInput& input(std::size_t i) const { return inputs_[i]; }
  /// From now on windows are asked at inputs off the measured ones: of each window so many standard
  /// deviations of each wheel's turning, and of the acceleration.
  void shift_inputs(const Eigen::MatrixXd& shifts) { shifts_ = shifts; }
  std::size_t inputs() const { return vehicle_.wheels.size() + 1; }

  /// By window and channel.
  const Eigen::MatrixXd& measured() const { return measured_; }
  /// What the model says; a window whose motion does not balance keeps what `otherwise` says.
  /// \throws Interrupted
  Eigen::MatrixXd predicted(const VehicleDeviation& deviation, const std::vector<WindowZone>& zones,
                            const Eigen::MatrixXd& otherwise, const std::stop_token& stop) const;
  /// What the scatter of each wheel's measured turning changes, and that of the acceleration, by
  /// one standard deviation.
  std::vector<Eigen::MatrixXd> of_inputs(const VehicleDeviation& deviation,
                                         const Eigen::MatrixXd& base,
                                         const std::stop_token& stop) const;
  /// What neighbouring samples say of the scatter of each channel's windows; 0 where nothing.
  const std::vector<double>& sampled_std() const { return sampled_std_; }
  /// How far a channel's scatter goes with what it measures: torques, by their mean.
  bool scales(std::size_t channel) const { return channels_[channel].starts_with("torque"); }

 private:
  WindowInput shifted(std::size_t i) const;
  static double acceleration_std_mps2(const WindowInput& input);
  void shift(WindowInput& input, std::size_t window, std::size_t which, double deviations) const;
  Eigen::VectorXd vector_of(const WindowPrediction& prediction) const;
  std::optional<Eigen::VectorXd> measured_in(std::size_t window) const;
  void choose_channels();
  void estimate_sampled_std();

  const std::vector<DriveRecording>& drives_;
  const std::vector<DriveWindow>& windows_;
  const TerrainMap& map_;
  const Vehicle& vehicle_;
  WindowModel model_;
  std::vector<std::string> channels_;
  std::vector<std::size_t> torque_wheels_;
  bool has_attitude_ = false;
  std::vector<std::size_t> windows_of_;
  std::vector<WindowInput> inputs_;
  std::vector<std::array<double, kMaxWheels>> rim_std_rad_s_;  ///< of the windows' means
  std::vector<bool> soils_driven_;
  std::vector<double> sampled_std_;
  Eigen::MatrixXd measured_, shifts_;
  std::size_t left_out_ = 0, unsteady_ = 0;
};

}  // namespace regoplan
