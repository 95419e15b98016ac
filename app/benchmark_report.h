#pragma once

#include <string>

#include "benchmarking/experiment.h"

namespace regoplan {

/// The verdict of a suite in one sentence.
std::string benchmark_headline(const SuiteResults& results);

/// report.html of a suite: success with intervals, profiles, boxes, comparisons, paths.
std::string benchmark_report(const SuiteResults& results);

}  // namespace regoplan
