#pragma once

#include <vector>

#include "benchmarks/diagnosis/random_draws.h"
#include "benchmarks/diagnosis/truth_effect.h"
#include "diagnosis/diagnosis.h"

namespace regoplan::challenge {

/// One commanded condition, before the jitter of its replicates.
struct RigCondition {
  double load_n = 0, slip_ratio = 0, slip_angle_rad = 0;
  int pass = 1;
  double speed_mps = 0, position_m = 0, time_s = 0;
  double previous_slip_ratio = 0;
  int day = 0;  ///< from 0
};

/// A test bed with its wheel, what is known of its soil, and a plan of runs.
struct Rig {
  DiagnosisSetup setup;  ///< noise is filled in where there are no replicates
  Soil soil;             ///< the true one, drawn within what is known
  double middle_load_n = 0;
  double middle_sinkage_m = 0;
  std::vector<RigCondition> conditions;  ///< in the order of the runs
  int replicates = 3;
  bool replicate_by_day = false;  ///< else runs of every day are mixed
  bool same_order = false;        ///< every replicate repeats the order of the runs
  /// Every run has a time of its own; else replicates share that of their condition, as where a bed
  /// is prepared anew for each and time counts from there.
  bool own_times = false;
  double overnight_s = 0;  ///< between days, where runs have times of their own
  RecordedColumns columns;
  std::vector<Channel> channels;

  std::size_t runs() const { return conditions.size() * static_cast<std::size_t>(replicates); }
  /// The day of a run, from 0. \param order of the run among all
  int day_of(int replicate, std::size_t order) const;
  /// The condition as it is met by a run.
  RigCondition at_run(const RigCondition& condition, int replicate, std::size_t order) const;
  /// From the first run to the last.
  double series_s() const;
};

inline constexpr int kDays = 3;
inline constexpr double kBetweenRuns_s = 900;

/// A rig on which an effect with these needs can show: lab sand, lunar or Martian simulant, wheels
/// of .05 to .25 m; grids of slip, slip angle and load with speeds, passes, positions, times; 40 to
/// 130 runs, three replicates mostly.
Rig draw_rig(Random& random, const Needs& needs);

/// All that any of two effects needs.
Needs operator|(const Needs& a, const Needs& b);

}  // namespace regoplan::challenge
