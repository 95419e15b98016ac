#pragma once

#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// A wheel with its mechanisms: the base model on what they make of soil, wheel and motion, with
/// the stress integrals of their own where they change these. Load and motion must be valid.
WheelChannels mechanism_channels(const WheelModel& model, double load_n, const WheelMotion& motion,
                                 const WheelConditions& conditions);

/// The same under what the mechanisms have made of wheel, soil and load.
WheelChannels channels_under(const WheelModel& model, const Effects& effects,
                             const WheelState& state, const WheelMotion& motion);

}  // namespace regoplan
