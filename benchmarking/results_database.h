#pragma once

#include <filesystem>
#include <vector>

#include "benchmarking/experiment.h"

namespace regoplan {

/// Writes the SQLite database that Planner Arena opens: the tables experiments, plannerConfigs,
/// enums, runs and progress, as `ompl_benchmark_statistics` makes them from the logs.
/// \throws InputError where the file cannot be written
void write_results_database(const std::filesystem::path& file,
                            const std::vector<BenchmarkExperiment>& experiments);

}  // namespace regoplan
