// A wheel model with what the base model leaves out: the known mechanisms, and one of them added.
#include <terramech/terramech.h>

#include <cstdio>

#include "regolith.h"

int main() {
  using namespace regoplan;
  for (const MechanismForm& known : mechanism_forms()) {
    std::printf("%.*s (%.*s)\n", static_cast<int>(known.id.size()), known.id.data(),
                static_cast<int>(known.form.size()), known.form.data());
  }
  WheelModelSpec spec{
      .wheel = preset_vehicle("lrv").wheel, .soil = firm_regolith(), .gravity_mps2 = 1.62};
  const WheelModel base(spec);
  spec.mechanisms = {{.id = "slip_sinkage", .form = {}, .parameters = {}}};  // typical numbers
  const WheelModel sinking(spec);
  const WheelMotion slipping = motion_at(0.5, 0);
  const double base_m = base.forces(290, slipping).sinkage_m;
  const double more_m = sinking.forces(290, slipping).sinkage_m;
  std::printf("sinkage at slip 0.5: %.1f mm, with slip sinkage %.1f mm\n", 1000 * base_m,
              1000 * more_m);
  return more_m > base_m ? 0 : 1;
}
