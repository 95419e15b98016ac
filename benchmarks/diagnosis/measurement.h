#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/diagnosis/rig.h"

namespace regoplan::challenge {

using ChannelValues = std::array<double, kChannelCount>;

/// Something wrong with the instruments, not with the physics.
struct InstrumentFault {
  /// sensor_bias, sensor_gain, sensor_crosstalk, sensor_turned, slip_scale, load_cell
  std::string id;
  Channel channel = Channel::kFx;
  Channel from = Channel::kFy;  ///< of a crosstalk; the other channel of a turned sensor
  double amount = 0;            ///< the channel's unit (bias), rad (turned), else a share
};

/// How the test bed scatters. Channel arrays in the order of Channel.
struct MeasurementNoise {
  ChannelValues sigma{};       ///< at zero signal, the channel's unit
  double growth = 0;           ///< standard deviation that grows with the signal, share of it
  double outliers = 0;         ///< share of values that are off by 4 to 9 standard deviations
  double tail_dof = 0;         ///< of Student's t; 0: normal
  double day_offset = 0;       ///< standard deviation, in units of sigma
  double day_gain = 0;         ///< standard deviation, share
  double load_error = 0;       ///< of the load cell from run to run, share: couples the channels
  double load_spread = 0;      ///< of the run's load about the commanded one, share; recorded
  double common = 0;           ///< correlation of the forces' noise
  double memory = 0;           ///< correlation of a run's noise with that of the run before
  double slip_jitter = 0.003;  ///< within the tolerance of replicates
  double angle_jitter_rad = 0.002;
};

MeasurementNoise draw_noise(Random& random, const Rig& rig);

/// Standard deviation of one value of a channel.
double noise_sigma(const MeasurementNoise& noise, Channel channel, double value);

/// What perfect but for their faults instruments would show, NaN where not measured; nothing where
/// the wheel sinks in.
std::optional<ChannelValues> ideal_values(const Rig& rig, const RigCondition& condition,
                                          const std::vector<DrawnEffect>& effects,
                                          const std::vector<InstrumentFault>& faults);

/// The whole recording, with every number rounded as it stands in the file; nothing where the wheel
/// sinks in.
std::optional<Recording> record(Random& random, const Rig& rig, const MeasurementNoise& noise,
                                const std::vector<DrawnEffect>& effects,
                                const std::vector<InstrumentFault>& faults);

}  // namespace regoplan::challenge
