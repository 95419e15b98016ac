#include "app/command/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>

#include "app/io/printable_text.h"
#include "app/settings/settings_node.h"
#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

/// An empty value is shown as such: a slip of the hand (an unset variable of a script).
std::string not_valid(const std::string& text, const std::string& allowed) {
  return fmt::format("{} is not valid (allowed: {})", text.empty() ? "\"\"" : text, allowed);
}

/// The whole text as a whole number in digits; nothing where it is anything else or does not fit.
std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [read, failed] = std::from_chars(text.data(), end, value);
  return failed == std::errc() && read == end ? std::optional(value) : std::nullopt;
}

}  // namespace

CLI::Validator in_range(const ValueRange& allowed) {
  return {[allowed](std::string& text) {
            const std::optional<double> value = parse_number(text);
            if (value && allowed.contains(*value)) return std::string();
            return not_valid(text, value ? allowed.text() : number_text(allowed));
          },
          ""};
}

CLI::Validator whole_in_range(const ValueRange& allowed) {
  return {[allowed](std::string& text) {
            const std::optional<std::int64_t> value = whole_number(text);
            return value && allowed.contains(static_cast<double>(*value))
                       ? std::string()
                       : not_valid(text, "a whole number, " + allowed.text());
          },
          ""};
}

CLI::Validator a_seed() {
  return {[](std::string& text) {
            const std::optional<std::int64_t> seed = whole_number(text);
            return seed && *seed >= 0 && *seed <= kSeedMax
                       ? std::string()
                       : not_valid(text, whole_number_text(0, kSeedMax));
          },
          ""};
}

CLI::Validator one_of(std::vector<std::string> words) {
  return {[words = std::move(words)](std::string& text) {
            return std::ranges::find(words, text) != words.end()
                       ? std::string()
                       : not_valid(text, fmt::format("{}", fmt::join(words, " | ")));
          },
          ""};
}

void print_line(std::string_view text) {
  std::fputs(fmt::format("regoplan: {}\n", printable(text)).c_str(), stderr);
}

void notify(const std::string& notice, bool quiet) {
  if (!quiet) print_line(notice);
}

}  // namespace regoplan
