#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drive_diagnosis/comparison/window_prediction.h"
#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {

/// Why a window is not compared.
enum class LeftOut {
  kNoInput,    ///< it has no pose, rim speeds or steering
  kStanding,   ///< wheels stand or turn round: how they slip says nothing
  kOffMap,     ///< its ground is not known
  kNoBalance,  ///< the model has no motion in which the forces balance
  kNoChannel,  ///< what is compared was not measured
  kTooMany,    ///< beyond the most that are compared
};
inline constexpr std::size_t kLeftOutReasons = 6;

/// `no_input`, `standing`, ...
std::string_view name(LeftOut reason);

/// How many windows are compared, and how many are not for each reason.
struct WindowsUsed {
  int compared = 0;
  std::array<int, kLeftOutReasons> left_out{};
  /// Of those without input, in how many each column has no value.
  std::map<std::string, int> columns_missing{};
};

/// One soil on a stretch of compared windows that follow each other, whatever the map says there.
struct WindowZone {
  double begins = 0, ends = 0;  ///< in windows: 2.5 is half way through the third
  int soil = 0;                 ///< of the map, that its numbers are told from; may be kAsMapped
  SoilNumbers numbers{};
  double begins_slant = 0, ends_slant = 0;  ///< of its borders; see SoilStretch
};

/// Compared windows, by index.
using WindowSet = std::vector<std::size_t>;

/// What windows are asked about.
struct WindowQuestion {
  VehicleDeviation deviation;
  std::vector<WindowZone> zones;
};

/// Motions of each compared window, about one question; nothing of those that were not asked.
using MotionsByWindow = std::vector<std::optional<WindowMotions>>;

/// Windows that the model can be asked of, with what was measured in them.
class WindowComparison {
 public:
  /// All must outlive it. \param threads that windows are asked on; changes no result
  WindowComparison(const std::vector<DriveRecording>& drives,
                   const std::vector<DriveWindow>& windows, const TerrainMap& map,
                   const Vehicle& vehicle, double gravity_mps2, int threads);

  std::size_t size() const { return windows_of_.size(); }
  WindowSet all() const;
  /// Those in which some wheel is in one of the zones within what the window is smoothed over.
  WindowSet touching(const std::vector<WindowZone>& zones) const;
  /// Those of them that a zone of this window touches and that no gap parts from it.
  WindowSet touching_in_run(std::size_t window, const WindowZone& zone) const;
  /// A zone that begins and ends so many windows farther out, as far as windows follow each other.
  WindowZone widened(WindowZone zone, double windows) const;
  /// Index of the window that comparison `i` is of.
  std::size_t window(std::size_t i) const { return windows_of_[i]; }
  /// Whether a window is left out as the model has no motion in it on the map's soils.
  bool is_unbalanced(std::size_t window) const { return unbalanced_[window]; }
  /// Whether comparison `i` follows the one before without a gap.
  bool consecutive(std::size_t i) const;
  const std::vector<std::string>& channels() const { return channels_; }
  /// Where a channel stands among them; nothing where it is not compared.
  std::optional<std::size_t> channel(std::string_view name) const;
  const std::vector<bool>& soils_driven() const { return soils_driven_; }
  const WindowsUsed& used() const { return used_; }
  bool has_torque() const { return !torque_wheels_.empty(); }
  const WindowInput& input(std::size_t i) const { return inputs_[i]; }
  /// From now on windows are asked at inputs off the measured ones: of each window so many standard
  /// deviations of each wheel's turning, of the acceleration, of that of turning and of the
  /// ground's slopes along and across.
  void shift_inputs(const Eigen::MatrixXd& shifts) { shifts_ = shifts; }
  std::size_t inputs() const { return vehicle_.wheels.size() + 4; }
  /// The input that is the ground's slope along; the next is that across. Nobody says how far a
  /// map's slopes err.
  std::size_t slope_along() const { return vehicle_.wheels.size() + 2; }
  static constexpr double kSlope = 0.005;  ///< that those are shifted by

