// Speed of the vehicle's mechanics: a step of its motion, supply solved and looked up, one core.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "terramech/force_table/force_table.h"
#include "terramech/margins/state_margins.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

using named_soils::kMoon_mps2;

enum class Law { kDirectFast, kDirectExact, kTable };

/// An LRV on firm lunar regolith.
struct Lrv {
  Vehicle vehicle = preset_vehicle("lrv");
  double weight_n = vehicle.mass_kg * kMoon_mps2;
  WheelModel model;
  std::optional<ForceTable> table;
  WheelLaw law;
  std::vector<WheelLaw> laws;
  LoadSharing sharing{vehicle};
  TrimLimits limits{.slip_angle_max_rad = vehicle.slip_angle_max_rad,
                    .slip_max = vehicle.slip_max,
                    .sinkage_max_m = vehicle.sinkage_max_m,
                    .steer_angle_max_rad = vehicle.steer_angle_max_rad};

  explicit Lrv(Law kind)
      : model({.variant = WheelVariant::kIshigami2007,
               .wheel = vehicle.wheel,
               .soil = named_soils::firm_regolith(),
               .gravity_mps2 = kMoon_mps2},
              kind == Law::kDirectExact ? WheelAccuracy::kExact : WheelAccuracy::kFast),
        table(kind == Law::kTable
                  ? std::optional<ForceTable>(ForceTableSpec{
                        .model = model.spec(),
                        .nominal_load_n = weight_n / static_cast<double>(vehicle.wheels.size()),
                        // as searches use it
                        .accuracy = {.at_999_permille = 5e-3, .at_worst = 2e-2}})
                  : std::nullopt),
        law(table ? WheelLaw(*table) : WheelLaw(model)),
        laws(vehicle.wheels.size(), law) {}
  Lrv(const Lrv&) = delete;
  Lrv& operator=(const Lrv&) = delete;
};

/// Curvatures and forward forces as searches ask for.
struct Asked {
  double curvature_1pm = 0;
  double forward_n = 0;
};
std::vector<Asked> questions(const Lrv& lrv) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<Asked> asked(256);
  for (Asked& one : asked) {
    one.curvature_1pm = lrv.vehicle.curvature_max_1pm * share(random);
    one.forward_n = 0.3 * lrv.weight_n * share(random);
  }
  return asked;
}

VehicleDynamics on_a_slope(const Lrv& lrv) {
  const GroundPatch patch{
      .known = true, .z_m = 0, .slope_forward = 0.05, .slope_left = 0.05, .soil = {}};
  return {lrv.vehicle, lrv.laws, [patch](double, double, double) { return patch; }, kMoon_mps2};
}

