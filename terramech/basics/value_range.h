#pragma once

#include <limits>
#include <string>

namespace regoplan {

/// Which finite numbers are allowed.
struct ValueRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
  bool max_excluded = false;

  /// Never true for NaN or an infinity.
  bool contains(double value) const;

  /// In words: "above 0", "0 to 60", "any finite number".
  std::string text() const;
};

/// \throws ValueError where a field's value is not allowed
void require(const std::string& field, double value, const ValueRange& allowed);

inline constexpr ValueRange kAbove0{.min = 0, .min_excluded = true};
inline constexpr ValueRange kAtLeast0{.min = 0};
inline constexpr ValueRange kAnyNumber{};

}  // namespace regoplan
