// A scenario planned from C++: map, vehicle, limits, search; the answer's best path.
#include <cstdio>

#include "level_map.h"

int main() {
  const regoplan::PlanResult result = regoplan::plan(thirty_metres());
  std::printf("%s: %s\n", std::string(name(result.status)).c_str(), result.reason.c_str());
  if (result.candidates.empty()) return 1;
  const regoplan::Candidate& best = result.candidates.front();
  std::printf("%.1f m in %.1f s; margin %.3f at the mean soil, %.3f in 95 %% of %d draws\n",
              best.length_m, best.duration_s, best.margin_min, best.spread->p05,
              best.spread->draws);
  return best.verified.passed ? 0 : 1;
}
