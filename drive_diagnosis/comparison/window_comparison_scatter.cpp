// How far what WindowComparison compares scatters, by what samples and fixes tell.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drive_diagnosis/comparison/channel_samples.h"
#include "drive_diagnosis/comparison/window_comparison.h"
#include "drive_diagnosis/recording/fix_scatter.h"
#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {

/// How far samples of a channel scatter, by drive.
std::vector<double> WindowComparison::sample_stds(const std::string& name) const {
  std::vector<double> of_drives;
  for (const DriveRecording& drive : drives_) of_drives.push_back(sample_std(drive, name));
  return of_drives;
}

/// How far windows' means of a channel scatter, by neighbouring samples of their whole drive.
std::vector<double> WindowComparison::mean_stds(const std::string& name,
                                                const std::vector<double>& of_samples) const {
  std::vector<double> of_windows;
  for (const std::size_t i : windows_of_) {
    const std::size_t drive = windows_[i].drive;
    const int samples = samples_in(drives_[drive], windows_[i], name);
    of_windows.push_back(samples > 0 ? of_samples[drive] / std::sqrt(samples) : 0);
  }
  return of_windows;
}

void WindowComparison::estimate_rim_std() {
  rim_std_rad_s_.resize(windows_of_.size());
  for (std::size_t k = 0; k < vehicle_.wheels.size(); ++k) {
    const std::string rim = fmt::format("wheel_speed_{}_rad_s", vehicle_.wheels[k].name);
    const std::vector<double> stds = mean_stds(rim, sample_stds(rim));
    for (std::size_t i = 0; i < stds.size(); ++i) rim_std_rad_s_[i].at(k) = stds[i];
  }
}

void WindowComparison::estimate_sampled_std() {
  sampled_std_.assign(channels_.size(), 0);
  sample_stds_.resize(channels_.size());
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    if (!scales(k) && channels_[k] != "pitch_rad" && channels_[k] != "roll_rad") continue;
    if (windows_of_.empty()) continue;
    sample_stds_[k] = sample_stds(channels_[k]);
    sampled_std_[k] = median_value(mean_stds(channels_[k], sample_stds_[k]));
  }
}

void WindowComparison::measure_sizes() {
  sizes_ = Eigen::MatrixXd::Zero(measured_.rows(), measured_.cols());
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    if (!scales(k)) continue;
    for (std::size_t i = 0; i < windows_of_.size(); ++i) {
      const DriveWindow& window = windows_[windows_of_[i]];
      sizes_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          mean_size(drives_[window.drive], window, channels_[k]);
    }
  }
}

void WindowComparison::estimate_more_std() {
  more_std_ = Eigen::MatrixXd::Zero(measured_.rows(), measured_.cols());
  std::vector<FixScatter> of_drives;
  for (const DriveRecording& drive : drives_) of_drives.push_back(fix_scatter(drive));
  constexpr std::size_t kSmoothed = 3;  // channels: velocity along and across, yaw rate
  std::array<std::vector<double>, kSmoothed> stds;
  for (const std::size_t i : windows_of_) {
    const DriveWindow& window = windows_[i];
    const FixScatter& fix = of_drives[window.drive];
    const double velocity_mps = fix.position_m * window.velocity_by_fix_1ps;
    stds[0].push_back(velocity_mps);
    stds[1].push_back(std::hypot(velocity_mps, window.speed_mps * fix.yaw_rad * window.yaw_by_fix));
    stds[2].push_back(fix.yaw_rad * window.yaw_rate_by_fix_1ps);
  }
  for (std::size_t k = 0; k < kSmoothed && !windows_of_.empty(); ++k) {
    const double of_most = median_value(stds.at(k));
    for (std::size_t i = 0; i < windows_of_.size(); ++i) {
      const double std = stds.at(k)[i];
      more_std_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          std::sqrt(std::max(0.0, std * std - of_most * of_most));
    }
  }
  more_std_ = (more_std_.cwiseAbs2() + model_std().cwiseAbs2()).cwiseSqrt();
}

/// What the comparison errs by itself: motions are sought at some places of a window only, and
/// polynomials stand for them in between, as lines do between samples. It counts where sensors are
/// better than any, as of a simulated drive without scatter.
Eigen::MatrixXd WindowComparison::model_std() const {
  constexpr double kVelocity_mps = 5e-4, kYawRate_rad_s = 1e-4, kAttitude_rad = 1e-4;
  constexpr double kTorqueShare = 2e-3;
  Eigen::MatrixXd stds = kTorqueShare * sizes_;  // of torques alone
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    if (!scales(k)) continue;
    for (std::size_t i = 0; i < windows_of_.size(); ++i) {
      const DriveWindow& window = windows_[windows_of_[i]];
      double& std = stds(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
      std = std::hypot(std, step_error(drives_[window.drive], window, channels_[k],
                                       sample_stds_[k][window.drive]));
    }
  }
  stds.leftCols(2).setConstant(kVelocity_mps);
  stds.col(2).setConstant(kYawRate_rad_s);
  if (has_attitude_) stds.middleCols(3, 2).setConstant(kAttitude_rad);
  return stds;
}

}  // namespace regoplan
