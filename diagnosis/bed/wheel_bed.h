#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "diagnosis/bed/span.h"
#include "diagnosis/recording/condition_groups.h"
#include "diagnosis/recording/setup.h"

namespace regoplan {

/// All six channels of a model under one condition; nothing where the wheel has no forces.
std::optional<std::array<double, kChannelCount>> channels_at(const WheelModel& model, double load_n,
                                                             double slip_ratio,
                                                             double slip_angle_rad,
                                                             const WheelConditions& conditions);

/// What a channel measured, one value a condition.
struct ChannelData {
  Channel channel = Channel::kFx;
  std::vector<std::size_t> conditions;  ///< at which it was measured
  Eigen::VectorXd mean;                 ///< of the replicates, at the condition's own load
  Eigen::MatrixXd noise;                ///< covariance of the means, days included
  double scale = 0;                     ///< standard deviation of one run, middle of all
  /// What references tell that the model lacks there, and that was taken off the mean: a sensor
  /// reads it too. Empty where nothing was.
  Eigen::VectorXd shared = {};
};

/// The condensed recording: conditions, and per channel the means with their covariance. Vectors
/// over all channels hold one channel after the other.
struct TestBed {
  DiagnosisSetup setup;
  std::vector<Condition> conditions;
  std::vector<ChannelData> channels;
  /// When it was that replicates differ from those of all other times, if ever; where that touches
  /// the first or the last time, also the rest.
  std::vector<Span> times_apart_s = {};
  bool times_are_assumed = false;  ///< evenly in the order of the runs
  /// At the prior means: where the sinkages of other soils are sought from.
  std::shared_ptr<const WheelModel> base_model = {};
  WheelAccuracy accuracy = WheelAccuracy::kExact;  ///< fast where its error is far below the noise
  std::stop_token stop = {};  ///< all work on this bed throws Interrupted once it says so

  Eigen::Index size() const;
  Eigen::Index offset(std::size_t channel) const;  ///< where its values begin
  Eigen::VectorXd measured() const;
};

/// Model values in the order of TestBed::measured(); nothing where a condition has no forces or
/// the soil is not valid. \throws Interrupted as all that is computed of a bed
std::optional<Eigen::VectorXd> predict(const TestBed& bed, const Soil& soil,
                                       const std::vector<Mechanism>& mechanisms);

/// How far a prediction lies from the means: squared residuals over the variance of each, summed.
double variances_off(const TestBed& bed, const Eigen::VectorXd& prediction);

/// By channel, how far it lies from them in standard deviations of each, root mean square; at
/// least 1, since noise is no less than it is told.
std::vector<double> deviations_off(const TestBed& bed, const Eigen::VectorXd& prediction);

/// The same conditions with every channel's deviations of the noise multiplied.
TestBed with_noise_widened(TestBed bed, const std::vector<double>& factors);

/// The fast integration where every channel's noise is above 0.5 % of what the load makes of it.
WheelAccuracy sufficient_accuracy(const TestBed& bed);

}  // namespace regoplan
