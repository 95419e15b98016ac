#include "planner/course/speed_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace regoplan {

SpeedProfile::SpeedProfile(std::vector<Node> nodes) : nodes_(std::move(nodes)), time_s_{0} {
  assert(nodes_.size() >= 2);
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const Node &a = nodes_[i - 1], &b = nodes_[i];
    assert(b.s_m > a.s_m && a.speed_mps + b.speed_mps > 0);
    time_s_.push_back(time_s_.back() + 2 * (b.s_m - a.s_m) / (a.speed_mps + b.speed_mps));
  }
}

std::size_t SpeedProfile::interval(double s_m) const {
  const auto above = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, s_m,
                                      [](double s, const Node& node) { return s < node.s_m; });
  return static_cast<std::size_t>(above - nodes_.begin()) - 1;
}

SpeedProfile::Value SpeedProfile::at(double s_m) const {
  const std::size_t i = interval(s_m);
  const Node &a = nodes_[i], &b = nodes_[i + 1];
  const double share = std::clamp((s_m - a.s_m) / (b.s_m - a.s_m), 0.0, 1.0);
  const double from = a.speed_mps * a.speed_mps, to = b.speed_mps * b.speed_mps;
  return {.speed_mps = std::sqrt(from + share * (to - from)),
          .acceleration_mps2 = (to - from) / (2 * (b.s_m - a.s_m))};
}

double SpeedProfile::duration_s(double s_m) const {
  const std::size_t i = interval(s_m);
  const double s = std::clamp(s_m, nodes_.front().s_m, nodes_.back().s_m);
  const double sum = nodes_[i].speed_mps + at(s).speed_mps;
  return time_s_[i] + (sum > 0 ? 2 * (s - nodes_[i].s_m) / sum : 0);
}

double SpeedProfile::speed_max_mps() const {
  return std::max_element(nodes_.begin(), nodes_.end(),
                          [](const Node& a, const Node& b) { return a.speed_mps < b.speed_mps; })
      ->speed_mps;
}

std::array<double, 2> SpeedProfile::hardest_m(double from_m, double to_m) const {
  constexpr double kWithin = 1e-3;  // of the piece: at its ends the next one begins
  struct Place {
    double s_m, acceleration_mps2;
  };
  std::vector<Place> places;
  for (std::size_t i = interval(from_m); i + 1 < nodes_.size() && nodes_[i].s_m < to_m; ++i) {
    const double begin_m = std::max(from_m, nodes_[i].s_m);
    const double end_m = std::min(to_m, nodes_[i + 1].s_m);
    const bool gathers = nodes_[i + 1].speed_mps > nodes_[i].speed_mps;
    const double s_m = begin_m + (gathers ? 1 - kWithin : kWithin) * (end_m - begin_m);
    places.push_back({s_m, at(s_m).acceleration_mps2});
  }
  const auto [least, most] = std::ranges::minmax_element(places, {}, &Place::acceleration_mps2);
  return {least->s_m, most->s_m};
}

SpeedProfile limited_by_acceleration(const std::vector<SpeedProfile::Node>& most,
                                     double start_speed_mps, double end_speed_mps,
                                     double acceleration_max_mps2) {
  constexpr double kSpacing_m = 0.25;
  std::vector<SpeedProfile::Node> nodes;
  for (std::size_t i = 0; i + 1 < most.size(); ++i) {
    const SpeedProfile::Node &a = most[i], &b = most[i + 1];
    const int pieces = std::max(2, static_cast<int>(std::ceil((b.s_m - a.s_m) / kSpacing_m)));
    for (int k = 0; k < pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      nodes.push_back(
          {a.s_m + share * (b.s_m - a.s_m), a.speed_mps + share * (b.speed_mps - a.speed_mps)});
    }
  }
  nodes.push_back(most.back());
  const auto reach = [&](const SpeedProfile::Node& from, const SpeedProfile::Node& to) {
    return std::sqrt(from.speed_mps * from.speed_mps +
                     2 * acceleration_max_mps2 * std::abs(to.s_m - from.s_m));
  };
  nodes.front().speed_mps = std::min(nodes.front().speed_mps, start_speed_mps);
  nodes.back().speed_mps = std::min(nodes.back().speed_mps, end_speed_mps);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    nodes[i].speed_mps = std::min(nodes[i].speed_mps, reach(nodes[i - 1], nodes[i]));
  }
  for (std::size_t i = nodes.size() - 1; i-- > 0;) {
    nodes[i].speed_mps = std::min(nodes[i].speed_mps, reach(nodes[i + 1], nodes[i]));
  }
  return SpeedProfile(std::move(nodes));
}

}  // namespace regoplan
