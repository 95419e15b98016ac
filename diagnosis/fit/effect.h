#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/fit/coordinate.h"

namespace regoplan {

enum class EffectKind {
  kMechanism,
  kBias,
  kGain,
  kCrosstalk,  ///< a share of one channel in another
  kTurn,       ///< a sensor of two forces turned about the axis across both
};

/// What is there of an instrument's bias or gain, t from 0 at the first condition to 1 at the last.
enum class FaultCourse {
  kConstant,  ///< 1
  kSettling,  ///< exp(-(time - first time)/settling_time_s): an amplifier that warms up
  kDrifting,  ///< t
  kForATime,  ///< 1 from `from_s` to `to_s`, else 0: a zero that was set anew
};

/// One form of one thing that may be wrong: a mechanism of the wheel or a fault of an instrument.
struct Effect {
  std::string id;
  std::string form;
  EffectKind kind = EffectKind::kMechanism;
  std::vector<Coordinate> coordinates;
  std::map<std::string, double> fixed;
  std::size_t to = 0, from = 0;   ///< instruments: index into TestBed::channels
  std::vector<std::size_t> also;  ///< further channels that the same fault acts on
  FaultCourse course = FaultCourse::kConstant;
  std::vector<double> start;  ///< x to start a fit from
  /// Its last coordinate is a factor on kx and ky of the soil: the modulus of another shear law is
  /// not the one that soil tests state.
  bool own_modulus = false;
  bool slow = false;  ///< its stress integrals are some thirty times slower
};

/// Whether an id is a fault of instruments and not physics of wheel and soil.
bool is_instrument(const std::string& id);

/// Whether what it does is known to the last term, so that no other form of it can be meant: a
/// sensor's bias, constant gain and crosstalk, a scale, a tilt.
bool has_one_form(const Effect& effect);

/// Whether nothing but the time of the runs tells it from other effects: two of these together
/// would share one course in time in any way one likes.
bool is_told_by_time(const Effect& effect);

}  // namespace regoplan
