#include "diagnosis/checks/smallest_detectable.h"

#include <gtest/gtest.h>

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
  ASSERT_TRUE(silent.verdict == Verdict::kConsistent || silent.verdict == Verdict::kParameters);
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

}  // namespace
}  // namespace regoplan
