#include "diagnosis/fit/setting_weights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace regoplan {
namespace {

/// \param of_amplitude weights of kDiscrepancyAmplitudes
SettingWeights weights_of(const std::array<double, kDiscrepancyAmplitudes.size()>& of_amplitude) {
  const double scales = static_cast<double>(discrepancy_scales().size());
  double sum = 0;
  for (const double w : of_amplitude) sum += w;
  SettingWeights weights;
  for (const DiscrepancySetting& setting : discrepancy_settings()) {
    const auto amplitude = std::ranges::find(kDiscrepancyAmplitudes, setting.amplitude) -
                           kDiscrepancyAmplitudes.begin();
    const double w = of_amplitude.at(static_cast<std::size_t>(amplitude)) / sum /
                     (setting.amplitude > 0 ? scales : 1);
    const double sides = setting.sides == Sides::kApart ? kApart_log_prior : 0;
    weights.log_weight.push_back(w > 0 ? std::log(w) + sides : -1e300);
  }
  return weights;
}

}  // namespace

SettingWeights SettingWeights::of_named() {
  return weights_of({.4, .3, .2, .07, .02, .006, .003, .001});
}
SettingWeights SettingWeights::of_none() {
  return weights_of({.5, .3, .2, 0, 0, 0, 0, 0});
}
SettingWeights SettingWeights::of_unexplained() {
  return weights_of({.1, .1, .13, .13, .13, .13, .13, .13});
}

SettingWeights SettingWeights::up_to(std::vector<double> most_amplitude) {
  SettingWeights weights = weights_of({1, 1, 1, 1, 1, 1, 1, 1});
  weights.most_amplitude = std::move(most_amplitude);
  return weights;
}

bool SettingWeights::excludes(std::size_t channel, std::size_t setting) const {
  if (log_weight[setting] < -1e200) return true;
  return !most_amplitude.empty() &&
         discrepancy_settings()[setting].amplitude > most_amplitude[channel];
}

}  // namespace regoplan
