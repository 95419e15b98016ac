#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/ompl/ompl_planners.h"
#include "planner/ompl/search_run.h"
#include "planner/problem/world.h"

namespace regoplan {

/// One run of one planner under OMPL's own benchmark tool.
struct BenchmarkRun {
  std::string planner;  ///< one of `planner_names()`, not `auto`, or one's own
  /// Of the planner, as OMPL names them; and `improve`, 0 or 1, of those that go on for a better
  /// path until the bound (Lattice, StableSparse, SST).
  std::map<std::string, std::string> parameters;
  SearchGuidance guidance;
  double time_s = 0;                         ///< bound of the search
  std::optional<std::int64_t> iterations{};  ///< further bound
  double memory_mb = 0;                      ///< bound of what the search may take more
  double progress_interval_s = 0.05;         ///< between samples of progress
  int soil_draws = 100;                      ///< for the margin's 5 % quantile
};

/// What OMPL's tool and the verification say of a run. Keys are OMPL's: a name and its type, `path
/// length REAL`; values as text.
struct BenchmarkRecord {
  std::map<std::string, std::string> settings;     ///< of the planner
  std::map<std::string, std::string> properties;   ///< of the run
  std::vector<std::string> progress_names;         ///< in the order of OMPL: by name
  std::vector<std::vector<std::string>> progress;  ///< by sample
  std::vector<std::array<double, 3>> path;         ///< x_m, y_m, margin of the verified replay
};

/// Runs the planner in this process, which must not have drawn from OMPL's random numbers before.
/// OMPL's log is muted meanwhile. The solution is then driven again with the exact model; margins,
/// length, energy are of that. \param searched, verdict the two worlds of one problem \throws
/// InputError for a planner that is not known, or a parameter that it does not have or take
BenchmarkRecord benchmark(const World& searched, const World& verdict, const BenchmarkRun& run,
                          const OwnPlanners& own = {});

/// Makes the planner in this process as a run would, and gives it its parameters.
/// \throws InputError as a run would
void require_parameters(const World& world, const std::string& planner,
                        const std::map<std::string, std::string>& parameters,
                        const OwnPlanners& own = {});

/// OMPL's status of a planner that crashed.
int ompl_crash_status();

/// OMPL's statuses in the order of their numbers.
std::vector<std::string> ompl_status_names();

/// The OMPL that this program was built with, `1.5.2`.
std::string ompl_version();

}  // namespace regoplan
