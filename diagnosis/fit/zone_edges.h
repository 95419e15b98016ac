#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "diagnosis/bed/wheel_bed.h"

namespace regoplan {

/// Where zones of other soil may begin and end along a bed: between two conditions, counted from
/// its start. Beyond its first and last condition they reach by a metre.
class ZoneEdges {
 public:
  explicit ZoneEdges(const TestBed& bed);

  /// Conditions of the bed.
  std::size_t count() const { return positions_m_.size(); }

  /// Zones with edges at eighths of the conditions, from and to in metres: everything beyond an
  /// edge, and what lies between two with another between them.
  std::vector<std::array<double, 2>> eighths() const;

  /// The zone with its edges moved over so many conditions; nothing where that is none, or itself.
  std::optional<Effect> moved(const Effect& zone, std::ptrdiff_t from, std::ptrdiff_t to) const;

 private:
  /// Of the first condition beyond an edge.
  std::ptrdiff_t index_beyond(double edge_m) const;
  /// The edge before the condition of an index.
  double edge_m(std::ptrdiff_t index) const;

  std::vector<double> positions_m_;  ///< in their order along the bed
};

}  // namespace regoplan
