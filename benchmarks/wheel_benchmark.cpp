// Speed and accuracy of the wheel model on one core. `x_boost` is the ratio to the naive way:
// adaptive Gauss-Kronrod quadrature and a bracketing root finder of Boost, measured in the same
// run.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "terramech/force_table/force_table.h"
#include "terramech/wheel/wheel_model.h"
#include "tests/terramech/wheel_reference.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

struct Conditions {
  std::vector<double> loads_n;
  std::vector<WheelMotion> motions;
};

/// Loads log-uniform over 10 to 250 % of nominal, motions over the trusted domain.
Conditions random_conditions(double nominal_load_n) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> slip(-0.9, 0.95);
  std::uniform_real_distribution<double> angle(-std::numbers::pi / 3, std::numbers::pi / 3);
  std::uniform_real_distribution<double> log_load(std::log(0.1), std::log(2.5));
  Conditions conditions;
  for (int i = 0; i < 4096; ++i) {
    const double s = slip(random);
    conditions.loads_n.push_back(nominal_load_n * std::exp(log_load(random)));
    conditions.motions.push_back(motion_at(s, angle(random)));
  }
  return conditions;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// One evaluation in the naive way, to a tolerance of 1e-6.
double naive_seconds(const WheelModelSpec& spec, double nominal_load_n) {
  const wheel_reference::Reference reference(spec, 1e-6);
  const Conditions at = random_conditions(nominal_load_n);
  constexpr std::size_t kCount = 100;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < kCount; ++i) {
    benchmark::DoNotOptimize(
        reference.forces(at.loads_n[i], slip_ratio(at.motions[i]), slip_angle_rad(at.motions[i])));
  }
  return seconds_since(start) / kCount;
}

void report(benchmark::State& state, double seconds_per_item, const WheelModelSpec& spec,
            double nominal_load_n) {
  state.counters["x_boost"] = naive_seconds(spec, nominal_load_n) / seconds_per_item;
}

/// Evaluates one condition after the other.
template <class F>
void evaluate(benchmark::State& state, const wheel_specs::NamedSpec& named, F forces) {
  const Conditions at = random_conditions(named.nominal_load_n);
  std::size_t i = 0;
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) {
    benchmark::DoNotOptimize(forces(at.loads_n[i], at.motions[i]));
    i = (i + 1) % at.motions.size();
  }
  const double seconds = seconds_since(start);
  state.SetItemsProcessed(state.iterations());
  report(state, seconds / static_cast<double>(state.iterations()), named.spec,
         named.nominal_load_n);
}

ForceTable table_of(const wheel_specs::NamedSpec& named) {
  return ForceTable({.model = named.spec, .nominal_load_n = named.nominal_load_n, .accuracy = {}});
}

void direct(benchmark::State& state, const wheel_specs::NamedSpec& named, WheelAccuracy accuracy) {
  const WheelModel model(named.spec, accuracy);
  evaluate(state, named,
           [&](double load_n, const WheelMotion& motion) { return model.forces(load_n, motion); });
}

void construct(benchmark::State& state, const wheel_specs::NamedSpec& named) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(WheelModel(named.spec, WheelAccuracy::kFast));
  }
}

void table_scalar(benchmark::State& state, const wheel_specs::NamedSpec& named) {
  const ForceTable table = table_of(named);
  evaluate(state, named,
           [&](double load_n, const WheelMotion& motion) { return table.forces(load_n, motion); });
}

/// The same model with a mechanism: what it costs, and (direct_exact) that none costs nothing.
void mechanism(benchmark::State& state, const wheel_specs::NamedSpec& named, const char* id) {
  WheelModelSpec spec = named.spec;
  spec.mechanisms = {{id, "", {}}};
  const WheelModel model(spec);
  evaluate(state, named,
           [&](double load_n, const WheelMotion& motion) { return model.forces(load_n, motion); });
}

void table_slopes(benchmark::State& state, const wheel_specs::NamedSpec& named) {
  const ForceTable table = table_of(named);
  evaluate(state, named, [&](double load_n, const WheelMotion& motion) {
    return table.forces_with_slopes(load_n, motion);
  });
}

void table_batch(benchmark::State& state, const wheel_specs::NamedSpec& named) {
  const ForceTable table = table_of(named);
  const Conditions at = random_conditions(named.nominal_load_n);
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) benchmark::DoNotOptimize(table.plane_forces(at.loads_n, at.motions));
  const double items =
      static_cast<double>(state.iterations()) * static_cast<double>(at.motions.size());
  const double seconds = seconds_since(start);
  state.SetItemsProcessed(static_cast<std::int64_t>(items));
  report(state, seconds / items, named.spec, named.nominal_load_n);
}

