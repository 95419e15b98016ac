#include <array>

#include "diagnosis/findings/findings.h"

namespace regoplan {

std::string_view name(Verdict verdict) {
  constexpr std::array<std::string_view, 6> kNames{"consistent", "parameters",  "named",
                                                   "class",      "unexplained", "partly"};
  return kNames[static_cast<std::size_t>(verdict)];
}

}  // namespace regoplan
