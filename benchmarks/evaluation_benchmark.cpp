// Time of judging a path of 200 m over 1000 draws of its soil, two threads: the whole, and its
// parts. `error` is what the surrogate takes off, `direct` how many draws the wheel model judged.
#include <benchmark/benchmark.h>

#include <cmath>

#include "planner/evaluation/evaluation.h"
#include "planner/evaluation/manoeuvres.h"
#include "terramech/basics/angles.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

/// An LRV that winds its way over firm lunar regolith of which twelve numbers are uncertain.
struct WindingPath {
  PreparedManoeuvre prepared;
  World world;

  WindingPath() : prepared(slalom()), world(prepared.problem, WorldUse::kVerdict, 1) {}

  static PreparedManoeuvre slalom() {
    const Vehicle lrv = preset_vehicle("lrv");
    const MapSoil soil{.name = "firm_regolith",
                       .source = "as in the demo",
                       .soil = {.mean = named_soils::firm_regolith(),
                                .standard_deviation = {.cohesion_pa = 50,
                                                       .friction_angle_rad = 2 * kDegree,
                                                       .kc = 350,
                                                       .kphi = 2e5,
                                                       .n = 0,
                                                       .a0 = 0.05,
                                                       .a1 = 0.05,
                                                       .lambda = 0.1,
                                                       .density_kgpm3 = 50,
                                                       .kx0_m = 0.0045,
                                                       .kx1_m = 0.011,
                                                       .ky0_m = 0.0033,
                                                       .ky1_m = 0.005}}};
    const Limits limits = default_limits(lrv);
    const Manoeuvre manoeuvre{.kind = ManoeuvreKind::kSlalom,
                              .name = "winding",
                              .vehicle = lrv,
                              .soil = soil,
                              .speed_mps = 2,
                              .slope_rad = 3 * kDegree,
                              .amplitude_m = 2,
                              .wavelength_m = 27,
                              .waves = 5.5};
    ElevationRaster ground;
    ground.frame.columns = ground.frame.rows = 1;
    ground.frame.cell_width_m = ground.frame.cell_height_m = 1;
    ground.height_m = {0};
    const PlanningProblem base{
        .map = {ground, std::nullopt, {.soils = {soil}, .classes = {}, .unmapped = 0}, {}},
        .vehicle = lrv,
        .gravity_mps2 = 1.62,
        .limits = limits};
    return prepare(manoeuvre, limits, base);
  }
};

void report(benchmark::State& state, const PathEvaluation& e) {
  const PathMargins& error = e.spread->surrogate_error;
  state.counters["length_m"] = e.length_m;
  state.counters["draws"] = e.spread->draws;
  state.counters["direct"] = e.spread->direct_draws;
  state.counters["error"] = std::max({error.cornering, error.tip_over, error.traction});
  state.counters["margin_p05"] = e.spread->margin.p05;
}

/// Commanded path, driven path and soils.
void whole_evaluation(benchmark::State& state) {
  const WindingPath path;
  PathEvaluation last;
  for (auto _ : state) {
    last = evaluate(path.world, std::get<ReferencePath>(path.prepared.course),
                    {.soil_draws = static_cast<int>(state.range(0)), .threads = 2});
  }
  report(state, last);
}
BENCHMARK(whole_evaluation)->Arg(2)->Arg(1000)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The driven path alone.
void closed_loop_run(benchmark::State& state) {
  const WindingPath path;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        track(path.world, std::get<ReferencePath>(path.prepared.course), {}, 1));
  }
}
BENCHMARK(closed_loop_run)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace regoplan
