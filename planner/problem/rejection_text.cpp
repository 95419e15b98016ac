#include "planner/problem/rejection_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regoplan {
namespace {

/// What the numbers of a reason count, where its name does not say so.
std::string counted(std::string_view reason) {
  if (reason == "bounds") return "speed";
  std::string words(reason);
  std::ranges::replace(words, '_', ' ');
  if (reason == "traction" || reason == "tip_over" || reason == "cornering") words += " margin";
  return words;
}

std::string_view bound_words(std::string_view reason) {
  return reason == "traction" || reason == "tip_over" || reason == "cornering" ? "at least"
                                                                               : "at most";
}

/// Slips, slip angles and curvatures have a sign; their limits hold for both.
bool either_way(std::string_view reason, double value) {
  return value < 0 && (reason == "slip" || reason == "slip_angle" || reason == "steering");
}

}  // namespace

ShownUnit shown_unit(std::string_view reason) {
  if (reason == "slope" || reason == "slip_angle") return {180 / std::numbers::pi, "deg"};
  if (reason == "sinkage" || reason == "deviation") return {1, "m"};
  if (reason == "bounds") return {1, "m/s"};
  if (reason == "steering") return {1, "1/m"};
  return {};
}

std::string rejection_text(std::string_view reason, double value, double limit) {
  std::string words(reason);
  std::ranges::replace(words, '_', ' ');
  if (std::isinf(value)) return words + " (no steady trim)";
  if (std::isnan(value)) return words;
  const ShownUnit unit = shown_unit(reason);
  const std::string unit_text = unit.name.empty() ? "" : fmt::format(" {}", unit.name);
  std::string found, allowed;
  constexpr int kDigits = 4, kDigitsMost = 12;
  for (int digits = kDigits; found == allowed && digits <= kDigitsMost; ++digits) {
    found = fmt::format("{:.{}g}", value * unit.per_si, digits);
    allowed = fmt::format("{:.{}g}", std::abs(limit) * unit.per_si, digits);
  }
  return fmt::format("{} {}{} (allowed: {} {}{}{})", counted(reason), found, unit_text,
                     bound_words(reason), allowed, unit_text,
                     either_way(reason, value) ? " either way" : "");
}

std::string rejection_text(const RejectedState& rejection) {
  return fmt::format("{}{} at ({:.2f}, {:.2f})",
                     rejection.while_stopping ? kCannotStop : std::string_view(),
                     rejection_text(name(rejection.reason), rejection.value, rejection.limit),
                     rejection.x_m, rejection.y_m);
}

}  // namespace regoplan
