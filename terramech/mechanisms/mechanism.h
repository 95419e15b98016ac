#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace regoplan {

/// Something that the base wheel model leaves out, in one of its published forms. Parameters that
/// are not named take the middle of their usual range.
struct Mechanism {
  std::string id;    ///< `slip_sinkage`, ...
  std::string form;  ///< `exponent`, ...; empty: the first form of the id
  std::map<std::string, double> parameters;
};

/// What some mechanisms need to know beside load and motion.
struct WheelConditions {
  int pass = 1;           ///< how often a wheel has come by, this time included
  double speed_mps = 0;   ///< travel speed; 0: that of the motion
  double position_m = 0;  ///< along the bed or map
  double time_s = 0;
  double heading_rad = 0;  ///< of the wheel, from the direction in which the bed was levelled
  double wheel_angle_rad = 0;
  double sinkage_offset_m = 0;  ///< measured sinkage without mechanisms over the model's, imposed
};

struct MechanismParameter {
  std::string_view name;  ///< unit included
  double low, high;       ///< usual range
  double typical;
  /// What it can be at all: beyond, what it stands for is none (a modulus below 0 pushes with the
  /// motion, a share is more than its whole, an exponent near 0 makes a step of a law).
  double least, most;
  bool is_share = false;  ///< of a whole, which is `most`
};

/// One functional form of a mechanism.
struct MechanismForm {
  std::string_view id;
  std::string_view form;
  std::string_view formula;
  std::string_view source;
  std::vector<MechanismParameter> parameters;
};

/// All forms of all mechanisms that act on a single wheel in steady state. Faults of instruments
/// (sensor_bias and the like) and transients (sensor_delay, actuator_lag) are not physics of the
/// wheel and not among them.
const std::vector<MechanismForm>& mechanism_forms();

/// The ids of the vocabulary, each once.
std::vector<std::string> mechanism_ids();

/// The form that a mechanism names.
/// \throws InputError where id, form or a parameter's name is unknown (listing the known ones), or
/// a parameter lies beyond what it can be
const MechanismForm& form_of(const Mechanism& mechanism);

}  // namespace regoplan
