#include "benchmarks/planner/campaign_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/soils/soil_uncertainty.h"

namespace regoplan {

std::string share_text(int successes, int runs) {
  const Probability share = probability_of(successes, runs);
  return fmt::format("{} of {} ({:.3f}, 95 % interval {:.3f} to {:.3f})", successes, runs,
                     share.share, share.low, share.high);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

std::string times_text(const std::vector<double>& times_s) {
  return fmt::format("{:.3f} s (p90 {:.3f}, most {:.3f})", quantile(times_s, 0.5),
                     quantile(times_s, 0.9), quantile(times_s, 1));
}

std::string first_part(const std::string& key) {
  return key.substr(0, key.find(':'));
}
std::string last_part(const std::string& key) {
  return key.substr(key.rfind(':') + 1);
}

}  // namespace regoplan
