#include "app/page/tie_sentence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace regoplan {

std::string tie_sentence(const std::vector<std::pair<int, int>>& tied,
                         const std::function<bool(int rank)>& is_drawn) {
  std::vector<std::string> drawn, undrawn;
  for (const auto& [first, last] : tied) {
    // A group is of one tier: either all of it was judged over draws of the soils, or none.
    (is_drawn(first) ? drawn : undrawn)
        .push_back(fmt::format("{} {} {}", first, last == first + 1 ? "and" : "to", last));
  }
  std::string text;
  const auto tell = [&text](const std::vector<std::string>& groups, std::string_view why) {
    if (groups.empty()) return;
    text += fmt::format("{}Ranks {} are tied: {}; of tied paths the faster stands first.",
                        text.empty() ? "" : " ", fmt::join(groups, ", and "), why);
  };
  tell(drawn, "over the draws of the soils they differ by less than chance does");
  tell(undrawn,
       "no draws of the soils were made of them, and their margins at the mean are the same");
  return text;
}

}  // namespace regoplan
