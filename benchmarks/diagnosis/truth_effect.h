#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "benchmarks/diagnosis/truth_wheel.h"

namespace regoplan::challenge {

/// What a recording must vary or measure before an effect can show in it.
struct Needs {
  bool side = false;        ///< slip angles to 15 deg and beyond, fy
  bool both_sides = false;  ///< slip angles of both signs
  bool skid = false;        ///< negative slip
  bool torque = false;
  bool sinkage = false;
  bool loads = false;  ///< three loads
  bool passes = false;
  bool speeds = false;  ///< four speeds
  bool positions = false;
  bool times = false;
  bool sweep = false;  ///< replicates that repeat the order of the runs
};

/// One published or invented form of something that the base model leaves out.
struct TruthEffect {
  std::string_view id;  ///< of the vocabulary; of effects on no list: a name of our own
  std::string_view form;
  std::string_view source;
  double low = 0, high = 0;  ///< amplitude, in the form's own unit
  bool either_sign = false;
  Needs needs = {};
  /// \param amplitude signed \param shape in [0, 1], sets the form's further constants
  TruthPhysics (*act)(TruthPhysics p, double amplitude, double shape) = nullptr;
  /// What the effect does to the channels once the wheel has found its sinkage; may be absent.
  TruthChannels (*after)(TruthChannels c, const TruthPhysics& p, double amplitude,
                         double shape) = nullptr;
};

/// An effect with its numbers.
struct DrawnEffect {
  const TruthEffect* effect = nullptr;
  double amplitude = 0;
  double shape = 0.5;
};

/// At least two forms of most ids of the vocabulary, none of them a form of
/// terramech/mechanisms/mechanism.h.
const std::vector<TruthEffect>& listed_effects();

/// The parts of that list.
std::vector<TruthEffect> effects_on_sinkage();
std::vector<TruthEffect> effects_on_shear();
std::vector<TruthEffect> effects_on_sides();
std::vector<TruthEffect> effects_on_carriage();

/// Effects on no list: whoever gives them a name of the vocabulary is wrong.
const std::vector<TruthEffect>& unlisted_effects();

/// Effects that follow time, the order of the runs or the place, and nothing that is set.
const std::vector<TruthEffect>& drift_effects();

/// Effects by which the days of a series differ, or that pass in its course, runs at times of their
/// own: two or three days of replicates may look like a bed and sensors that vary by the day.
const std::vector<TruthEffect>& effects_in_days();

/// The wheel with the effects, one after the other.
std::optional<TruthChannels> channels_with(const std::vector<DrawnEffect>& effects,
                                           const TruthPhysics& base);

}  // namespace regoplan::challenge
