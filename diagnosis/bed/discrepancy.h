#pragma once

#include <Eigen/Cholesky>
#include <array>
#include <memory>
#include <vector>

#include "diagnosis/bed/wheel_bed.h"

namespace regoplan {

/// Scales over which an unnamed smooth discrepancy changes.
struct DiscrepancyScales {
  double slip = 0.3;
  double slip_angle_rad = 0.25;
  double log_load = 0.8;
};

/// Whether what is missing is the same to either side, as of a wheel on level soil; a turned
/// sensor, a tilt or furrows of the bed make it another.
enum class Sides { kMirrored, kApart };

/// One setting of the discrepancy of a channel.
struct DiscrepancySetting {
  double amplitude = 0;    ///< one of kDiscrepancyAmplitudes
  std::size_t scales = 0;  ///< index into discrepancy_scales()
  Sides sides = Sides::kMirrored;
};

const std::vector<DiscrepancyScales>& discrepancy_scales();

/// Log prior of sides apart over the same mirrored: on level soil they are mirrored by a law, and
/// sensors and beds nearly always are level and straight.
inline constexpr double kApart_log_prior = -3;

/// What a discrepancy's standard deviation may be, in units of one run's noise: none first.
inline constexpr std::array kDiscrepancyAmplitudes{0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0};

/// All settings: no discrepancy first, then every amplitude with every scale, sides mirrored, and
/// last those of a run's noise twice and more with sides apart.
const std::vector<DiscrepancySetting>& discrepancy_settings();

/// Squared-exponential kernel of unit variance over slip, slip angle, log load, and pass, speed and
/// time where they vary. Where sides are mirrored the slip angle counts by its size,
/// and the side force's part is odd in it.
double discrepancy_kernel(const DiscrepancyScales& scales, Channel channel, const Condition& a,
                          const Condition& b, Sides sides = Sides::kMirrored);

using ConditionsAt = std::vector<const Condition*>;

/// The conditions of a channel, in the order of its values. They are the bed's own.
ConditionsAt conditions_of(const TestBed& bed, const ChannelData& data);

/// The kernel between all of `a`, one a row, and all of `b`.
Eigen::MatrixXd discrepancy_kernels(const DiscrepancyScales& scales, Channel channel,
                                    const ConditionsAt& a, const ConditionsAt& b,
                                    Sides sides = Sides::kMirrored);

/// Covariance of one channel under one setting, factored.
struct ChannelCovariance {
  Eigen::LLT<Eigen::MatrixXd> factor;
  double log_determinant = 0;
  Eigen::MatrixXd discrepancy;  ///< the part that is no noise; empty where there is none
};

/// Noise plus smooth discrepancy of all channels under all settings, each made when it is asked for
/// first: held-out fits need few of them. Threads may ask at once; copies share what is made.
class Discrepancy {
 public:
  explicit Discrepancy(const TestBed& bed);

  const ChannelCovariance& at(std::size_t channel, std::size_t setting) const;

 private:
  struct OfChannel;
  std::vector<std::shared_ptr<OfChannel>> channels_;
};

/// The Cholesky factor of each channel under its setting, as `whitened` takes it. What it is made
/// of must outlive it.
inline auto factors_under(const Discrepancy& discrepancy,
                          const std::vector<std::size_t>& settings) {
  return [&discrepancy, &settings](std::size_t channel) -> const Eigen::LLT<Eigen::MatrixXd>& {
    return discrepancy.at(channel, settings[channel]).factor;
  };
}

}  // namespace regoplan
