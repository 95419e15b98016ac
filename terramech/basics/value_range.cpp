#include "terramech/basics/value_range.h"

#include <fmt/format.h>

#include <cmath>

#include "terramech/basics/input_error.h"

namespace regoplan {

bool ValueRange::contains(double value) const {
  return std::isfinite(value) && (max_excluded ? value < max : value <= max) &&
         (min_excluded ? value > min : value >= min);
}

std::string ValueRange::text() const {
  const bool from = std::isfinite(min);
  const bool to = std::isfinite(max);
  if (from && to) {
    return fmt::format("{}{} to {}{}", min_excluded ? "above " : "", min,
                       max_excluded ? "below " : "", max);
  }
  if (from) return fmt::format("{}{}", min_excluded ? "above " : "at least ", min);
  if (to) return fmt::format("{}{}", max_excluded ? "below " : "at most ", max);
  return "any finite number";
}

void require(const std::string& field, double value, const ValueRange& allowed) {
  if (!allowed.contains(value)) throw ValueError(field, value, allowed.text());
}

}  // namespace regoplan
