#pragma once

#include <vector>

#include "diagnosis/bed/wheel_bed.h"
#include "diagnosis/fit/effect.h"

namespace regoplan {

/// What effects are to explain: a recording against the model as a whole; in part, where carried
/// soil is a form of lugs; or against a reference, where the soil may have changed too.
enum class EffectsOf { kRecording, kPart, kDifference };

/// Every form of every mechanism and instrument fault that the recording can bear, each from every
/// starting point it needs. Lugs whose height or number the setup tells are taken as told.
std::vector<Effect> effects_for(const TestBed& bed, const Recording& recording,
                                EffectsOf of = EffectsOf::kRecording);

}  // namespace regoplan
