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
  RecordedColumns columns;
  std::vector<Channel> channels;
};

/// A rig on which an effect with these needs can show: lab sand, lunar or Martian simulant, wheels
/// of .05 to .25 m; grids of slip, slip angle and load with speeds, passes, positions, times; 40 to
/// 130 runs, three replicates mostly.
Rig draw_rig(Random& random, const Needs& needs);

/// All that any of two effects needs.
Needs operator|(const Needs& a, const Needs& b);

}  // namespace regoplan::challenge
