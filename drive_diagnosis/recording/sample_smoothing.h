#pragma once

#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// A parabola through scattered samples (least squares); of fewer than five a line, of fewer than
/// three their mean. NaN where the samples do not say.
struct SampleSmoothing {
  double value = kNotSampled, slope = kNotSampled;  ///< at time 0
  double bend = 0;                                  ///< second derivative
  double slope_std = kNotSampled;                   ///< from how samples scatter about it
  /// Standard deviations by that of one sample.
  double value_by_sample = kNotSampled, slope_by_sample = kNotSampled;
  int count = 0;
  std::vector<double> time_s, left;   ///< of each sample: its time, and how far off it lies
  std::vector<double> slope_weights;  ///< the slope is the weights' sum over the samples

  double at(double t_s) const;
  /// How far samples lie off from one time to another, in the mean; between two of them, on the
  /// line through them; nothing beyond the first and the last.
  double left_in(double from_s, double to_s) const;
  /// How much of the slope is the mean slope from one time to another.
  double share(double from_s, double to_s) const;
};

/// \param time_s of each sample, about the time that value and slope are told at
SampleSmoothing smoothed(const std::vector<double>& time_s, const std::vector<double>& values);

}  // namespace regoplan
