#include "drive_diagnosis/rolling_resistance.h"

#include <cmath>
#include <random>

#include "terramech/wheel/wheel_model.h"

namespace regoplan {

double rolling_resistance(const Vehicle& vehicle, double gravity_mps2, const Soil& soil) {
  const double load_n = vehicle.mass_kg * gravity_mps2 / static_cast<double>(vehicle.wheels.size());
  const WheelModel wheel({.wheel = vehicle.wheel, .soil = soil, .gravity_mps2 = gravity_mps2},
                         WheelAccuracy::kFast);
  const auto at = [&](double slip) { return wheel.forces(load_n, motion_at(slip, 0)); };
  double below = 0, above = 0.95;  // pull grows with slip
  constexpr int kHalvings = 20;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (below + above) / 2;
    (at(middle).fx_n < 0 ? below : above) = middle;
  }
  return at(above).torque_nm / (vehicle.wheel.radius_m * load_n);
}

DriveEstimate added_resistance(const Vehicle& vehicle, double gravity_mps2, const Soil& said,
                               const UncertainSoil& there, std::uint64_t seed) {
  const double mean = rolling_resistance(vehicle, gravity_mps2, there.mean);
  std::mt19937_64 random(seed);
  constexpr int kDraws = 60;
  double squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double off =
        rolling_resistance(vehicle, gravity_mps2, draw(there, vehicle.wheel.width_m, random)) -
        mean;
    squares += off * off;
  }
  return {mean - rolling_resistance(vehicle, gravity_mps2, said), std::sqrt(squares / kDraws)};
}

}  // namespace regoplan
