#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarking/experiment.h"

namespace regoplan {

/// What a planner's runs of one experiment come to. Of the verified runs, unless said otherwise.
struct PlannerSummary {
  std::string planner;
  int runs = 0;
  int verified = 0;    ///< solved, and confirmed by the exact model
  int overturned = 0;  ///< solved, and not confirmed
  int crashed = 0;
  std::array<double, 2> success_ci95{};  ///< Wilson's interval of verified/runs
  std::optional<double> time_median_s;   ///< of the search
  std::optional<double> length_median_m;
  std::optional<double> duration_median_s;
  std::optional<double> energy_median_j;
  std::optional<double> margin_median;
  std::optional<double> propagations_median;
  /// 95 % intervals of these medians, by the names of their fields; of fewer than six runs there is
  /// none.
  std::map<std::string, std::array<double, 2>> medians_ci95 = {};
};

PlannerSummary summary_of(const PlannerRuns& runs);

/// Two planners on the seeds of one experiment that both solved: is one better?
struct PairedComparison {
  std::string experiment, planner, other;
  std::string property;  ///< `time REAL`, ...
  int pairs = 0;
  double ratio = 1;                    ///< geometric mean of planner over other
  std::array<double, 2> ratio_ci95{};  ///< by bootstrap over the pairs, seeded
  bool real = false;                   ///< the interval leaves 1 out
};

/// Every pair of planners, for positive properties.
std::vector<PairedComparison> paired_comparisons(const BenchmarkExperiment& experiment,
                                                 const std::string& property);

/// Wilson's 95 % interval of a share. \param of at least 1
std::array<double, 2> wilson_ci95(int hits, int of);

/// The 95 % interval of a median between two of the ordered values, whatever they are distributed
/// like. None of fewer than six: all of them lie on one side of the median too often.
std::optional<std::array<double, 2>> median_ci95(std::vector<double> values);

/// \pre not empty
double median(std::vector<double> values);

}  // namespace regoplan
