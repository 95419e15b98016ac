#include <algorithm>

#include "planner/problem/plan_result.h"

namespace regoplan {

std::optional<double> fastest_duration_s(const PlanResult& result) {
  if (result.candidates.empty()) return std::nullopt;
  return std::ranges::min_element(result.candidates, {}, &Candidate::duration_s)->duration_s;
}

std::optional<double> duration_gap(const PlanResult& result) {
  const std::optional<double> fastest_s = fastest_duration_s(result);
  if (!fastest_s || !result.least_duration_s) return std::nullopt;
  return (*fastest_s - *result.least_duration_s) / *fastest_s;
}

}  // namespace regoplan
