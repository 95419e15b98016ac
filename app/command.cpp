#include "app/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "app/number_text.h"

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

CLI::Validator one_of(std::vector<std::string> words) {
  return {[words = std::move(words)](std::string& text) {
            return std::ranges::find(words, text) != words.end()
                       ? std::string()
                       : fmt::format("{} is not valid (allowed: {})", text,
                                     fmt::join(words, " | "));
          },
          ""};
}

void notify(const std::string& notice, bool quiet) {
  if (!quiet) fmt::print(stderr, "regoplan: {}\n", notice);
}

}  // namespace regoplan
