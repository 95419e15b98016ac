// What the soil gives to one wheel: drawbar pull, side force, torque and sinkage over the slip.
#include <terramech/terramech.h>

#include <cstdio>
#include <numbers>

#include "regolith.h"

int main() {
  const regoplan::WheelModel model({.wheel = regoplan::preset_vehicle("lrv").wheel,
                                    .soil = firm_regolith(),
                                    .gravity_mps2 = 1.62});
  const double load_n = 290, slip_angle_rad = 6 * std::numbers::pi / 180;
  std::printf("slip  Fx [N]  Fy [N]  torque [Nm]  sinkage [mm]\n");
  double side_before_n = 1e9;
  for (const double slip : {0.0, 0.1, 0.2, 0.4, 0.6}) {
    const regoplan::WheelForces f = model.forces(load_n, regoplan::motion_at(slip, slip_angle_rad));
    std::printf("%4.1f  %6.1f  %6.1f  %11.1f  %12.1f\n", slip, f.fx_n, f.fy_n, f.torque_nm,
                1000 * f.sinkage_m);
    if (!(f.fy_n < side_before_n)) return 1;  // a wheel loses side force as it slips
    side_before_n = f.fy_n;
  }
  return 0;
}
