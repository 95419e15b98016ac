#include "benchmarks/planner/random_problem.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "planner/candidate.h"
#include "planner/search_processes.h"
#include "terramech/input_error.h"

namespace regoplan {
namespace {

constexpr double kSize_m = 40, kCell_m = 0.5, kDegree = std::numbers::pi / 180;

SoilCatalogue firm_soil() {
  const UncertainSoil soil{.mean = {.cohesion_pa = 170,
                                    .friction_angle_rad = 35 * kDegree,
                                    .kc = 1400,
                                    .kphi = 8.2e5,
                                    .n = 1,
                                    .a0 = 0.40,
                                    .a1 = 0.15,
                                    .lambda = 0.9,
                                    .density_kgpm3 = 1600,
                                    .kx0_m = 0.018,
                                    .ky0_m = 0.013,
                                    .ky1_m = 0.020}};
  return {.soils = {{.name = "regolith", .source = "drawn", .soil = soil}},
          .classes = {},
          .unmapped = 0};
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool chance(double share) { return between(0, 1) < share; }

 private:
  std::mt19937_64 random_;
};

ElevationRaster drawn_ground(Draw& draw) {
  const int cells = static_cast<int>(kSize_m / kCell_m);
  ElevationRaster raster{.frame = {.columns = cells,
                                   .rows = cells,
                                   .west_m = 0,
                                   .north_m = kSize_m,
                                   .cell_width_m = kCell_m,
                                   .cell_height_m = kCell_m,
                                   .crs_wkt = {}},
                         .height_m = {}};
  const double bump_m = draw.between(0, 0.4), wave_m = draw.between(4, 10);
  // A bank across the way, 1 to 5 m high over 5 m: up to 45 degrees.
  const double bank_m = draw.chance(0.5) ? draw.between(1, 5) : 0, bank_x_m = draw.between(16, 22);
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const double x = (column + 0.5) * kCell_m, y = (row + 0.5) * kCell_m;
      const double share = std::clamp((x - bank_x_m) / 5, 0.0, 1.0);
      raster.height_m.push_back(static_cast<float>(
          bump_m * std::sin(x / wave_m) * std::cos(y / wave_m) + bank_m * share));
    }
  }
  return raster;
}

std::vector<Rock> drawn_rocks(Draw& draw) {
  std::vector<Rock> rocks;
  const auto strewn = static_cast<int>(draw.between(0, 25));
  for (int i = 0; i < strewn; ++i) {
    rocks.push_back(
        {draw.between(9, 31), draw.between(1, 39), draw.between(0.3, 1.5), draw.between(0.2, 2)});
  }
  if (draw.chance(0.6)) {
    const double x = draw.between(12, 28), gap_y = draw.between(4, 36);
    const double half_gap_m = draw.chance(0.5) ? draw.between(1, 4) : 0;
    for (double y = 0.4; y < kSize_m; y += 1.2) {
      if (std::abs(y - gap_y) > half_gap_m + 0.8) rocks.push_back({x, y, 0.8, 2});
    }
  }
  return rocks;
}

}  // namespace

PlanningProblem random_problem(std::uint64_t seed) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    Draw draw(seed * 1000 + attempt);
    ElevationRaster ground = drawn_ground(draw);
    const Vehicle lrv = preset_vehicle("lrv");
    PlanningProblem problem{
        .map = {std::move(ground), std::nullopt, firm_soil(), drawn_rocks(draw)},
        .vehicle = lrv,
        .gravity_mps2 = 1.62,
        .start = {.x_m = 5, .y_m = draw.between(10, 30)},
        .goal = {.x_m = 35, .y_m = draw.between(10, 30), .radius_m = 2, .heading_rad = {}},
        .speed_max_mps = 2,
        .limits = default_limits(lrv),
        .search = {.time_s = {}, .iterations = 1000, .seed = seed, .threads = 1}};
    problem.limits.margin_min = 0;
    try {
      validate(problem);
    } catch (const InputError&) {
      continue;  // a rock where the vehicle starts: another map
    }
    return problem;
  }
}

bool verified_path_found(const PlanningProblem& problem, const std::string& planner,
                         std::int64_t iterations) {
  const World searched(problem, WorldUse::kSearch, 1), verdict(problem, WorldUse::kVerdict, 1);
  std::vector<FoundPath> found;
  bool given = false;
  search_in_processes(
      searched, 1,
      [&]() -> std::optional<SearchRun> {
        if (std::exchange(given, true)) return std::nullopt;
        return SearchRun{
            .planner = planner,
            .guidance = {.seed = problem.search.seed, .margin_min = problem.limits.margin_min},
            .time_s = {},
            .iterations = iterations};
      },
      [&](const SearchRun& run, const std::optional<SearchOutcome>& outcome) {
        if (!outcome || outcome->controls.empty()) return;
        found.push_back({.planner = run.planner, .controls = outcome->controls});
      },
      {});
  return !verify_all(verdict, searched, found, [](const PlanProgress&) {}).passed.empty();
}

}  // namespace regoplan
