#include "diagnosis/fit/zone_edges.h"

#include <algorithm>

namespace regoplan {

ZoneEdges::ZoneEdges(const TestBed& bed) {
  for (const Condition& at : bed.conditions) positions_m_.push_back(at.conditions.position_m);
  std::ranges::sort(positions_m_);
}

std::vector<std::array<double, 2>> ZoneEdges::eighths() const {
  std::vector<double> edges_m;
  for (std::size_t k = 1; k < 8; ++k) {
    const std::size_t i = count() * k / 8;
    if (i == 0 || positions_m_[i] == positions_m_[i - 1]) continue;
    edges_m.push_back(edge_m(static_cast<std::ptrdiff_t>(i)));
  }
  std::vector<std::array<double, 2>> zones;
  for (std::size_t i = 0; i < edges_m.size(); ++i) {
    zones.push_back({edges_m[i], edge_m(std::ssize(positions_m_))});
    for (std::size_t k = i + 2; k < edges_m.size(); ++k) zones.push_back({edges_m[i], edges_m[k]});
  }
  return zones;
}

std::optional<Effect> ZoneEdges::moved(const Effect& zone, std::ptrdiff_t from,
                                       std::ptrdiff_t to) const {
  const std::ptrdiff_t first = index_beyond(zone.fixed.at("from_m")) + from,
                       last = index_beyond(zone.fixed.at("to_m")) + to;
  if (first < 0 || last > std::ssize(positions_m_) || last - first < 2) return std::nullopt;
  Effect other = zone;
  other.fixed["from_m"] = edge_m(first);
  other.fixed["to_m"] = edge_m(last);
  return other.fixed == zone.fixed ? std::nullopt : std::optional(other);
}

std::ptrdiff_t ZoneEdges::index_beyond(double edge_m) const {
  return std::ranges::upper_bound(positions_m_, edge_m) - positions_m_.begin();
}

double ZoneEdges::edge_m(std::ptrdiff_t index) const {
  if (index == 0) return positions_m_.front() - 1;
  if (index == std::ssize(positions_m_)) return positions_m_.back() + 1;
  const auto at = static_cast<std::size_t>(index);
  return (positions_m_[at - 1] + positions_m_[at]) / 2;
}

}  // namespace regoplan
