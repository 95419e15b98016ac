// The largest speed at which an LRV holds a turn: demand, supply and margins on level ground.
#include <terramech/terramech.h>

#include <cstdio>
#include <vector>

#include "regolith.h"

int main() {
  using namespace regoplan;
  const Vehicle lrv = preset_vehicle("lrv");
  const WheelModel model({.wheel = lrv.wheel, .soil = firm_regolith(), .gravity_mps2 = 1.62});
  const std::vector<WheelLaw> laws{WheelLaw(model)};  // one for each soil
  const GroundPatch level{.known = true};
  const VehicleDynamics dynamics(
      lrv, laws, [&](double, double, double) { return level; }, 1.62);
  const MarginJudge judge(dynamics, laws,
                          {.slip_angle_max_rad = lrv.slip_angle_max_rad,
                           .slip_max = lrv.slip_max,
                           .sinkage_max_m = lrv.sinkage_max_m});
  double safe_mps = 0;
  for (double speed_mps = 0.5; speed_mps < 4; speed_mps += 0.25) {
    const StateMargins m =
        judge.margins(dynamics.rolling_state(0, 0, 0, speed_mps, 1 / 15.0), level);
    if (!m.stability()) break;
    std::printf("%.2f m/s: demand %.0f N, supply %.0f to %.0f N, margin %.3f\n", speed_mps,
                m.demand_n, m.supply->right_n, m.supply->left_n, *m.stability());
    if (*m.stability() < 0.05) break;
    safe_mps = speed_mps;
  }
  std::printf("a turn of 15 m radius is safe up to %.2f m/s\n", safe_mps);
  return safe_mps > 0 ? 0 : 1;
}
