#pragma once

#include "benchmarks/diagnosis/measurement.h"

namespace regoplan::challenge {

/// How far something stands out of the noise: root of the sum of squares of the noise-free
/// difference from the base model over the standard deviation of the mean of the replicates.
struct Signal {
  double before = 0;  ///< against the base model at the prior means
  double after = 0;   ///< that remains when the soil numbers are calibrated within their priors
};

/// Of effects and faults on a rig; nothing where a wheel sinks in.
std::optional<Signal> signal_of(const Rig& rig, const MeasurementNoise& noise,
                                const std::vector<DrawnEffect>& effects,
                                const std::vector<InstrumentFault>& faults);

/// What the first of several effects adds beyond the others, after calibration: their recordings
/// with and without it, told apart by a calibration of the soil numbers.
std::optional<double> share_of_signal(const Rig& rig, const MeasurementNoise& noise,
                                      const DrawnEffect& effect,
                                      const std::vector<DrawnEffect>& others);

}  // namespace regoplan::challenge
