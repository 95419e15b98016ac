#include "diagnosis/fit/candidate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/bed/condensed_recording.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

bool tried(const std::vector<Effect>& effects, const std::string& id) {
  return std::ranges::any_of(effects, [&](const Effect& effect) { return effect.id == id; });
}

TEST(Hypothesis, ARecordingBearsOnlyWhatItsColumnsShow) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording plain = record({}, setup, setup.soil.mean, {.conditions = 12}, 1);
  const auto without = effects_for(condense(plain, setup).bed, plain);
  for (const char* id : {"multi_pass", "rate_dependence", "soil_zone"}) {
    EXPECT_FALSE(tried(without, id)) << id;
  }
  for (const char* id : {"slip_sinkage", "sensor_bias", "slip_scale", "coupled_shear"}) {
    EXPECT_TRUE(tried(without, id)) << id;
  }
  const Recording passes =
      record({}, setup, setup.soil.mean, {.conditions = 12, .passes = true}, 1);
  EXPECT_TRUE(tried(effects_for(condense(passes, setup).bed, passes), "multi_pass"));
}

TEST(Hypothesis, WithoutSlipAnglesNothingSidewaysIsTried) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording straight =
      record({}, setup, setup.soil.mean, {.angles_deg = {0}, .conditions = 12}, 1);
  const auto effects = effects_for(condense(straight, setup).bed, straight);
  EXPECT_FALSE(tried(effects, "lateral_digging"));
  EXPECT_FALSE(tried(effects, "rut_asymmetry"));
}

TEST(Coordinate, ValueAndPlaceAreInverse) {
  for (const Coordinate& c : {Coordinate{.centre = 2, .spread = 0.5},
                              Coordinate{.logarithmic = true, .centre = -1, .spread = 0.7}}) {
    for (const double x : {-2.0, 0.0, 1.5}) {
      EXPECT_NEAR(c.at(c.value(x)), x, 1e-12);
      EXPECT_NEAR(c.slope(x), (c.value(x + 1e-6) - c.value(x - 1e-6)) / 2e-6, 1e-6);
    }
  }
}

TEST(Hypothesis, ABiasMovesItsOwnChannelAlone) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = record({}, setup, setup.soil.mean, {.conditions = 12}, 1);
  const TestBed bed = condense(recording, setup).bed;
  const Effect bias{.id = "sensor_bias",
                    .kind = EffectKind::kBias,
                    .coordinates = {{.name = "bias", .spread = 2}},
                    .to = 1};
  Eigen::VectorXd x(1);
  x << 1.5;
  const Eigen::VectorXd change = *predict(bed, {}, {{bias}}, x) - *predict(bed, {}, {}, x);
  const Eigen::Index n = bed.channels[1].mean.size();
  EXPECT_NEAR(change.segment(bed.offset(1), n).sum(), 3.0 * static_cast<double>(n), 1e-9);
  EXPECT_NEAR(change.norm(), change.segment(bed.offset(1), n).norm(), 1e-12);
}

}  // namespace
}  // namespace regoplan
