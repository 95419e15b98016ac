// Planners on one problem: an LRV on 50 m of firm regolith, a boulder between start and goal.
#include <benchmark/benchmark.h>
#include <ompl/util/Console.h>

#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

PlanningProblem past_a_boulder() {
  return lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 3, 2}}));
}

const World& boulder_world() {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  static const PlanningProblem problem = past_a_boulder();
  static const World world(problem, WorldUse::kSearch, 2);
  return world;
}

constexpr int kSeeds = 10;

/// The first path, of as many seeds as iterations; the world with its tables stands already.
void first_path(benchmark::State& state, const char* planner) {
  const World& world = boulder_world();
  std::uint64_t seed = 0;
  for ([[maybe_unused]] auto _ : state) {
    PlannerRun run(world, planner, false, ++seed);
    if (run.solve(200000) != ompl::base::PlannerStatus::EXACT_SOLUTION) {
      state.SkipWithError("no path");
      break;
    }
  }
}
BENCHMARK_CAPTURE(first_path, rrt, "RRT")->Unit(benchmark::kMillisecond)->Iterations(kSeeds);
BENCHMARK_CAPTURE(first_path, kpiece1, "KPIECE1")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kSeeds);
BENCHMARK_CAPTURE(first_path, stable_sparse, "StableSparse")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kSeeds);
BENCHMARK_CAPTURE(first_path, lattice, "Lattice")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kSeeds);

/// Tables, cost-to-go and limits of a problem, before any search.
void world_prepared(benchmark::State& state) {
  const PlanningProblem problem = past_a_boulder();
  for ([[maybe_unused]] auto _ : state) {
    const World world(problem, WorldUse::kSearch, 2);
    benchmark::DoNotOptimize(&world);
  }
}
BENCHMARK(world_prepared)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace regoplan
