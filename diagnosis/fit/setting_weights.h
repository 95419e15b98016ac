#pragma once

#include <vector>

#include "diagnosis/bed/discrepancy.h"

namespace regoplan {

/// Log prior weights over discrepancy_settings(), the same for every channel.
struct SettingWeights {
  std::vector<double> log_weight;
  /// Largest amplitude that counts, per channel; empty: all count.
  std::vector<double> most_amplitude = {};

  bool excludes(std::size_t channel, std::size_t setting) const;

  static SettingWeights of_named();        ///< small discrepancies likelier, large ones possible
  static SettingWeights of_none();         ///< at most one run's noise
  static SettingWeights of_unexplained();  ///< any, small or large
  /// Every amplitude up to the cap of its channel alike.
  static SettingWeights up_to(std::vector<double> most_amplitude);
};

}  // namespace regoplan
