#pragma once

#include <string>
#include <vector>

#include "app/benchmark/benchmark_report.h"
#include "app/io/staged_files.h"
#include "benchmarking/experiment.h"

namespace regoplan {

/// The text of benchmark.json: a summary of every planner in every experiment, and the paired
/// comparisons.
std::string benchmark_json(const SuiteResults& results);

/// Writes what is made of the journal, all or none: EXPERIMENT.log in OMPL's grammar, benchmark.db,
/// benchmark.json and report.html, which draws the maps that are given.
/// \throws InputError where the folder takes no files
void write_benchmark_files(const SuiteResults& results, const ScenarioMaps& maps,
                           const ResultFolder& folder);
std::vector<std::string> benchmark_file_names();  ///< those that every suite has

}  // namespace regoplan
