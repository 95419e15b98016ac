#include "benchmarks/diagnosis/score.h"

#include <algorithm>
#include <cmath>

namespace regoplan::challenge {
namespace {

bool contains_any(const std::vector<std::string>& of, const std::vector<std::string>& any) {
  return std::ranges::any_of(any,
                             [&](const std::string& id) { return std::ranges::count(of, id); });
}

bool is_instrument(const std::string& id) {
  return id.starts_with("sensor_") || id == "slip_scale";
}

bool follows_course(const std::string& column) {
  static const std::vector<std::string> columns{"time_s",           "day",         "on_day",
                                                "run_order",        "warm_up",     "position_m",
                                                "after_slip_ratio", "after_load_n"};
  return std::ranges::count(columns, column) > 0;
}

}  // namespace

Score score(const Truth& truth, const Outcome& outcome) {
  Score s{.silent = outcome.verdict == "consistent" || outcome.verdict == "parameters",
          .is_parameters = outcome.verdict == "parameters",
          .unexplained = outcome.verdict == "unexplained"};
  std::vector<bool> named(truth.causes.size(), false);
  bool single = true;
  for (const OutcomeClaim& claim : outcome.claims) {
    bool right = false;
    for (std::size_t i = 0; i < named.size() && !right; ++i) {
      if (named[i] || !contains_any(claim.ids, truth.causes[i].accepted)) continue;
      named[i] = right = true;
    }
    s.claims.push_back({claim.probability, right});
    s.wrong_name = s.wrong_name || !right;
    single = single && claim.ids.size() == 1;
    if (!right && std::ranges::none_of(claim.ids, is_instrument)) s.called_physics = true;
  }
  s.all_causes = !named.empty() && std::ranges::all_of(named, [](bool b) { return b; });
  s.right = s.all_causes && !s.wrong_name;
  s.exact = s.right && single;
  constexpr double kLargeAngle_deg = 8;
  s.located = outcome.largest_angle_from_deg >= kLargeAngle_deg;
  s.located_in_course = std::ranges::any_of(outcome.located_in, follows_course);
  s.asks_for_ruts = std::ranges::any_of(outcome.further_sensors, [](const std::string& sensor) {
    return sensor.starts_with("rut_");
  });

  s.corrected_ratio = s.calibrated_ratio = outcome.fit.empty() ? std::nan("") : 0;
  for (const OutcomeFit& fit : outcome.fit) {
    s.corrected_ratio = std::max(s.corrected_ratio, fit.corrected_rmse / fit.noise_floor);
    s.calibrated_ratio = std::max(s.calibrated_ratio, fit.calibrated_rmse / fit.noise_floor);
    const double standard_error =
        fit.calibrated_rmse / std::sqrt(2.0 * static_cast<double>(outcome.rows));
    if (fit.corrected_rmse > fit.calibrated_rmse + 2 * standard_error)
      s.worse_than_calibrated = true;
  }
  return s;
}

std::array<double, 2> wilson(int successes, int trials) {
  if (trials == 0) return {0, 1};
  constexpr double kZ = 1.959964;
  const double n = trials, p = successes / n, z2 = kZ * kZ;
  const double middle = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace regoplan::challenge
