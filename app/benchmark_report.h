#pragma once

#include <string>

#include "benchmarking/run_journal.h"

namespace regoplan {

/// The verdict of a suite in one sentence.
std::string benchmark_headline(const JournalContents& contents, bool interrupted);

/// report.html of a suite: success with intervals, profiles, boxes, comparisons, paths.
std::string benchmark_report(const JournalContents& contents, bool interrupted);

}  // namespace regoplan
