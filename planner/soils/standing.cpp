#include "planner/soils/standing.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "planner/problem/margin_spread.h"

namespace regoplan {

void set_by_draws(Standing& standing, double p05, double p05_high, const Probability& feasible) {
  const bool broken = p05 <= MarginSpread::kBroken;
  standing.tier = broken ? Standing::kByShareOfDraws : Standing::kByQuantile;
  standing.value = broken ? feasible.share : p05;
  standing.high = broken ? feasible.high : p05_high;
}

std::vector<std::size_t> rank_order(const std::vector<Standing>& standings) {
  std::vector<std::size_t> order(standings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto better = [&](std::size_t a, std::size_t b) {
    return std::tuple(standings[a].tier, -standings[a].value) <
           std::tuple(standings[b].tier, -standings[b].value);
  };
  const auto sooner = [&](std::size_t a, std::size_t b) {
    return std::tuple(standings[a].duration_s, standings[a].length_m) <
           std::tuple(standings[b].duration_s, standings[b].length_m);
  };
  for (auto group = order.begin(); group != order.end();) {
    const Standing& leader = standings[*std::min_element(group, order.end(), better)];
    const auto rest = std::stable_partition(group, order.end(), [&](std::size_t i) {
      return standings[i].tier == leader.tier && standings[i].high >= leader.value;
    });
    std::stable_sort(group, rest, sooner);
    group = rest;
  }
  return order;
}

}  // namespace regoplan
