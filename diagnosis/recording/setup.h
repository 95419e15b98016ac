#pragma once

#include <map>
#include <optional>
#include <string>

#include "diagnosis/recording/recording.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// Who told a number of the noise that neither replicates nor the setup did.
enum class NoiseLender { kOtherSeries, kDifference };

/// What is known beforehand of wheel, soil and instruments.
struct DiagnosisSetup {
  WheelVariant variant = WheelVariant::kIshigami2007;
  Wheel wheel;
  std::optional<double> lug_height_m;  ///< 0: the wheel is smooth; nothing: not told
  std::optional<int> lug_count;
  double gravity_mps2 = 9.80665;
  UncertainSoil soil;                                  ///< what independent soil tests say
  std::map<Channel, double> noise_standard_deviation;  ///< where there are no replicates
  /// Those of the numbers above that a comparison tells, not the setup.
  std::map<Channel, NoiseLender> noise_lent = {};
};

/// A recording of the same rig and soil without the effect that is looked for.
struct Reference {
  std::string name;  ///< of its file
  Recording recording;
  DiagnosisSetup setup;  ///< its wheel may be another
};

}  // namespace regoplan