/// Builds the table with its own check of 40,000 states.
void table_build(benchmark::State& state, const wheel_specs::NamedSpec& named) {
  for (auto _ : state) benchmark::DoNotOptimize(table_of(named));
}

/// Measures a million states and a hundred thousand near corners, and decides by FC against random
/// demands.
void table_check(benchmark::State& state, const wheel_specs::NamedSpec& named) {
  for (auto _ : state) {
  }
  const ForceTable table = table_of(named);
  const TableError random = table.check(1000000, 0, 7);
  const TableError corners = table.check(0, 100000, 8);
  state.counters["kB"] = static_cast<double>(table.bytes()) / 1000;
  state.counters["error_99.9"] = random.at_999_permille;
  state.counters["error_worst"] = random.at_worst;
  state.counters["corner_worst"] = corners.at_worst;
  state.counters["load_max"] = table.load_max_n() / named.nominal_load_n;

  const double angle_max = std::numbers::pi / 3;
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> slip(-0.9, 0.95), angle(-angle_max, angle_max),
      demand(-1, 1), load(0.1, 0.9);
  constexpr int kStates = 1000000;
  int disagree = 0, outside_bound = 0;
  for (int i = 0; i < kStates; ++i) {
    const double beta = angle(generator), load_n = load(generator) * table.load_max_n();
    const WheelMotion motion = motion_at(slip(generator), beta);
    const auto fc_n = [&](const WheelForces& forces) {
      return forces.fx_n * std::sin(beta) + forces.fy_n * std::cos(beta);
    };
    const double wanted_n = demand(generator) * load_n;
    const double by_direct = fc_n(table.direct().forces(load_n, motion));
    const bool accept = fc_n(table.forces(load_n, motion)) >= wanted_n;
    if (accept == (by_direct >= wanted_n)) continue;
    ++disagree;
    const double bound_n =
        std::numbers::sqrt2 * table.error().at_worst * std::max(load_n, 0.1 * named.nominal_load_n);
    outside_bound += accept && by_direct < wanted_n - bound_n;
  }
  state.counters["agree"] = 1 - static_cast<double>(disagree) / kStates;
  state.counters["wrong_accepts"] = outside_bound;
}

void naive(benchmark::State& state, const wheel_specs::NamedSpec& named) {
  const wheel_reference::Reference reference(named.spec, 1e-6);
  const Conditions at = random_conditions(named.nominal_load_n);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        reference.forces(at.loads_n[i], slip_ratio(at.motions[i]), slip_angle_rad(at.motions[i])));
    i = (i + 1) % at.motions.size();
  }
  state.SetItemsProcessed(state.iterations());
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const wheel_specs::NamedSpec& named : wheel_specs::all()) {
    const auto add = [&](const std::string& what, auto run) {
      return benchmark::RegisterBenchmark((what + "/" + named.name).c_str(), run);
    };
    add("naive", [named](benchmark::State& state) { naive(state, named); });
    add("direct_exact",
        [named](benchmark::State& state) { direct(state, named, WheelAccuracy::kExact); });
    add("direct_fast",
        [named](benchmark::State& state) { direct(state, named, WheelAccuracy::kFast); });
    add("with_slip_sinkage",
        [named](benchmark::State& state) { mechanism(state, named, "slip_sinkage"); });
    for (const char* id : {"coupled_shear", "shear_hump", "layered_soil", "rut_asymmetry"}) {
      add(std::string("with_") + id,
          [named, id](benchmark::State& state) { mechanism(state, named, id); });
    }
    add("construct", [named](benchmark::State& state) { construct(state, named); });
    add("table_scalar", [named](benchmark::State& state) { table_scalar(state, named); });
    add("table_slopes", [named](benchmark::State& state) { table_slopes(state, named); });
    add("table_batch", [named](benchmark::State& state) { table_batch(state, named); });
  }
  for (const named_soils::NamedPair& pair : named_soils::shipped_pairs()) {
    const wheel_specs::NamedSpec named{pair.name, pair.spec, pair.nominal_load_n};
    benchmark::RegisterBenchmark(("table_build/" + named.name).c_str(),
                                 [named](benchmark::State& state) { table_build(state, named); })
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("table_check/" + named.name).c_str(),
                                 [named](benchmark::State& state) { table_check(state, named); })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace regoplan
