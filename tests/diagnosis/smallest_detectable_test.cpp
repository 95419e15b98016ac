#include "diagnosis/checks/smallest_detectable.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibrated_bed.h"

namespace regoplan {
namespace {

/// The clean recording's runs as a wheel with a mechanism would have made them.
Recording with_mechanism(Recording recording, const DiagnosisSetup& setup,
                         const Mechanism& mechanism) {
  const WheelModelSpec base{.variant = setup.variant,
                            .wheel = setup.wheel,
                            .soil = setup.soil.mean,
                            .gravity_mps2 = setup.gravity_mps2};
  WheelModelSpec changed = base;
  changed.mechanisms = {mechanism};
  const WheelModel before(base), after(changed);
  for (WheelRun& run : recording.runs) {
    const auto a = channels_at(before, run.load_n, run.slip_ratio, run.slip_angle_rad, {});
    const auto b = channels_at(after, run.load_n, run.slip_ratio, run.slip_angle_rad, {});
    for (std::size_t c = 0; c < 4; ++c) run.measured[c] += (*b)[c] - (*a)[c];
  }
  return recording;
}

TEST(SmallestDetectable, AnEffectOfTwiceThatSizeIsDetected) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording clean = record({}, setup, setup.soil.mean, {.day = 0, .outliers = 0}, 1);
  const Diagnosis silent = diagnose(clean, setup);
  ASSERT_TRUE(silent.verdict == Verdict::kConsistent || silent.verdict == Verdict::kParameters)
      << silent.sentence;
  const std::map<std::string, std::string> kForms{
      {"front_bulldozing", "eta"}, {"lateral_digging", "kappa"}, {"sidewall_shear", "eta"}};
  for (const auto& [id, parameter] : kForms) {
    const auto smallest = std::ranges::find_if(silent.smallest_detectable,
                                               [&id = id](const auto& s) { return s.id == id; });
    ASSERT_NE(smallest, silent.smallest_detectable.end()) << id;
    ASSERT_EQ(smallest->parameter, parameter);
    const Recording recording =
        with_mechanism(clean, setup, {.id = id, .parameters = {{parameter, 2 * smallest->value}}});
    const Diagnosis found = diagnose(recording, setup);
    EXPECT_TRUE(found.verdict != Verdict::kConsistent && found.verdict != Verdict::kParameters)
        << id << ": " << found.sentence;
  }
}

/// A zone has no usual size, only a factor that may be anything about 1.
TEST(SmallestDetectable, IsToldWhereEverySoilNumberIsKnown) {
  DiagnosisSetup setup = simulant_setup();
  setup.soil = {.mean = setup.soil.mean};
  const CalibratedBed known(record({}, setup, setup.soil.mean, {.conditions = 12}, 2), setup);
  ASSERT_EQ(known.fit.x.size(), 0);
  // This effect has no number either: it is there, or it is not.
  const Effect coupled{.id = "coupled_shear"};
  const auto all = smallest_detectable(known.problem(), known.fit, {coupled}, 1.5);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all.front().parameter, "share");
  EXPECT_GT(all.front().value, 0);
}

TEST(SmallestDetectable, AZoneTwiceAsFarFromTheSoilAroundIsDetectedWhereverItLies) {
  const DiagnosisSetup setup = simulant_setup();
  const BedPlan plan{.day = 0, .outliers = 0, .positions = true};
  const Diagnosis silent = diagnose(record({}, setup, setup.soil.mean, plan, 1), setup);
  ASSERT_TRUE(silent.verdict == Verdict::kConsistent || silent.verdict == Verdict::kParameters)
      << silent.sentence;
  const auto smallest = std::ranges::find(silent.smallest_detectable, "soil_zone",
                                          [](const auto& s) { return s.id; });
  ASSERT_NE(smallest, silent.smallest_detectable.end());
  ASSERT_EQ(smallest->parameter, "stiffness");
  ASSERT_LT(smallest->value, 1);
  ASSERT_GT(smallest->value, smallest->low) << "not to be seen on this bed at all";
  for (const double from_m : {0.0, 0.5, 0.875}) {
    TrueWheel zone;
    zone.stiffness = [&](const WheelRun& run) {
      const double at_m = run.conditions.position_m;
      return at_m >= from_m && at_m <= from_m + 0.125 ? std::pow(smallest->value, 2) : 1;
    };
    const Diagnosis found = diagnose(record(zone, setup, setup.soil.mean, plan, 1), setup);
    EXPECT_TRUE(found.verdict != Verdict::kConsistent && found.verdict != Verdict::kParameters)
        << from_m << " m: " << found.sentence;
  }
}

}  // namespace
}  // namespace regoplan
