#include "terramech/force_table/force_table.h"

#include "terramech/basics/vector_clones.h"
#include "terramech/force_table/force_table_lookup.h"
#include "terramech/wheel/corrected_forces.h"

namespace regoplan {

using namespace force_table;

bool ForceTable::covers(double load_n, const WheelMotion& motion) const {
  return place(values_, load_n, motion).inside;
}

REGOPLAN_VECTOR_CLONES WheelForces ForceTable::forces(double load_n,
                                                      const WheelMotion& motion) const {
  const Place at = place(values_, load_n, motion);
  if (!at.inside) [[unlikely]]
    return direct_.forces(load_n, motion);
  const Weights<Four> weights = force_table::weights(at.at, intervals(values_));
  const Four channels = look_up(block(values_, at, weights), narrow(weights.value, kLoad),
                                narrow(weights.value, kSlip), narrow(weights.value, kLateral));
  const double radius_m = spec_.model.wheel.radius_m;
  const ConstantShares& constant = values_.constant;
  const double x_load_n = at.x_sign * load_n;
  const Vec forces = __builtin_convertvector(channels, Vec) *
                         Vec{x_load_n, at.y_sign * load_n, x_load_n * radius_m, radius_m} +
                     Vec{load_n * constant.x, load_n * constant.y, 0, 0};
  const WheelForces looked_up{.fx_n = forces[kFx],
                              .fy_n = forces[kFy],
                              .torque_nm = forces[kTorque],
                              .sinkage_m = forces[kSinkage],
                              .status = at.trusted ? WheelStatus::kOk : WheelStatus::kUntrusted};
  const auto& generic = spec_.model.generic;
  return generic ? corrected(*generic, load_n, motion, looked_up) : looked_up;
}

std::size_t ForceTable::bytes() const {
  return values_.coefficients.size() * sizeof(float);
}

}  // namespace regoplan
