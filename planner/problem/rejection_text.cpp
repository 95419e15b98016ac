#include "planner/problem/rejection_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace regoplan {

std::string rejection_text(Rejection reason, const std::optional<Exceeded>& exceeded) {
  if (!exceeded) {
    std::string words(name(reason));
    std::ranges::replace(words, '_', ' ');
    return is_margin(reason) ? words + " (no steady trim)" : words;
  }
  const RejectedQuantity& counted = quantity(reason);
  const std::string unit = counted.unit.empty() ? "" : fmt::format(" {}", counted.unit);
  std::string found, allowed;
  constexpr int kDigits = 4, kDigitsMost = 12;
  for (int digits = kDigits; found == allowed && digits <= kDigitsMost; ++digits) {
    found = fmt::format("{:.{}g}", exceeded->found / counted.si_per_shown, digits);
    allowed = fmt::format("{:.{}g}", std::abs(exceeded->limit) / counted.si_per_shown, digits);
  }
  return fmt::format("{} {}{} (allowed: {} {}{}{})", counted.words, found, unit,
                     counted.at_least ? "at least" : "at most", allowed, unit,
                     counted.either_way && exceeded->found < 0 ? " either way" : "");
}

std::string rejection_text(const RejectedState& rejection) {
  return fmt::format(
      "{}{} at ({:.2f}, {:.2f})", rejection.while_stopping ? kCannotStop : std::string_view(),
      rejection_text(rejection.reason, rejection.exceeded), rejection.x_m, rejection.y_m);
}

}  // namespace regoplan
