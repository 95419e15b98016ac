#pragma once

#include <memory>
#include <vector>

#include "diagnosis/fit/effect_list.h"
#include "diagnosis/names/calibrated_recording.h"
#include "synthetic_bed.h"

namespace regoplan {

/// A recording calibrated, and the mechanisms that are tried of it.
struct TriedNames {
  explicit TriedNames(const TrueWheel& truth) : setup(simulant_setup()) {
    const Recording recording = record(truth, setup, setup.soil.mean, {.conditions = 32}, 3);
    calibrated = std::make_unique<CalibratedRecording>(recording, setup);
    effects = effects_for(calibrated->bed(), recording, EffectsOf::kPart);
  }
  DiagnosisSetup setup;
  std::unique_ptr<CalibratedRecording> calibrated;
  std::vector<Effect> effects;
};

}  // namespace regoplan
