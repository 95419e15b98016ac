#include "terramech/basics/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace regoplan {
namespace {

bool alike(char a, char b) {
  const auto small = [](char letter) { return std::tolower(static_cast<unsigned char>(letter)); };
  return small(a) == small(b);
}

}  // namespace

std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t above = row[j + 1];
      row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (alike(a[i], b[j]) ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

std::optional<std::string> nearest_name(std::string_view written,
                                        const std::vector<std::string>& names) {
  const auto nearest = std::ranges::min_element(
      names, {}, [&](const std::string& name) { return edits_between(written, name); });
  if (nearest == names.end() || 2 * edits_between(written, *nearest) > written.size()) return {};
  return *nearest;
}

std::string name_hint(std::string_view written, const std::vector<std::string>& names) {
  const auto nearest = nearest_name(written, names);
  return nearest ? fmt::format("did you mean {}?", *nearest)
                 : fmt::format("known: {}", fmt::join(names, ", "));
}

}  // namespace regoplan
