#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regoplan {

enum class ResultKind { kPlan, kEvaluation, kBenchmark };

/// `plan`, `evaluation`, `benchmark`.
std::string_view name(ResultKind kind);

/// What sampling errors of a kind come from: `draws` of the soils, or `runs`.
std::string_view sampled(ResultKind kind);

/// A number that entries are compared by.
struct ComparedMetric {
  std::string_view key;  ///< its place in an entry of the result, and its name in comparison.json
  std::string_view words;
  std::string_view unit;  ///< SI; empty of a ratio or a margin
  enum class Better { kLess, kMore } better = Better::kLess;
  std::string_view interval_key = {};  ///< of the 95 % interval of what chance has a part in
  /// Of a handful of trials, whose shares and medians jump: tied where the intervals overlap, and
  /// not only where one of the two values lies within the other's, or where there are too few for
  /// an interval.
  bool of_few = false;
};

/// What results of a kind are compared by, in the order in which it is told.
const std::vector<ComparedMetric>& metrics_of(ResultKind kind);

/// A path as it lies on the map, with what is drawn along it.
struct ComparedPath {
  std::vector<double> x_m, y_m;
  std::vector<double> margin;  ///< NaN where none is known; empty of a path without a record
};

/// From, to.
using Interval = std::array<double, 2>;

/// A candidate, an evaluated path, or a planner in an experiment.
struct ComparedEntry {
  std::string name;     ///< entries of two results with one name are held against each other
  std::string verdict;  ///< in words
  bool feasible = false;
  std::vector<std::optional<double>> values;  ///< of the kind's metrics
  /// Of the same metrics: how far the sampling error reaches to either side; none of a value that
  /// is exact, or whose result tells no interval.
  std::vector<std::optional<Interval>> intervals = {};
  std::optional<ComparedPath> path = {};
};

/// What a command came to, as its files say.
struct ComparedResult {
  ResultKind kind = ResultKind::kPlan;
  std::filesystem::path file;
  std::string status;
  std::string version;
  nlohmann::ordered_json asked;   ///< everything that was set, whose differences are told
  nlohmann::ordered_json inputs;  ///< digests by key; empty where the result names none
  std::vector<ComparedEntry> entries;
};

/// \param result a folder that `plan`, `evaluate` or `benchmark` wrote, or the JSON file in it
/// \throws InputError where there is none, or it is not as they write it
ComparedResult read_compared_result(const std::filesystem::path& result);

}  // namespace regoplan
