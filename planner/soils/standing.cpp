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

bool tied(const Standing& leader, const Standing& other) {
  return other.tier == leader.tier && other.high >= leader.value;
}

bool leads(const Standing& a, const Standing& b) {
  return std::tuple(a.tier, -a.value) < std::tuple(b.tier, -b.value);
}

std::vector<std::vector<std::size_t>> rank_groups(const std::vector<Standing>& standings) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::size_t> order(standings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto better = [&](std::size_t a, std::size_t b) {
    return leads(standings[a], standings[b]);
  };
  const auto sooner = [&](std::size_t a, std::size_t b) {
    const auto key = [](const Standing& path) {
      // Too few draws to tell which is safer: soils that are known better are.
      const bool last = path.tier == Standing::kByShareOfDraws && !path.off_doubtful_soils;
      return std::tuple(last, path.duration_s, path.length_m);
    };
    return key(standings[a]) < key(standings[b]);
  };
  for (auto group = order.begin(); group != order.end();) {
    const Standing& leader = standings[*std::min_element(group, order.end(), better)];
    const auto rest = std::stable_partition(
        group, order.end(), [&](std::size_t i) { return tied(leader, standings[i]); });
    std::stable_sort(group, rest, sooner);
    groups.emplace_back(group, rest);
    group = rest;
  }
  return groups;
}

std::vector<std::pair<int, int>> tied_ranks(const std::vector<Standing>& standings) {
  std::vector<std::pair<int, int>> tied;
  int last = 0;
  for (const std::vector<std::size_t>& group : rank_groups(standings)) {
    const int first = last + 1;
    last += static_cast<int>(group.size());
    if (first < last) tied.emplace_back(first, last);
  }
  return tied;
}

std::vector<std::size_t> rank_order(const std::vector<Standing>& standings) {
  std::vector<std::size_t> order;
  for (const std::vector<std::size_t>& group : rank_groups(standings)) {
    order.insert(order.end(), group.begin(), group.end());
  }
  return order;
}

}  // namespace regoplan