  /// By window and channel.
  const Eigen::MatrixXd& measured() const { return measured_; }
  /// What the model says with the vehicle and the map as they are said to be.
  /// \throws Interrupted
  Eigen::MatrixXd predicted_as_said(const std::stop_token& stop) const;
  /// What it says of some windows; of all others, and where no motion balances, `otherwise`.
  /// \throws Interrupted
  Eigen::MatrixXd predicted(const WindowSet& windows, const VehicleDeviation& deviation,
                            const std::vector<WindowZone>& zones, const Eigen::MatrixXd& otherwise,
                            const std::stop_token& stop) const;
  /// The motions of some windows. \throws Interrupted
  MotionsByWindow motions(const WindowSet& windows, const WindowQuestion& question,
                          const std::stop_token& stop) const;
  /// What the model says of some windows under each of many questions; of all others, and where no
  /// motion balances, `otherwise`.
  /// \param known motions of these windows: what moves no vehicle otherwise is not sought again
  /// \throws Interrupted
  std::vector<Eigen::MatrixXd> predicted(const WindowSet& windows,
                                         const std::vector<WindowQuestion>& questions,
                                         const Eigen::MatrixXd& otherwise,
                                         const MotionsByWindow& known,
                                         const std::stop_token& stop) const;
  /// In which of the zones each wheel is at each place of a window, wheel by wheel; -1: in none.
  /// With the same soils, windows alike in that are predicted alike.
  std::vector<int> zones_under_wheels(std::size_t i, const WindowQuestion& question) const;
  /// What the model says of single windows, each under its own question; nothing where no motion
  /// balances. \throws Interrupted
  std::vector<std::optional<Eigen::VectorXd>> predicted_each(
      const std::vector<std::pair<std::size_t, WindowQuestion>>& windows,
      const std::stop_token& stop) const;
  /// When the vehicle was so far along the windows.
  double time_s(double at) const;
  /// From now on the search for the motion of these windows starts from what it is with these:
  /// what is a little otherwise is found sooner.
  void start_at(const WindowSet& windows, const VehicleDeviation& deviation,
                const std::vector<WindowZone>& zones, const std::stop_token& stop);
  /// What the scatter of each wheel's measured turning changes in these windows, and that of the
  /// accelerations and slopes, by one standard deviation; 0 in all others.
  /// \param here the motions of these windows that it is told about
  std::vector<Eigen::MatrixXd> of_inputs(const WindowSet& windows, const MotionsByWindow& here,
                                         const std::stop_token& stop) const;
  /// By window, the root mean square of the samples of each channel whose scatter goes with it.
  const Eigen::MatrixXd& sizes() const { return sizes_; }
  /// What neighbouring samples say of the scatter of each channel's windows; 0 where nothing.
  const std::vector<double>& sampled_std() const { return sampled_std_; }
  /// By window and channel, in quadrature: what the smoothing of fixes scatters more than in most
  /// windows, as it has fewer of them, or all to one side, where a recording begins or ends; and
  /// what the comparison errs by itself.
  const Eigen::MatrixXd& more_std() const { return more_std_; }
  /// How far a channel's scatter goes with what it measures: torques, by their mean.
  bool scales(std::size_t channel) const { return channels_[channel].starts_with("torque"); }

 private:
  std::optional<LeftOut> add(std::size_t window, std::vector<Eigen::VectorXd>& rows);
  WindowInput shifted(std::size_t i) const;
  bool touches(std::size_t i, const WindowZone& zone) const;
  std::optional<Eigen::VectorXd> predicted_in(std::size_t i, const WindowQuestion& question,
                                              const WindowMotions* known) const;
  std::vector<SoilStretch> stretches_in(std::size_t i, const std::vector<WindowZone>& zones) const;
  SoilStretch stretch_of(const WindowZone& zone) const;
  void shift(WindowInput& input, std::size_t window, std::size_t which, double deviations) const;
  Eigen::VectorXd vector_of(const WindowPrediction& prediction) const;
  std::optional<Eigen::VectorXd> measured_in(std::size_t window) const;
  bool has_input(std::size_t drive) const;
  void choose_channels();
  std::vector<double> sample_stds(const std::string& channel) const;
  std::vector<double> mean_stds(const std::string& channel,
                                const std::vector<double>& of_samples) const;
  void estimate_rim_std();
  void estimate_sampled_std();
  void measure_sizes();
  void estimate_more_std();
  Eigen::MatrixXd model_std() const;

  const std::vector<DriveRecording>& drives_;
  const std::vector<DriveWindow>& windows_;
  const TerrainMap& map_;
  const Vehicle& vehicle_;
  double gravity_mps2_;
  WindowModel model_;
  int threads_;
  std::vector<std::string> channels_;
  std::vector<std::size_t> torque_wheels_;
  bool has_attitude_ = false;
  std::vector<std::size_t> windows_of_;
  std::vector<bool> unbalanced_;  ///< of each window
  std::vector<WindowInput> inputs_;
  std::vector<std::array<double, kMaxWheels>> rim_std_rad_s_;  ///< of the windows' means
  std::vector<bool> soils_driven_;
  std::vector<double> sampled_std_;
  std::vector<std::vector<double>> sample_stds_;  ///< by channel and drive: torques, attitude
  Eigen::MatrixXd sizes_, more_std_;
  Eigen::MatrixXd measured_, shifts_;
  WindowsUsed used_;
};

}  // namespace regoplan
