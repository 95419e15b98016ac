#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace regoplan {

/// A planner of a suite: one of `planner_names()`, or one's own, with parameters, as OMPL names
/// them.
struct SuitePlanner {
  std::string label;  ///< stands for it in every result
  std::string planner;
  std::map<std::string, std::string> parameters;

  bool operator==(const SuitePlanner&) const = default;
};

struct SuiteScenario {
  std::string label;
  std::string file;
};

/// What every run of a suite is bounded by.
struct RunBounds {
  double time_s = 0;
  std::optional<std::int64_t> iterations;
  double memory_mb = 0;
  double progress_interval_s = 0;
  int soil_draws = 0;

  bool operator==(const RunBounds&) const = default;
};

/// Keys of the scenario, `speed_mps.max`, and what they are set to.
using SweepPoint = std::map<std::string, double>;

/// Scenarios x sweep points x planners x seeds.
struct Suite {
  std::string name;
  std::vector<SuiteScenario> scenarios;
  std::vector<SweepPoint> sweep{{}};  ///< at least one; an empty one leaves the scenario as it is
  std::vector<SuitePlanner> planners;
  std::vector<std::uint64_t> seeds;
  RunBounds bounds;
  /// Where planners (by label) and what is varied (by key) stand in the suite's file,
  /// `suite.yaml:3: planners[1]`, for whoever must refuse one of them later.
  std::map<std::string, std::string> planner_places = {}, sweep_places = {};
};

/// One run, by its places in the suite.
struct SuiteRun {
  std::size_t scenario = 0, sweep_point = 0, planner = 0;
  std::uint64_t seed = 0;
};

/// One scenario at one sweep point: `crater_rim`, `crater_rim,speed_mps.max=2`.
std::string experiment_name(const Suite& suite, std::size_t scenario, std::size_t sweep_point);

/// Which runs are done where: shard `index` (from 1) of `count`.
struct Shard {
  int index = 1;
  int count = 1;
};

/// The runs of a shard: experiment by experiment, in each the planners take turns seed by seed, so
/// that what slows the machine slows all of them. The shards of one count are disjoint, and
/// together they are the suite.
std::vector<SuiteRun> runs_of(const Suite& suite, const Shard& shard);

}  // namespace regoplan
