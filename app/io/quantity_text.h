#pragma once

#include <string>
#include <string_view>

namespace regoplan {

/// In place of what is not known or was not driven.
inline constexpr std::string_view kNotKnown = "-";

/// Three significant digits in the unit that fits, so that a rover of a few kilograms reads as well
/// as a truck: "412 mm", "1.30 m"; "87.3 J", "1.20 kJ", "45.0 MJ". Exactly nothing is "0 m",
/// and what rounding leaves of it "<0.001 mm".
std::string length_text(double length_m);
std::string energy_text(double energy_j);

}  // namespace regoplan
