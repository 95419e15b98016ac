#pragma once

#include "diagnosis/checks/shared_shortcomings.h"
#include "diagnosis/names/calibrated_recording.h"
#include "diagnosis/names/correction.h"

namespace regoplan {

/// The model handed out of a test that was compared: the base model with what tells the difference,
/// and an unnamed correction of what is left of the test as it was measured. On conditions that are
/// held out the reference tells what both share; so an effect that makes up for a shortcoming of
/// the base model is not given up for it. Where that predicts no better, it is the base model.
/// \param fit of the difference: the base model, or with the names claimed
/// \param proof of the fit's effects alone, of the difference
Correction model_of_test(const CalibratedRecording& difference, const MeasuredTest& measured,
                         const CandidateFit& fit, const HeldOut& proof, int threads);

}  // namespace regoplan
