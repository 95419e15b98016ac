#include "terramech/tables/number_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace regoplan {

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  // from_chars would take "inf" and "nan" as well.
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return {};
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || parsed != end || !std::isfinite(value)) return {};
  return value;
}

std::string number_in_unit(double value, double unit) {
  const double quotient = value / unit;
  for (int digits = 1; digits <= 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}", quotient, digits);
    const std::optional<double> parsed = parse_number(text);
    if (parsed && *parsed * unit == value) return fmt::format("{}", *parsed);
  }
  return fmt::format("{}", quotient);
}

}  // namespace regoplan
