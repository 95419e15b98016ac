// Queries of a map of 1024 x 1024 cells and 2000 rocks.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "maps/ground_finder.h"
#include "maps/terrain_map.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

constexpr int kCells = 1024;
constexpr double kSize_m = 0.5 * kCells;

const TerrainMap& rocky_hills() {
  static const TerrainMap map = [] {
    ElevationRaster elevation{.frame = {.columns = kCells,
                                        .rows = kCells,
                                        .west_m = 0,
                                        .north_m = kSize_m,
                                        .cell_width_m = 0.5,
                                        .cell_height_m = 0.5},
                              .height_m = {}};
    for (int row = 0; row < kCells; ++row) {
      for (int column = 0; column < kCells; ++column) {
        elevation.height_m.push_back(
            static_cast<float>(3 * std::sin(column / 40.0) * std::cos(row / 60.0)));
      }
    }
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(1, kSize_m - 1), radius(0.1, 0.6);
    std::vector<Rock> rocks;
    for (int i = 0; i < 2000; ++i) {
      const double r = radius(random);
      rocks.push_back({place(random), place(random), r, r});
    }
    SoilCatalogue soils{
        .soils = {{.name = "firm_regolith",
                   .source = "as in the demo",
                   .soil = {.mean = named_soils::firm_regolith(), .standard_deviation = {}}}},
        .classes = {},
        .unmapped = 0};
    return TerrainMap(std::move(elevation), std::nullopt, std::move(soils), std::move(rocks));
  }();
  return map;
}

struct Place {
  double x_m, y_m;
};

/// The same places for all benchmarks.
Place place(std::size_t i) {
  static const std::vector<Place> places = [] {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> at(5, kSize_m - 5);
    std::vector<Place> drawn(4096);
    for (Place& one : drawn) one = {at(random), at(random)};
    return drawn;
  }();
  return places[i % places.size()];
}

constexpr double kReach_m = 2;

bool touches(const Rock& rock, const Place& at) {
  return std::hypot(rock.x_m - at.x_m, rock.y_m - at.y_m) < rock.radius_m + kReach_m;
}

/// Whether a rock lies within reach, every rock asked.
void rocks_one_by_one(benchmark::State& state) {
  const std::vector<Rock>& rocks = rocky_hills().rocks();
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Place at = place(i++);
    benchmark::DoNotOptimize(std::any_of(rocks.begin(), rocks.end(),
                                         [&](const Rock& rock) { return touches(rock, at); }));
  }
}
BENCHMARK(rocks_one_by_one);

void rocks_by_index(benchmark::State& state) {
  const RockIndex index(rocky_hills().rocks());
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Place at = place(i++);
    benchmark::DoNotOptimize(index.any_of(at.x_m - kReach_m, at.x_m + kReach_m, at.y_m - kReach_m,
                                          at.y_m + kReach_m,
                                          [&](const Rock& rock) { return touches(rock, at); }));
  }
}
BENCHMARK(rocks_by_index);

/// One height, bilinear.
void height(benchmark::State& state) {
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Place at = place(i++);
    benchmark::DoNotOptimize(rocky_hills().height_m(at.x_m, at.y_m));
  }
}
BENCHMARK(height);

/// The ground under a whole vehicle: plane, soils and curvature.
void ground_patch(benchmark::State& state) {
  const Vehicle lrv = preset_vehicle("lrv");
  const GroundFinder ground(rocky_hills(), lrv);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Place at = place(i++);
    benchmark::DoNotOptimize(ground.at(at.x_m, at.y_m, 0.7));
  }
}
BENCHMARK(ground_patch);

}  // namespace
}  // namespace regoplan
