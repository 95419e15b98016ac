#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace regoplan {

/// The whole text as a decimal number (`-1.5`, `.5`, `3.7e-2`). Nothing where it is anything else
/// or does not fit: no spaces, no hexadecimal, no `nan`, no `inf`.
std::optional<double> parse_number(std::string_view text);

/// The shortest decimal d for which d * unit is exactly `value`; where there is none, the
/// shortest for value / unit. Turns radians into the degrees that somebody wrote.
std::string number_in_unit(double value, double unit);

}  // namespace regoplan
