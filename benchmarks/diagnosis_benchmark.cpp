// A recording of 44 conditions, three times each, that has a concealed effect.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/fit/calibration.h"
#include "tests/diagnosis/synthetic_bed.h"

namespace regoplan {
namespace {

Recording recording() {
  TrueWheel truth;
  truth.sinkage = [](const WheelRun& run, double h0) {
    return h0 * (1 + 0.9 * std::max(run.slip_ratio, 0.0));
  };
  const DiagnosisSetup setup = simulant_setup();
  return record(truth, setup, setup.soil.mean, {}, 5);
}

/// What a person would do without the diagnosis: fit the soil numbers.
void calibration_alone(benchmark::State& state) {
  const CondensedRecording condensed = condense(recording(), simulant_setup());
  const std::vector<SoilCoordinate> soil = soil_coordinates(simulant_setup().soil);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(calibrate(condensed.bed, soil));
  }
}
BENCHMARK(calibration_alone)->Unit(benchmark::kMillisecond);

/// All of it: every mechanism and pair scored, held-out proof, next experiment; one thread.
void whole_diagnosis(benchmark::State& state) {
  const Recording measured = recording();
  const DiagnosisSetup setup = simulant_setup();
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(diagnose(measured, setup, {.threads = 1}));
  }
}
BENCHMARK(whole_diagnosis)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace regoplan
