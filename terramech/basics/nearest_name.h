#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regoplan {

/// How many letters differ (Levenshtein distance), small and capital ones alike.
std::size_t edits_between(std::string_view a, std::string_view b);

/// The name that a misspelt one most likely stands for: the nearest, where no more than half of
/// what was written differs.
std::optional<std::string> nearest_name(std::string_view written,
                                        const std::vector<std::string>& names);

/// What helps where a name is not known: "did you mean X?", or all that are, "known: X, Y".
std::string name_hint(std::string_view written, const std::vector<std::string>& names);

}  // namespace regoplan
