#pragma once

#include <map>
#include <string>
#include <vector>

#include "benchmarking/run_journal.h"

namespace regoplan {

/// The runs of one planner in one experiment, by seed.
struct PlannerRuns {
  std::string planner;  ///< label
  std::map<std::string, std::string> settings;
  std::vector<std::string> properties;           ///< every one that a run has, sorted
  std::vector<std::string> progress_properties;  ///< `time REAL` first; empty: no progress
  std::vector<RunRecord> runs;
};

/// An experiment as OMPL's tools know it: one problem, several planners.
struct BenchmarkExperiment {
  std::string name;
  std::map<std::string, std::string> parameters;  ///< of the sweep: `speed_mps.max REAL`, value
  JournalOrigin origin;                           ///< the first that has its scenario
  std::vector<PlannerRuns> planners;
};

/// Wall-clock time of all its searches.
double search_seconds(const BenchmarkExperiment& experiment);

/// Of the planner that has most.
std::size_t runs_per_planner(const BenchmarkExperiment& experiment);

/// The experiments of a journal, in the order of their names; planners in the order of the suite.
std::vector<BenchmarkExperiment> experiments_of(const JournalContents& contents);

/// What a suite came to, as far as it came.
struct SuiteResults {
  JournalContents journal;
  std::vector<BenchmarkExperiment> experiments = experiments_of(journal);
  bool interrupted = false;
};

}  // namespace regoplan
