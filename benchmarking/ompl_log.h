#pragma once

#include <string>

#include "benchmarking/experiment.h"

namespace regoplan {

/// An experiment in the log grammar of OMPL's benchmark tool, which `ompl_benchmark_statistics` and
/// Planner Arena's upload read. Names have no spaces: OMPL's reader takes the last word.
std::string ompl_log(const BenchmarkExperiment& experiment);

}  // namespace regoplan
