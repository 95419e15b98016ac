#include "diagnosis/fit/effect.h"

namespace regoplan {

bool is_instrument(const std::string& id) {
  return id.starts_with("sensor_") || id == "slip_scale" || id == "load_transfer";
}

bool has_one_form(const Effect& effect) {
  if (effect.course != FaultCourse::kConstant) return false;
  return effect.id.starts_with("sensor_") || effect.id == "slip_scale" || effect.id == "slope_tilt";
}

bool is_told_by_time(const Effect& effect) {
  return effect.id == "cohesion_drift" || effect.form == "for_a_time" ||
         effect.form == "drifting" || effect.course != FaultCourse::kConstant;
}

}  // namespace regoplan
