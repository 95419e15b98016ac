#include "app/diagnose/modelled_recording.h"

#include <fmt/format.h>

#include <cmath>

namespace regoplan {

bool is_length(Channel channel) {
  return channel == Channel::kSinkage || channel == Channel::kRutLeft ||
         channel == Channel::kRutRight;
}

ModelledRecording::ModelledRecording(const RecordingFile& file, const DiagnosisSetup& setup)
    : file_(file),
      wheel_(setup.wheel),
      model_({.variant = setup.variant,
              .wheel = setup.wheel,
              .soil = setup.soil.mean,
              .gravity_mps2 = setup.gravity_mps2},
             WheelAccuracy::kFast) {
  for (const WheelRun& run : runs()) {
    at_.push_back(model_.channels(run.load_n, motion_at(run.slip_ratio, run.slip_angle_rad)));
  }
}

double ModelledRecording::modelled(std::size_t run, Channel channel) const {
  const WheelChannels& at = at_[run];
  switch (channel) {
    case Channel::kFx:
      return at.forces.fx_n;
    case Channel::kFy:
      return at.forces.fy_n;
    case Channel::kTorque:
      return at.forces.torque_nm;
    case Channel::kSinkage:
      return at.forces.sinkage_m;
    case Channel::kRutLeft:
      return at.rut_left_m;
    case Channel::kRutRight:
      return at.rut_right_m;
  }
  return 0;
}

double ModelledRecording::reach(std::size_t run, Channel channel) const {
  if (is_length(channel)) return wheel_.radius_m;
  return channel == Channel::kTorque ? runs()[run].load_n * wheel_.radius_m : runs()[run].load_n;
}

bool ModelledRecording::is_measured(Channel channel) const {
  return std::ranges::find(file_.recording.channels, channel) != file_.recording.channels.end();
}

bool ModelledRecording::is_comparable(std::size_t run, Channel channel) const {
  return !std::isnan(runs()[run].value(channel)) && has_forces(at_[run].forces.status);
}

std::string ModelledRecording::place(std::size_t run) const {
  return fmt::format("{}:{}", file_.file, file_.lines[run]);
}

double ModelledRecording::correlation(Channel channel) const {
  std::vector<std::pair<double, double>> pairs;
  double mean = 0, model_mean = 0;
  for (std::size_t i = 0; i < runs().size(); ++i) {
    if (!is_comparable(i, channel)) continue;
    pairs.push_back(
        {runs()[i].value(channel) / reach(i, channel), modelled(i, channel) / reach(i, channel)});
    mean += pairs.back().first;
    model_mean += pairs.back().second;
  }
  mean /= static_cast<double>(pairs.size());
  model_mean /= static_cast<double>(pairs.size());
  double both = 0, own = 0, of_model = 0;
  for (const auto& [value, expected] : pairs) {
    both += (value - mean) * (expected - model_mean);
    own += std::pow(value - mean, 2);
    of_model += std::pow(expected - model_mean, 2);
  }
  return own * of_model > 0 ? both / std::sqrt(own * of_model) : 0;
}

}  // namespace regoplan
