// A bed that remembers the run before, where every replicate repeats the order of the runs.
#include "diagnosis/checks/bed_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "calibrated_bed.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

/// \param loosened share of the shear strength that a run at full slip takes from the next
double deviations(double loosened, std::uint64_t seed) {
  const DiagnosisSetup setup = simulant_setup();
  std::string at;  // a run is asked for more than once
  double before = 0, own = 0;
  TrueWheel wheel;
  wheel.limit = [&](const WheelRun& run) {
    if (run.run_id != at) {
      before = own;
      own = run.slip_ratio;
      at = run.run_id;
    }
    return 1 - loosened * std::pow(std::max(before, 0.0), 1.5);
  };
  const CalibratedBed bed(record(wheel, setup, setup.soil.mean, {}, seed));
  return deviations_of_memory(bed.problem(), bed.fit);
}

TEST(BedMemory, IsSeenThoughReplicatesDoNotShowIt) {
  EXPECT_GT(deviations(0.15, 1), Thresholds::kMemory_deviations);
}

TEST(BedMemory, IsNotSeenWhereThereIsNone) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    EXPECT_LT(deviations(0, seed), Thresholds::kMemory_deviations) << seed;
  }
}

}  // namespace
}  // namespace regoplan