/// A slalom on a slope, started anew every 10 s.
void vehicle_step(benchmark::State& state, Law law, double speed_mps, double step_s) {
  const Lrv lrv(law);
  const VehicleDynamics dynamics = on_a_slope(lrv);
  const VehicleState start = dynamics.rolling_state(0, 0, 0, speed_mps);
  VehicleState at = start;
  const int steps = static_cast<int>(10 / step_s);
  int i = 0;
  for ([[maybe_unused]] auto _ : state) {
    if (i % steps == 0) at = start;
    const double side = i++ / (steps / 4) % 2 == 0 ? 0.05 : -0.05;
    at = dynamics.step(at, {.speed_target_mps = speed_mps, .curvature_target_1pm = side}, step_s)
             .state;
    benchmark::DoNotOptimize(at);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(vehicle_step, table_3_mps, Law::kTable, 3, 0.1);
BENCHMARK_CAPTURE(vehicle_step, table_0p3_mps, Law::kTable, 0.3, 0.1);
BENCHMARK_CAPTURE(vehicle_step, table_0p05_mps, Law::kTable, 0.05, 0.5);
BENCHMARK_CAPTURE(vehicle_step, fast_3_mps, Law::kDirectFast, 3, 0.1);
BENCHMARK_CAPTURE(vehicle_step, exact_3_mps, Law::kDirectExact, 3, 0.1);
BENCHMARK_CAPTURE(vehicle_step, exact_3_mps_fine, Law::kDirectExact, 3, 0.01);
BENCHMARK_CAPTURE(vehicle_step, fast_0p05_mps, Law::kDirectFast, 0.05, 0.5);

/// A slalom of a minute: what a step costs in accuracy. `error_mm_per_m` is how far the end lies
/// from that of steps of 1/512 s, per metre driven.
void slalom_of_a_minute(benchmark::State& state, double speed_mps) {
  const Lrv lrv(Law::kTable);
  const VehicleDynamics dynamics = on_a_slope(lrv);
  const auto slalom = [&](double step_s) {
    VehicleState at = dynamics.rolling_state(0, 0, 0, speed_mps);
    const auto per_bend = static_cast<int>(std::lround(6 / step_s));
    for (int i = 0; i < 10 * per_bend; ++i) {
      const double side = i / per_bend % 2 == 0 ? 0.05 : -0.05;
      at = dynamics.step(at, {.speed_target_mps = speed_mps, .curvature_target_1pm = side}, step_s)
               .state;
    }
    return at;
  };
  const double step_s = 1 / static_cast<double>(state.range(0));
  const VehicleState exact = slalom(1.0 / 512);
  VehicleState at;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(at = slalom(step_s));
  state.counters["step_s"] = step_s;
  state.counters["error_mm_per_m"] =
      1e3 * std::hypot(at.x_m - exact.x_m, at.y_m - exact.y_m) / (60 * speed_mps);
}
BENCHMARK_CAPTURE(slalom_of_a_minute, at_3_mps, 3)
    ->RangeMultiplier(2)
    ->Range(1, 64)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(slalom_of_a_minute, at_0p3_mps, 0.3)
    ->RangeMultiplier(2)
    ->Range(1, 64)
    ->Unit(benchmark::kMillisecond);

void supply_solved(benchmark::State& state, Law law) {
  const Lrv lrv(law);
  const std::vector<Asked> asked = questions(lrv);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Asked& one = asked[i++ % asked.size()];
    const SteadyManoeuvre manoeuvre(lrv.vehicle, lrv.sharing, lrv.laws, one.curvature_1pm,
                                    lrv.weight_n);
    benchmark::DoNotOptimize(cornering_supply(manoeuvre, one.forward_n, lrv.limits));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(supply_solved, table, Law::kTable);
BENCHMARK_CAPTURE(supply_solved, fast, Law::kDirectFast);
BENCHMARK_CAPTURE(supply_solved, exact, Law::kDirectExact);

/// A curve of 100 trims: lateral force from none to what the slip angle allows, each trim from the
/// one before.
void supply_curve(benchmark::State& state, Law law) {
  const Lrv lrv(law);
  const SteadyManoeuvre manoeuvre(lrv.vehicle, lrv.sharing, lrv.laws, 0.1, lrv.weight_n);
  const ForceLine line{.from = {}, .per_unit = {.forward_n = 0, .left_n = lrv.weight_n}};
  for ([[maybe_unused]] auto _ : state) {
    auto at = manoeuvre.solve_from_rolling(line);
    constexpr int kTrims = 100;
    for (int i = 1; i < kTrims && at; ++i) {
      (*at)[3] = 0.5 * i / kTrims;
      at = manoeuvre.solve(*at, line);
      benchmark::DoNotOptimize(at);
    }
    if (!at) state.SkipWithError("no trim");
  }
}
BENCHMARK_CAPTURE(supply_curve, table, Law::kTable)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(supply_curve, fast, Law::kDirectFast)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(supply_curve, exact, Law::kDirectExact)->Unit(benchmark::kMillisecond);

SupplyTable table_of(const Lrv& lrv) {
  constexpr double kTiltMax_rad = 25 * std::numbers::pi / 180;
  return {lrv.vehicle, lrv.law, lrv.limits, lrv.weight_n, kTiltMax_rad, 1};
}

void supply_looked_up(benchmark::State& state) {
  const Lrv lrv(Law::kDirectFast);
  const SupplyTable table = table_of(lrv);
  const std::vector<Asked> asked = questions(lrv);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Asked& one = asked[i++ % asked.size()];
    benchmark::DoNotOptimize(table.supply(one.curvature_1pm, one.forward_n, lrv.weight_n));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(supply_looked_up);

/// Margins of a state from the supply table, as searches ask at every step.
void margins_looked_up(benchmark::State& state) {
  const Lrv lrv(Law::kTable);
  const std::vector<SupplyTable> tables{table_of(lrv)};
  const TabledSupply supply(tables);
  const SupportPolygon polygon(lrv.vehicle);
  const GroundPatch patch{
      .known = true, .z_m = 0, .slope_forward = 0.05, .slope_left = 0.05, .soil = {}};
  const VehicleDynamics dynamics(
      lrv.vehicle, lrv.laws, [&](double, double, double) { return patch; }, kMoon_mps2);
  VehicleState at = dynamics.rolling_state(0, 0, 0, 3, 0.02);
  for ([[maybe_unused]] auto _ : state) {
    at.motion.vx_mps = 5 - at.motion.vx_mps;
    const SupplyQuestion question = question_of(dynamics, at, patch);
    benchmark::DoNotOptimize(margins_of(dynamics, polygon, question,
                                        supply.answer(question, lrv.vehicle.wheels.size())));
  }
}
BENCHMARK(margins_looked_up);

void supply_table_built(benchmark::State& state) {
  const Lrv lrv(Law::kDirectFast);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(table_of(lrv));
}
BENCHMARK(supply_table_built)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace regoplan
