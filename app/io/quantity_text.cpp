#include "app/io/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace regoplan {
namespace {

struct Unit {
  double si;
  std::string_view name;
};

constexpr int kSignificantDigits = 3;
constexpr double kSmallestShown = 1e-3;  ///< of the smallest unit; less is how sums are rounded

/// \param units the smallest first
std::string in_fitting_unit(double value, std::span<const Unit> units, std::string_view si_name) {
  if (value == 0) return fmt::format("0 {}", si_name);
  if (!std::isfinite(value)) return std::string(kNotKnown);
  if (std::abs(value) < kSmallestShown * units.front().si) {
    return fmt::format("<{} {}", kSmallestShown, units.front().name);
  }
  // What counts is the size that is shown: 999.7 J are 1.00 kJ.
  const auto size = [&](const Unit& unit) {
    return static_cast<int>(
        std::floor(std::log10(std::abs(value / unit.si)) - std::log10(1 - 0.5e-3)));
  };
  const auto larger = std::find_if(units.begin() + 1, units.end(),
                                   [&](const Unit& unit) { return size(unit) < 0; });
  const Unit& unit = *(larger - 1);
  return fmt::format("{:.{}f} {}", value / unit.si,
                     std::max(0, kSignificantDigits - 1 - size(unit)), unit.name);
}

}  // namespace

std::string length_text(double length_m) {
  static constexpr auto kUnits = std::to_array<Unit>({{1e-3, "mm"}, {1, "m"}, {1e3, "km"}});
  return in_fitting_unit(length_m, kUnits, "m");
}

std::string energy_text(double energy_j) {
  static constexpr auto kUnits =
      std::to_array<Unit>({{1e-3, "mJ"}, {1, "J"}, {1e3, "kJ"}, {1e6, "MJ"}});
  return in_fitting_unit(energy_j, kUnits, "J");
}

}  // namespace regoplan
