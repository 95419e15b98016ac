#include "benchmarking/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "planner/runtime/draw_statistics.h"

namespace regoplan {
namespace {

/// A median of a summary, and the property of the runs that it is of.
struct MedianField {
  const char* name;
  std::optional<double> PlannerSummary::*median;
  const char* property;
};
constexpr std::array<MedianField, 6> kMedians{
    {{"time_median_s", &PlannerSummary::time_median_s, "time REAL"},
     {"length_median_m", &PlannerSummary::length_median_m, "path length m REAL"},
     {"duration_median_s", &PlannerSummary::duration_median_s, "path duration s REAL"},
     {"energy_median_j", &PlannerSummary::energy_median_j, "path energy j REAL"},
     {"margin_median", &PlannerSummary::margin_median, "margin min REAL"},
     {"propagations_median", &PlannerSummary::propagations_median, "propagations INTEGER"}}};

std::vector<double> verified_values(const PlannerRuns& runs, const std::string& property) {
  std::vector<double> values;
  for (const RunRecord& run : runs.runs) {
    const auto value = number(run.outcome, property);
    if (solved_and_verified(run.outcome) && value) values.push_back(*value);
  }
  return values;
}

std::map<std::uint64_t, double> by_seed(const PlannerRuns& runs, const std::string& property) {
  std::map<std::uint64_t, double> values;
  for (const RunRecord& run : runs.runs) {
    const auto value = number(run.outcome, property);
    if (solved_and_verified(run.outcome) && value && *value > 0) values[run.key.seed] = *value;
  }
  return values;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// 2.5 % and 97.5 % quantile of the mean of resampled values.
std::array<double, 2> bootstrap_ci95(const std::vector<double>& values) {
  constexpr int kResamples = 2000;
  std::mt19937_64 random(20041116);
  std::uniform_int_distribution<std::size_t> pick(0, values.size() - 1);
  std::vector<double> means;
  means.reserve(kResamples);
  for (int i = 0; i < kResamples; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += values[pick(random)];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  std::sort(means.begin(), means.end());
  return {means[kResamples / 40], means[kResamples - 1 - kResamples / 40]};
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::optional<std::array<double, 2>> median_ci95(std::vector<double> values) {
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  const auto [low, high] =
      quantile_interval(std::move(values), 0.5, {.low = -kOpen, .high = kOpen});
  if (!std::isfinite(low) || !std::isfinite(high)) return std::nullopt;
  return std::array{low, high};
}

std::array<double, 2> wilson_ci95(int hits, int of) {
  constexpr double kZ = 1.959963984540054;
  const double n = of, p = hits / n, z2 = kZ * kZ;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

PlannerSummary summary_of(const PlannerRuns& runs) {
  PlannerSummary summary{.planner = runs.planner, .runs = static_cast<int>(runs.runs.size())};
  for (const RunRecord& run : runs.runs) {
    summary.verified += solved_and_verified(run.outcome) ? 1 : 0;
    summary.overturned += number(run.outcome, "overturned BOOLEAN") == 1 ? 1 : 0;
    summary.crashed += number(run.outcome, "status ENUM") == ompl_crash_status() ? 1 : 0;
  }
  summary.success_ci95 = wilson_ci95(summary.verified, summary.runs);
  for (const MedianField& field : kMedians) {
    const std::vector<double> values = verified_values(runs, field.property);
    if (values.empty()) continue;
    summary.*field.median = median(values);
    if (const auto interval = median_ci95(values)) summary.medians_ci95[field.name] = *interval;
  }
  return summary;
}

std::vector<PairedComparison> paired_comparisons(const BenchmarkExperiment& experiment,
                                                 const std::string& property) {
  std::vector<PairedComparison> comparisons;
  for (std::size_t a = 0; a < experiment.planners.size(); ++a) {
    const auto ours = by_seed(experiment.planners[a], property);
    for (std::size_t b = a + 1; b < experiment.planners.size(); ++b) {
      std::vector<double> log_ratios;
      for (const auto& [seed, value] : by_seed(experiment.planners[b], property)) {
        const auto mine = ours.find(seed);
        if (mine != ours.end()) log_ratios.push_back(std::log(mine->second / value));
      }
      constexpr std::size_t kFewest = 5;
      if (log_ratios.size() < kFewest) continue;
      const auto [low, high] = bootstrap_ci95(log_ratios);
      comparisons.push_back({.experiment = experiment.name,
                             .planner = experiment.planners[a].planner,
                             .other = experiment.planners[b].planner,
                             .property = property,
                             .pairs = static_cast<int>(log_ratios.size()),
                             .ratio = std::exp(mean(log_ratios)),
                             .ratio_ci95 = {std::exp(low), std::exp(high)},
                             .real = low > 0 || high < 0});
    }
  }
  return comparisons;
}

}  // namespace regoplan
