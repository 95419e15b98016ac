#include "drive_diagnosis/rolling_resistance.h"

#include "drive_diagnosis/recording/robust_statistics.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

double rolling_resistance(const Vehicle& vehicle, double gravity_mps2, const Soil& soil) {
  const double load_n = vehicle.mass_kg * gravity_mps2 / static_cast<double>(vehicle.wheels.size());
  const WheelModel wheel({.wheel = vehicle.wheel, .soil = soil, .gravity_mps2 = gravity_mps2},
                         WheelAccuracy::kFast);
  const auto at = [&](double slip) { return wheel.forces(load_n, motion_at(slip, 0)); };
  // Pull grows with slip; a wheel that pulls nothing may slip a little backwards.
  double below = -0.95, above = 0.95;
  constexpr int kHalvings = 20;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (below + above) / 2;
    (at(middle).fx_n < 0 ? below : above) = middle;
  }
  return at(above).torque_nm / (vehicle.wheel.radius_m * load_n);
}

DriveEstimate added_resistance(const Vehicle& vehicle, double gravity_mps2, const Soil& said,
                               const Soil& there, const std::vector<Soil>& draws) {
  constexpr double kBelow = 0.159, kAbove = 0.841;  // of a normal, one deviation off its mean
  std::vector<double> drawn;
  for (const Soil& soil : draws) drawn.push_back(rolling_resistance(vehicle, gravity_mps2, soil));
  return {rolling_resistance(vehicle, gravity_mps2, there) -
              rolling_resistance(vehicle, gravity_mps2, said),
          (quantile_value(drawn, kAbove) - quantile_value(drawn, kBelow)) / 2};
}

}  // namespace regoplan
