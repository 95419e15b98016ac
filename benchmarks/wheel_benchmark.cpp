// Speed of the wheel model, one core.
#include <benchmark/benchmark.h>

#include <numbers>
#include <random>
#include <vector>

#include "terramech/wheel_model.h"

namespace regoplan {
namespace {

struct Condition {
  double load_n;
  WheelMotion motion;
};

std::vector<Condition> random_conditions() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> load(10, 150), slip(-0.9, 0.95), angle(-1, 1);
  std::vector<Condition> conditions;
  for (int i = 0; i < 4096; ++i) {
    const double load_n = load(random), s = slip(random);
    conditions.push_back({load_n, motion_at(s, angle(random))});
  }
  return conditions;
}

WheelModelSpec simulant(double n) {
  return {.variant = WheelVariant::kIshigami2007,
          .wheel = {.radius_m = 0.09, .width_m = 0.10},
          .soil = {.cohesion_pa = 800,
                   .friction_angle_rad = 37.2 * std::numbers::pi / 180,
                   .kc = 1.37e3,
                   .kphi = 8.14e5,
                   .n = n,
                   .a0 = 0.40,
                   .a1 = 0.15,
                   .lambda = 0.9,
                   .density_kgpm3 = 1600,
                   .kx0_m = 0.036,
                   .kx1_m = 0.043,
                   .ky0_m = 0.013,
                   .ky1_m = 0.020}};
}

void direct(benchmark::State& state, WheelAccuracy accuracy, double n) {
  const WheelModel model(simulant(n), accuracy);
  const std::vector<Condition> conditions = random_conditions();
  std::size_t i = 0;
  for (auto _ : state) {
    const Condition& at = conditions[i++ % conditions.size()];
    benchmark::DoNotOptimize(model.forces(at.load_n, at.motion));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(direct, fast, WheelAccuracy::kFast, 1.0);
BENCHMARK_CAPTURE(direct, exact, WheelAccuracy::kExact, 1.0);
BENCHMARK_CAPTURE(direct, fast_n_0p9, WheelAccuracy::kFast, 0.9);
BENCHMARK_CAPTURE(direct, exact_n_0p9, WheelAccuracy::kExact, 0.9);

}  // namespace
}  // namespace regoplan
