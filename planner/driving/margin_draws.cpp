#include "planner/driving/margin_draws.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "planner/soils/soil_uncertainty.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

/// Where the drive at the mean soils came nearest to each limit of its wheels' strain.
void add_most_strained(const std::vector<TrajectoryPoint>& points,
                       const std::vector<std::size_t>& of, std::set<std::size_t>& places) {
  for (const double TrajectoryPoint::*strain :
       {&TrajectoryPoint::slip_max, &TrajectoryPoint::slip_angle_max_rad,
        &TrajectoryPoint::sinkage_max_m}) {
    places.insert(*std::ranges::max_element(
        of, {}, [&](std::size_t i) { return std::abs(points[i].*strain); }));
  }
}

/// The judged states that stand for the whole path: on each soil those where margins are smallest
/// and wheels are strained most at the mean soils, as a soil that is weaker than its mean may bind
/// where no other does.
std::vector<VehicleState> decisive_states(const Replay& verified) {
  std::map<int, std::vector<std::size_t>> by_soil;
  for (std::size_t i = 0; i < verified.points.size(); ++i) {
    by_soil[verified.points[i].soil].push_back(i);
  }
  std::vector<VehicleState> decisive;
  for (const auto& [soil, indices] : by_soil) {
    std::vector<VehicleState> states;
    std::vector<PathMargins> at_mean;
    for (const std::size_t i : indices) {
      states.push_back(verified.judged[i].state);
      at_mean.push_back(margins_at(verified.points[i]));
    }
    std::set<std::size_t> places;
    for (const std::size_t k : decisive_places(states, at_mean)) places.insert(indices[k]);
    add_most_strained(verified.points, indices, places);
    for (const std::size_t i : places) decisive.push_back(verified.judged[i].state);
  }
  return decisive;
}

}  // namespace

std::vector<double> smallest_margins(const PlanningProblem& problem, const Replay& verified,
                                     const DrawRange& draws, std::uint64_t seed, int threads) {
  const std::vector<VehicleState> states = decisive_states(verified);
  std::vector<double> smallest(static_cast<std::size_t>(draws.count));
  parallel_for(smallest.size(), threads, [&](std::size_t i) {
    const SoilDraw soils = soil_draw(problem, seed, draws.first + static_cast<int>(i));
    smallest[i] = smallest_of(margins_on(problem, states, soils)).smallest();
  });
  return smallest;
}

}  // namespace regoplan
