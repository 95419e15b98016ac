#include "diagnosis/bed/wheel_bed.h"

#include <algorithm>

#include "terramech/basics/input_error.h"
#include "terramech/basics/interruption.h"

namespace regoplan {

std::optional<std::array<double, kChannelCount>> channels_at(const WheelModel& model, double load_n,
                                                             double slip_ratio,
                                                             double slip_angle_rad,
                                                             const WheelConditions& conditions) {
  const WheelMotion motion = motion_at(slip_ratio, slip_angle_rad);
  if (model.spec().mechanisms.empty() && conditions.sinkage_offset_m == 0) {
    const WheelForces f = model.forces(load_n, motion);
    if (!has_forces(f.status)) return std::nullopt;
    return std::array{f.fx_n, f.fy_n, f.torque_nm, f.sinkage_m, f.sinkage_m, f.sinkage_m};
  }
  const WheelChannels c = model.channels(load_n, motion, conditions);
  if (!has_forces(c.forces.status)) return std::nullopt;
  return std::array{c.forces.fx_n,      c.forces.fy_n, c.forces.torque_nm,
                    c.forces.sinkage_m, c.rut_left_m,  c.rut_right_m};
}

Eigen::Index TestBed::size() const {
  return offset(channels.size());
}

Eigen::Index TestBed::offset(std::size_t channel) const {
  Eigen::Index sum = 0;
  for (std::size_t c = 0; c < channel; ++c) sum += channels[c].mean.size();
  return sum;
}

Eigen::VectorXd TestBed::measured() const {
  Eigen::VectorXd all(size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    all.segment(offset(c), channels[c].mean.size()) = channels[c].mean;
  }
  return all;
}

std::optional<Eigen::VectorXd> predict(const TestBed& bed, const Soil& soil,
                                       const std::vector<Mechanism>& mechanisms) {
  try {
    const WheelModelSpec spec{.variant = bed.setup.variant,
                              .wheel = bed.setup.wheel,
                              .soil = soil,
                              .gravity_mps2 = bed.setup.gravity_mps2,
                              .mechanisms = mechanisms};
    const WheelModel model = bed.base_model ? WheelModel(spec, bed.accuracy, *bed.base_model)
                                            : WheelModel(spec, bed.accuracy);
    std::vector<std::array<double, kChannelCount>> values;
    values.reserve(bed.conditions.size());
    for (const Condition& at : bed.conditions) {
      throw_if_stopped(bed.stop);
      const auto value =
          channels_at(model, at.load_n, at.slip_ratio, at.slip_angle_rad, at.conditions);
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
    Eigen::VectorXd all(bed.size());
    Eigen::Index i = 0;
    for (const ChannelData& data : bed.channels) {
      for (const std::size_t k : data.conditions) {
        all[i++] = values[k][static_cast<std::size_t>(data.channel)];
      }
    }
    if (!all.allFinite()) return std::nullopt;
    return all;
  } catch (const InputError&) {  // a trial soil beyond what is valid
    return std::nullopt;
  }
}

namespace {

Eigen::VectorXd variances_off_in(const TestBed& bed, std::size_t channel,
                                 const Eigen::VectorXd& prediction) {
  const ChannelData& data = bed.channels[channel];
  const Eigen::VectorXd off = data.mean - prediction.segment(bed.offset(channel), data.mean.size());
  return off.array().square() / data.noise.diagonal().array();
}

}  // namespace

double variances_off(const TestBed& bed, const Eigen::VectorXd& prediction) {
  double sum = 0;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    sum += variances_off_in(bed, c, prediction).sum();
  }
  return sum;
}

std::vector<double> deviations_off(const TestBed& bed, const Eigen::VectorXd& prediction) {
  std::vector<double> deviations;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    deviations.push_back(std::sqrt(std::max(1.0, variances_off_in(bed, c, prediction).mean())));
  }
  return deviations;
}

TestBed with_noise_widened(TestBed bed, const std::vector<double>& factors) {
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    bed.channels[c].noise *= factors[c] * factors[c];
  }
  return bed;
}

WheelAccuracy sufficient_accuracy(const TestBed& bed) {
  constexpr double kFarAboveError = 5e-3;  // kFast: 1.3e-4 of the load
  double load = 0;
  for (const Condition& at : bed.conditions) load = std::max(load, at.load_n);
  const double r = bed.setup.wheel.radius_m;
  const std::array<double, kChannelCount> unit{load, load, load * r, r / 10, r / 10, r / 10};
  for (const ChannelData& data : bed.channels) {
    if (data.scale < kFarAboveError * unit[static_cast<std::size_t>(data.channel)]) {
      return WheelAccuracy::kExact;
    }
  }
  return WheelAccuracy::kFast;
}

}  // namespace regoplan
