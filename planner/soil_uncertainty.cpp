#include "planner/soil_uncertainty.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <thread>

namespace regoplan {
namespace {

/// The judged states that stand for the whole path.
std::vector<VehicleState> decisive_states(const Replay& verified) {
  constexpr std::size_t kSmallest = 10, kSpread = 4;
  std::vector<std::size_t> order(verified.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return verified.points[a].margin < verified.points[b].margin;
  });
  std::set<std::size_t> chosen(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                                  kSmallest, order.size())));
  for (std::size_t i = 0; i < kSpread; ++i) {
    chosen.insert(i * (order.size() - 1) / (kSpread - 1));
  }
  std::vector<VehicleState> states;
  for (const std::size_t i : chosen) states.push_back(verified.judged[i].state);
  return states;
}

/// The smallest margin of the states on one draw of the soils.
double smallest_margin(const PlanningProblem& problem, const std::vector<VehicleState>& states,
                       std::uint64_t seed, int draw_number) {
  std::seed_seq sequence{seed, static_cast<std::uint64_t>(draw_number)};
  std::mt19937_64 random(sequence);
  std::vector<WheelModel> models;
  for (const MapSoil& soil : problem.map.soils()) {
    models.emplace_back(wheel_model_spec(problem, draw(soil.soil, random)), WheelAccuracy::kFast);
  }
  const std::vector<WheelLaw> laws(models.begin(), models.end());
  const GroundFinder ground(problem.map, problem.vehicle);
  const VehicleDynamics dynamics(
      problem.vehicle, laws,
      [&](double x_m, double y_m, double yaw_rad) { return ground.at(x_m, y_m, yaw_rad); },
      problem.gravity_mps2);
  const SupportPolygon polygon(problem.vehicle);
  const SolvedSupply supply(problem.vehicle, dynamics.sharing(), laws, trim_limits(problem));
  double smallest = 1;
  for (const VehicleState& state : states) {
    const GroundPatch patch = ground.at(state.x_m, state.y_m, state.yaw_rad);
    const SupplyQuestion question = question_of(dynamics, state, patch);
    const StateMargins margins = margins_of(dynamics, polygon, question, supply.answer(question));
    const double cornering = margins.cornering.value_or(-1);
    // Beyond the supply no trim gives traction either; the cornering margin tells by how much.
    const double traction = margins.traction.value_or(std::min(cornering, 0.0));
    smallest = std::min({smallest, cornering, traction, margins.tip_over});
  }
  return smallest;
}

}  // namespace

MarginSpread margin_spread(const PlanningProblem& problem, const Replay& verified, int draws,
                           std::uint64_t seed, int threads) {
  const std::vector<VehicleState> states = decisive_states(verified);
  std::vector<double> smallest(static_cast<std::size_t>(draws));
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i = next++; i < draws; i = next++) {
      smallest[static_cast<std::size_t>(i)] = smallest_margin(problem, states, seed, i);
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(work);
    work();
  }
  std::sort(smallest.begin(), smallest.end());
  const auto allowed = std::count_if(smallest.begin(), smallest.end(), [&](double margin) {
    return margin >= problem.limits.margin_min;
  });
  const auto below = static_cast<std::size_t>(std::floor(0.05 * draws));
  return {.p05 = smallest[std::min(below, smallest.size() - 1)],
          .probability_feasible = static_cast<double>(allowed) / draws};
}

}  // namespace regoplan
