#pragma once

#include <Eigen/Core>
#include <stop_token>
#include <string>
#include <vector>

#include "diagnosis/recording/condition_groups.h"
#include "diagnosis/recording/setup.h"

namespace regoplan {

/// Degrees of freedom from which on replicates tell the noise, whatever neighbouring conditions
/// scatter: chosen on nulls of a few replicates, of which 5 of 50 were accused where contrasts were
/// counted to 6, and 0 now.
inline constexpr int kEnoughReplicates = 8;

enum class NoiseSource { kReplicates, kSetup, kNeighbours };

/// Scatter of one channel: a run's variance is constant^2 + (proportional y)^2, and every day has
/// an offset and a share of the signal of its own.
struct ChannelNoise {
  Channel channel = Channel::kFx;
  NoiseSource source = NoiseSource::kReplicates;
  double constant = 0;
  double proportional = 0;
  double day_offset = 0;
  double day_gain = 0;
  /// No condition was run on two days, as far as the recording says: half of the scatter was taken,
  /// of every day that it names or of all of it.
  bool day_assumed = false;
  /// Days that a recording which tells neither days nor times may have had: rounds of replicates.
  std::size_t untold_days = 0;
  /// What replicates say of each step of days' differences, told or not; empty: nothing.
  std::vector<double> day_log_likelihood = {};
  /// Restricted log likelihood of the replicates, less half a nat for each part but the constant.
  double log_likelihood = 0;
  /// Of replicates, for a run's own scatter: without what days and other parts take of them, and
  /// without outliers.
  int degrees_of_freedom = 0;
  /// By as many its scatter is known, where neighbouring conditions tell it; 0 elsewhere.
  int neighbour_degrees_of_freedom = 0;
  std::vector<double> weight;         ///< per run, in [0, 1]: below 1 for outliers
  std::vector<std::size_t> outliers;  ///< runs
  double trend = 0;                   ///< factor of the trend column that was given
};

/// One channel of every run: its value moved to its condition's mean load, slip and slip angle, and
/// what the model has for the run itself.
struct ChannelRuns {
  Channel channel = Channel::kFx;
  std::vector<double> adjusted, modelled;
};

/// Noise from replicates: restricted maximum likelihood over the contrasts within conditions, with
/// outliers (3.5 standard deviations from their fellows) weighted down. Without replicates (fewer
/// than 4 degrees of freedom) the setup's number; without that the scatter between neighbouring
/// conditions, which counts some of the signal as noise and so errs on the cautious side. So does
/// that scatter where few replicates (fewer than 8 degrees) tell less and do not contradict it.
/// \param trend per run: a column that explains part of what replicates differ by, its factor
/// fitted along; empty: none
/// \throws InputError where all replicates of the channel are identical; Interrupted
ChannelNoise estimate_noise(const Recording& recording, const std::vector<Condition>& conditions,
                            const ChannelRuns& runs, const DiagnosisSetup& setup,
                            const std::vector<double>& trend = {},
                            const std::stop_token& stop = {});

/// Days are few, and what a few happen to show says little of what they do to all runs alike; a
/// channel may by chance not show what the bed did to all of them. Gives each channel the mean
/// square of day offsets that its replicates and those of the other channels leave likely, not the
/// likeliest one; where no days are told, what the mean of the days there may have been is off by.
void share_day_offsets(std::vector<ChannelNoise>& noise);

/// Standard deviation of one run that measures y, without its day's part.
double run_deviation(const ChannelNoise& noise, double y);

/// The same where y is as large as these values in the root mean square; those not measured (NaN)
/// do not count.
double usual_deviation(const ChannelNoise& noise, const std::vector<double>& values);

/// Correlation between channels of what replicates scatter. \return channels x channels
Eigen::MatrixXd noise_correlation(const std::vector<ChannelNoise>& noise,
                                  const std::vector<Condition>& conditions,
                                  const std::vector<std::vector<double>>& adjusted);

}  // namespace regoplan
