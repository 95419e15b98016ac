#include "app/command/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>

#include "app/io/number_text.h"
#include "app/io/printable_text.h"

namespace regoplan {

CLI::Validator in_range(const ValueRange& allowed) {
  return {[allowed](std::string& text) {
            const std::optional<double> value = parse_number(text);
            return value && allowed.contains(*value)
                       ? std::string()
                       : fmt::format("{} is not valid (allowed: {})", text, allowed.text());
          },
          ""};
}

CLI::Validator a_seed() {
  return {[](std::string& text) {
            std::int64_t seed = -1;
            const char* end = text.data() + text.size();
            const auto [read, failed] = std::from_chars(text.data(), end, seed);
            return failed == std::errc() && read == end && seed >= 0
                       ? std::string()
                       : fmt::format("{} is not valid (allowed: a whole number, 0 to {})", text,
                                     INT64_MAX);
          },
          ""};
}

CLI::Validator one_of(std::vector<std::string> words) {
  return {[words = std::move(words)](std::string& text) {
            return std::ranges::find(words, text) != words.end()
                       ? std::string()
                       : fmt::format("{} is not valid (allowed: {})", text,
                                     fmt::join(words, " | "));
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
