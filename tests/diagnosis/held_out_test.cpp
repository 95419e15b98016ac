#include "diagnosis/fit/held_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "calibrated_bed.h"
#include "diagnosis/fit/effect_list.h"

namespace regoplan {
namespace {

CalibratedBed base(const TrueWheel& truth) {
  const DiagnosisSetup setup = simulant_setup();
  return CalibratedBed(record(truth, setup, setup.soil.mean, {}, 1));
}

TEST(HeldOut, AConditionsOwnFamilyHasNoPartInItsPrediction) {
  CalibratedBed made = base({});
  const Families families = families_of(made.recording.bed);
  const HeldOut before = hold_out(made.recording, made.soil, made.fit, {}, families, 1);
  ChannelData& fx = made.recording.bed.channels.front();
  for (std::size_t i = 0; i < fx.conditions.size(); ++i) {
    if (families.of_condition[fx.conditions[i]] == 1) fx.mean[static_cast<Eigen::Index>(i)] += 30;
  }
  const HeldOut after = hold_out(made.recording, made.soil, made.fit, {}, families, 1);
  for (std::size_t i = 0; i < fx.conditions.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (families.of_condition[fx.conditions[i]] == 1) {
      EXPECT_DOUBLE_EQ(before.calibrated[row], after.calibrated[row]);
    }
  }
  EXPECT_GT((before.calibrated - after.calibrated).norm(), 0.1);
}

TEST(HeldOut, ANameThatDoesNothingPredictsNoBetterThanTheCalibratedModel) {
  // Friction of the rim above the soil's is the soil's: from there no step leads on, and numbers
  // fitted to all conditions must not pass for a prediction of those held out.
  TrueWheel truth;
  truth.fx_n = [](const WheelRun& run, double) { return 8 * std::sin(12 * run.slip_ratio); };
  const CalibratedBed made = base(truth);
  const TestBed& bed = made.recording.bed;
  const std::vector<Effect> effects = effects_for(bed, {}, EffectsOf::kPart);
  const auto rim = std::ranges::find_if(
      effects, [](const Effect& e) { return e.id == "rim_friction" && e.form == "ratio"; });
  ASSERT_NE(rim, effects.end());
  const Hypothesis names{.effects = {*rim}};
  CandidateFit inert{.candidate = names, .x = start_of(made.problem(), names, &made.fit)};
  inert.x.tail(1)[0] = rim->coordinates.front().at(1.2);
  inert.prediction = made.fit.prediction;
  inert.jacobian = Eigen::MatrixXd::Zero(bed.size(), inert.x.size());
  inert.jacobian.leftCols(made.fit.jacobian.cols()) = made.fit.jacobian;
  inert.evidence.settings.assign(bed.channels.size(), 0);
  for (const Families& families : all_families(bed)) {
    const HeldOut out = hold_out(made.recording, made.soil, made.fit, {.fit = &inert}, families, 2);
    EXPECT_LT(out.share_explained, 0.1) << families.by;
  }
}

TEST(HeldOut, TheCalibratedModelReachesTheNoiseWhereNothingIsMissing) {
  const CalibratedBed made = base({});
  const HeldOut out =
      hold_out(made.recording, made.soil, made.fit, {}, families_of(made.recording.bed), 2);
  for (const ChannelFit& fit : out.fit) {
    EXPECT_LT(fit.calibrated_rmse, 1.3 * fit.noise_floor) << name(fit.channel);
  }
}

TEST(HeldOut, TheExcessOfATrueModelScattersAsIsExpectedOfIt) {
  // Days that differ by as much as runs scatter move whole families at once.
  const DiagnosisSetup setup = simulant_setup();
  constexpr int kRecordings = 12;
  double sum = 0, squares = 0;
  for (std::uint64_t seed = 1; seed <= kRecordings; ++seed) {
    std::mt19937_64 random(seed);
    const Soil soil = draw(setup.soil, setup.wheel.width_m, random);
    const CalibratedBed made(record({}, setup, soil, {.replicates = 4, .day = 1}, seed));
    const HeldOut out =
        hold_out(made.recording, made.soil, made.fit, {}, families_of(made.recording.bed), 2);
    const double z = (out.excess - out.expected.mean) / out.expected.standard_deviation;
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / kRecordings, 0, 1);
  EXPECT_NEAR(std::sqrt(squares / kRecordings), 1.2, 0.8);
}

TEST(HeldOut, FamiliesAreSlipAnglesWhereThereAreFour) {
  const CalibratedBed made = base({});
  const Families families = families_of(made.recording.bed);
  EXPECT_EQ(families.by, "slip angle");
  EXPECT_EQ(families.count, 4);
}

TEST(HeldOut, DaysAreFamiliesWhereEveryConditionHasADayOfItsOwn) {
  CalibratedBed made = base({});
  const auto by_day = [&] {
    return std::ranges::any_of(all_families(made.recording.bed),
                               [](const Families& families) { return families.by == "day"; });
  };
  EXPECT_FALSE(by_day()) << "replicates on other days tell of the day that is held out";
  for (std::size_t k = 0; k < made.recording.bed.conditions.size(); ++k) {
    made.recording.bed.conditions[k].one_day = true;
    made.recording.bed.conditions[k].day = static_cast<double>(k % 4);
  }
  EXPECT_TRUE(by_day());
}

TEST(HeldOut, AModelThatIsNoBetterOrWorseInOneChannelIsNotHandedOut) {
  const CalibratedBed made = base({});
  const TestBed& bed = made.recording.bed;
  const Eigen::VectorXd measured = bed.measured();
  HeldOut proof{.families = {.by = "slip angle"}, .calibrated = measured, .corrected = measured};
  proof.calibrated.array() += 0.1;
  proof.corrected = proof.calibrated;
  EXPECT_NE(no_better_than(proof.calibrated, bed, proof).find("gains 0.0"), std::string::npos);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    proof.calibrated.segment(bed.offset(c), bed.channels[c].mean.size()) =
        (bed.channels[c].mean.array() + 2 * bed.channels[c].scale).matrix();
  }
  proof.corrected = measured;
  EXPECT_EQ(no_better_than(proof.calibrated, bed, proof), "");
  auto torque = proof.corrected.segment(bed.offset(2), bed.channels[2].mean.size());
  torque.array() += 4 * bed.channels[2].scale;
  EXPECT_NE(no_better_than(proof.calibrated, bed, proof).find("torque_nm worse"),
            std::string::npos);
}

TEST(HeldOut, AGainScattersByOneStandardErrorHoweverMuchDaysMoveAllAtOnce) {
  TestBed bed = base({}).recording.bed;
  bed.channels.resize(1);
  ChannelData& data = bed.channels.front();
  const Eigen::Index n = data.mean.size();
  const Eigen::VectorXd truth = data.mean, other = truth.array() + 0.5;
  constexpr double kDay = 2;
  data.noise = Eigen::MatrixXd::Identity(n, n);
  data.noise.array() += kDay * kDay;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double sum = 0, squares = 0;
  constexpr int kDraws = 400;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double day = kDay * normal(random);
    for (Eigen::Index i = 0; i < n; ++i) data.mean[i] = truth[i] + day + normal(random);
    const double gain = gain_in_errors(bed, truth, other);
    sum += gain / kDraws;
    squares += gain * gain / kDraws;
  }
  EXPECT_NEAR(std::sqrt(squares - sum * sum), 1, 0.1);
}

}  // namespace
}  // namespace regoplan
