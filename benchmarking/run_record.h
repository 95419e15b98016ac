#pragma once

#include <compare>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <tuple>

#include "planner/benchmark/benchmark_run.h"

namespace regoplan {

/// Which run of a suite: the names under which it stands in every result.
struct RunKey {
  std::string experiment;
  std::string planner;  ///< label
  std::uint64_t seed = 0;

  auto operator<=>(const RunKey&) const = default;
};

/// A run that has ended, well or not.
struct RunRecord {
  RunKey key;
  BenchmarkRecord outcome;
};

/// A run that gave no answer: OMPL's status for a crash, and why.
BenchmarkRecord crashed_run(std::uint64_t seed, const std::string& failure);

nlohmann::json to_json(const BenchmarkRecord& record);
nlohmann::json to_json(const RunRecord& record);

/// \throws nlohmann::json::exception for what `to_json` did not write
BenchmarkRecord benchmark_record_of(const nlohmann::json& json);
RunRecord run_record_of(const nlohmann::json& json);

/// A numeric property, nothing where it is absent, empty or not finite.
std::optional<double> number(const BenchmarkRecord& record, const std::string& property);

/// Seconds until the first solution: of the progress where the planner tells it, else the whole
/// search, which ends with the first solution. Nothing where there is none.
std::optional<double> first_solution_s(const BenchmarkRecord& record);

/// OMPL's status of an exact solution that the exact model confirms.
bool solved_and_verified(const BenchmarkRecord& record);

}  // namespace regoplan
