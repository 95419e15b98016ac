#include "benchmarks/planner/random_problem.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "planner/search/search_processes.h"
#include "planner/verdict/verified_path.h"
#include "terramech/basics/input_error.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

constexpr double kSize_m = 40;

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

/// Height over a place.
std::function<double(double x_m, double y_m)> drawn_ground(Draw& draw) {
  const double bump_m = draw.between(0, 0.4), wave_m = draw.between(4, 10);
  // A bank across the way, 1 to 5 m high over 5 m: up to 45 degrees.
  const double bank_m = draw.chance(0.5) ? draw.between(1, 5) : 0, bank_x_m = draw.between(16, 22);
  return [=](double x_m, double y_m) {
    const double share = std::clamp((x_m - bank_x_m) / 5, 0.0, 1.0);
    return bump_m * std::sin(x_m / wave_m) * std::cos(y_m / wave_m) + bank_m * share;
  };
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
    const auto ground = drawn_ground(draw);
    PlanningProblem problem =
        lrv_problem(one_soil_map(kSize_m, firm_regolith(), ground, drawn_rocks(draw)));
    problem.start = {.x_m = 5, .y_m = draw.between(10, 30)};
    problem.goal = {.x_m = 35, .y_m = draw.between(10, 30), .radius_m = 2, .heading_rad = {}};
    problem.speed_max_mps = 2;
    problem.limits.margin_min = 0;
    problem.search = {.time_s = {}, .iterations = 1000, .seed = seed, .threads = 1};
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
  bool given = false, passed = false;
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
        passed = verify(verdict, searched, {.planner = run.planner, .controls = outcome->controls})
                     .candidate.verified.passed;
      },
      {});
  return passed;
}

}  // namespace regoplan
