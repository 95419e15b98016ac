// Two recordings of one rig: what only the test has is named, what both share is not.
#include "diagnosis/difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/proven_difference.h"
#include "diagnosis/recording/thresholds.h"
#include "synthetic_bed.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

/// What the model lacks on test and reference alike, in no listed form.
TrueWheel shared_shortcoming() {
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) { return -4 * std::sin(3 * run.slip_ratio); };
  wheel.sinkage = [](const WheelRun& run, double h) {
    return h * (1 + 0.3 * std::sin(2 * std::abs(run.slip_angle_rad) + run.slip_ratio));
  };
  return wheel;
}

Diagnosis compared(const TrueWheel& test, const TrueWheel& reference, std::uint64_t seed) {
  const DiagnosisSetup setup = simulant_setup();
  std::mt19937_64 random(seed);
  const Soil soil = draw(setup.soil, setup.wheel.width_m, random);
  const BedPlan plan{.slips = {-0.3, 0, 0.2, 0.4, 0.7},
                     .angles_deg = {0, 8, 16},
                     .loads_n = {45, 64.7},
                     .conditions = 26,
                     .replicates = 2};
  return diagnose_difference(
      record(test, setup, soil, plan, seed), setup,
      {{"reference", record(reference, setup, soil, plan, seed + 100), setup}});
}

TEST(Difference, OfTwoSeriesWithTheSameShortcomingsIsNone) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Diagnosis found = compared(shared_shortcoming(), shared_shortcoming(), seed);
    EXPECT_EQ(found.verdict, Verdict::kConsistent) << found.sentence;
    EXPECT_TRUE(found.claims.empty());
  }
}

TEST(Difference, ThatOneEffectMakesHasItsNameAndItsShare) {
  TrueWheel digging = shared_shortcoming();
  const auto shared = digging.sinkage;
  digging.sinkage = [shared](const WheelRun& run, double h) {
    return shared(run, h) * (1 + 1.2 * (1 - std::exp(-2 * std::max(run.slip_ratio, 0.0))));
  };
  const Diagnosis found = compared(digging, shared_shortcoming(), 4);
  ASSERT_FALSE(found.claims.empty()) << found.sentence;
  const Claim& claim = found.claims.front();
  EXPECT_TRUE(claim.is_of("slip_sinkage")) << found.sentence;
  EXPECT_NE(found.sentence.find("above the reference at slip ratio"), std::string::npos)
      << found.sentence;
  ASSERT_TRUE(claim.share);
  EXPECT_GT(claim.share->explained, 0.5);
  EXPECT_LE(claim.share->low, claim.share->explained);
  EXPECT_GE(claim.share->high, claim.share->explained);
}

/// Of a large difference a form that is nearly right leaves more than noise, and yet no part.
TEST(Difference, LeavesAPartWithoutANameOnlyWhereThatIsProvenAndWorthAName) {
  const LackOfFit proven{.p_value = Thresholds::kDifference_p / 10};
  const LackOfFit chance{.p_value = 2 * Thresholds::kDifference_p};
  const auto explaining = [](double share) {
    return std::vector<Claim>{{.id = "slip_sinkage", .share = Share{.explained = share}}};
  };
  EXPECT_FALSE(leaves_a_part(proven, explaining(1 - 0.5 * Thresholds::kWorthAnother)));
  EXPECT_TRUE(leaves_a_part(proven, explaining(1 - 2 * Thresholds::kWorthAnother)));
  EXPECT_FALSE(leaves_a_part(chance, explaining(0.5)));
  EXPECT_TRUE(leaves_a_part(proven, {{.id = "slip_sinkage"}})) << "no share was measured";
}

/// Root mean square of a channel of the test less what the corrected model says of it without it,
/// and less what the base model says.
struct Errors {
  double held_out = 0, base = 0;
};

Errors errors_of(const Diagnosis& found, Channel channel) {
  Errors sum;
  double runs = 0;
  for (const RunResidual& run : found.residuals) {
    if (run.channel != channel) continue;
    sum.held_out += std::pow(run.measured - run.held_out, 2);
    sum.base += std::pow(run.measured - run.baseline, 2);
    ++runs;
  }
  return {std::sqrt(sum.held_out / runs), std::sqrt(sum.base / runs)};
}

TEST(Difference, IsHandedOnWithWhatTheReferenceSaysOfSharedShortcomings) {
  TrueWheel flat;
  flat.sinkage = [](const WheelRun& run, double h) {
    return h * (run.slip_angle_rad > 0.1 ? 1.9 : 0.9) * (run.slip_ratio > 0.1 ? 0.6 : 1.5);
  };
  TrueWheel digging = flat;
  digging.sinkage = [flat](const WheelRun& run, double h) {
    return flat.sinkage(run, h) * (1 + 1.2 * (1 - std::exp(-2 * std::max(run.slip_ratio, 0.0))));
  };
  const Diagnosis found = compared(digging, flat, 4);
  ASSERT_FALSE(found.claims.empty()) << found.sentence;
  EXPECT_TRUE(std::ranges::any_of(found.corrected_model.mechanisms,
                                  [](const Mechanism& m) { return m.id == "slip_sinkage"; }));
  const Errors errors = errors_of(found, Channel::kSinkage);
  EXPECT_LT(errors.held_out, errors.base / 3);
  // What is still unknown of the soil after the reference is handed on with it.
  const UncertainSoil before = simulant_setup().soil;
  for (const SoilPull& pull : found.soil) {
    EXPECT_GT(pull.calibrated.standard_deviation, 0) << pull.parameter;
    EXPECT_LE(pull.calibrated.standard_deviation, pull.prior.standard_deviation) << pull.parameter;
  }
  for (const SoilParameter& p : soil_parameters()) {
    EXPECT_EQ(before.standard_deviation.*p.member > 0,
              found.corrected_soil.standard_deviation.*p.member > 0)
        << p.name;
  }
  EXPECT_FALSE(found.soil.empty());
}

/// A test whose drawbar pull lies off its reference's by a constant, on a bed of one load.
Diagnosis off_by(double bias_n) {
  const DiagnosisSetup setup = simulant_setup();
  std::mt19937_64 random(11);
  const Soil soil = draw(setup.soil, setup.wheel.width_m, random);
  const BedPlan plan{.slips = {-0.3, 0, 0.2, 0.4, 0.7},
                     .angles_deg = {0, 8, 16},
                     .loads_n = {64.7},
                     .conditions = 26,
                     .replicates = 4};
  TrueWheel off;
  off.fx_n = [bias_n](const WheelRun&, double) { return bias_n; };
  return diagnose_difference(record(off, setup, soil, plan, 11), setup,
                             {{"reference", record({}, setup, soil, plan, 111), setup}});
}

double probability_of(const Diagnosis& found, const std::string& id) {
  const auto ranked = std::ranges::find(found.ranking, id, &ScoredCandidate::id);
  return ranked == found.ranking.end() ? 0 : ranked->probability;
}

TEST(Difference, IsDoubtfulBeforeItIsProven) {
  bool doubtful = false;
  double none = 1;
  for (double bias_n = 0; bias_n < 4; bias_n += 0.1) {
    const Diagnosis found = off_by(bias_n);
    if (found.verdict != Verdict::kConsistent) break;
    const bool noted = std::ranges::any_of(found.notes, [](const std::string& note) {
      return note.starts_with("test and reference may differ");
    });
    EXPECT_EQ(noted, found.before.p_value < 0.05);
    EXPECT_EQ(noted, found.sentence.find("may differ") != std::string::npos) << found.sentence;
    EXPECT_GE(probability_of(found, "none"), 0.5);
    doubtful = doubtful || noted;
    none = std::min(none, probability_of(found, "none"));
  }
  EXPECT_TRUE(doubtful);
  EXPECT_LT(none, 0.96);
}

TEST(Difference, OfOneLoadIsOfASensorOrOfATiltedBed) {
  const Diagnosis found = off_by(-5);
  ASSERT_EQ(found.verdict, Verdict::kClass) << found.sentence;
  EXPECT_TRUE(found.claims.front().is_of("sensor_bias")) << found.sentence;
  EXPECT_TRUE(found.claims.front().is_of("slope_tilt")) << found.sentence;
  EXPECT_GT(found.claims.front().probability, 0.9);
}

TEST(Difference, OfWhatATurnedSensorDoesToBothIsNoneWhicheverSideEachWasDriven) {
  const DiagnosisSetup setup = simulant_setup();
  std::mt19937_64 random(21);
  const Soil soil = draw(setup.soil, setup.wheel.width_m, random);
  BedPlan plan{.slips = {-0.3, 0, 0.2, 0.4},
               .angles_deg = {-20, -15, -10, -5, 5, 10, 15, 20},
               .loads_n = {64.7},
               .conditions = 20,
               .replicates = 3};
  plan.instruments = [](WheelRun& run) {
    auto& values = run.measured;
    values[static_cast<std::size_t>(Channel::kFx)] +=
        0.2 * values[static_cast<std::size_t>(Channel::kFy)];
  };
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Diagnosis found =
        diagnose_difference(record({}, setup, soil, plan, seed), setup,
                            {{"reference", record({}, setup, soil, plan, seed + 100), setup}});
    EXPECT_EQ(found.verdict, Verdict::kConsistent) << found.sentence;
  }
}

/// In each of 44 conditions it is less than what one run scatters; together they leave no doubt.
TEST(Difference, OfASmallShiftThroughoutIsProven) {
  const DiagnosisSetup setup = simulant_setup();
  TrueWheel shifted;
  shifted.torque_nm = [](const WheelRun&, double) { return 0.08; };  // a run scatters by 0.09 N m
  const Diagnosis found = diagnose_difference(
      record(shifted, setup, setup.soil.mean, {.day = 0, .outliers = 0}, 31), setup,
      {{"reference", record({}, setup, setup.soil.mean, {.day = 0, .outliers = 0}, 32), setup}});
  EXPECT_LT(found.before.p_value, Thresholds::kDifference_p);
  EXPECT_LT(found.before.f, found.before.critical);  // no misfit would prove it
  EXPECT_NE(found.verdict, Verdict::kConsistent) << found.sentence;
}

/// A test that pulls and is driven as a wheel with lugs is, against one without.
Diagnosis of_lugs(std::optional<double> test_height_m, std::optional<double> reference_height_m) {
  DiagnosisSetup setup = simulant_setup(), smooth = setup;
  setup.lug_height_m = test_height_m;
  smooth.lug_height_m = reference_height_m;
  const BedPlan plan{.slips = {-0.3, 0, 0.2, 0.4, 0.7},
                     .angles_deg = {0, 8, 16},
                     .loads_n = {64.7},
                     .conditions = 15,
                     .replicates = 3};
  TrueWheel lugs = shared_shortcoming();
  const auto shared = lugs.fx_n;
  lugs.fx_n = [shared](const WheelRun& run, double h) {
    return shared(run, h) + 9 * (1 - std::exp(-5 * std::max(run.slip_ratio, 0.0)));
  };
  lugs.torque_nm = [](const WheelRun& run, double) {
    return 0.9 * (1 - std::exp(-5 * std::max(run.slip_ratio, 0.0)));
  };
  return diagnose_difference(
      record(lugs, setup, setup.soil.mean, plan, 21), setup,
      {{"reference", record(shared_shortcoming(), smooth, setup.soil.mean, plan, 22), smooth}});
}

bool asks_of_lugs_alone(const Diagnosis& found) {
  return std::ranges::any_of(found.notes, [](const std::string& note) {
    return note.starts_with("test and reference tell different lugs");
  });
}

TEST(Difference, OfLugsThatAreToldIsAskedForBeforehand) {
  const Diagnosis told = of_lugs(0.01, 0), untold = of_lugs({}, {});
  EXPECT_TRUE(asks_of_lugs_alone(told));
  EXPECT_FALSE(asks_of_lugs_alone(untold));
  EXPECT_GT(probability_of(told, "grousers"), 0);
  // Odds that are told beforehand are odds over a difference without a name, too.
  EXPECT_LT(probability_of(told, "unexplained"), probability_of(untold, "unexplained"));
  // one name reaches less by chance than the best of all
  EXPECT_LT(told.chance_nats, untold.chance_nats);
}

TEST(Difference, OfLugsNeedsBothToTellThem) {
  const Diagnosis same = of_lugs(0.01, 0.01);
  EXPECT_TRUE(std::ranges::none_of(
      same.ranking, [](const ScoredCandidate& one) { return one.id == "grousers"; }));
  EXPECT_FALSE(asks_of_lugs_alone(same));
  EXPECT_FALSE(asks_of_lugs_alone(of_lugs(0.01, {})));
}

TEST(Difference, IsNotMadeOfOutliersThatNoReplicateTells) {
  DiagnosisSetup setup = simulant_setup();
  setup.noise_standard_deviation = {
      {Channel::kFx, 1}, {Channel::kFy, 1}, {Channel::kTorque, 0.09}, {Channel::kSinkage, 5e-4}};
  std::mt19937_64 random(31);
  const Soil soil = draw(setup.soil, setup.wheel.width_m, random);
  const BedPlan plan{.replicates = 1, .outliers = 0};
  const Recording reference = record({}, setup, soil, plan, 31);
  Recording test = record({}, setup, soil, plan, 32);
  double& pull_n = test.runs[20].measured[static_cast<std::size_t>(Channel::kFx)];
  const double as_measured_n = pull_n;
  for (const double off_n : {-9, 9}) {
    pull_n = as_measured_n + off_n;
    const Diagnosis found = diagnose_difference(test, setup, {{"reference", reference, setup}});
    EXPECT_EQ(found.verdict, Verdict::kConsistent) << found.sentence;
  }
}

TEST(Difference, AFurtherPassOfOneSeriesAloneIsNoDifferenceBetweenTwo) {
  // In the rut of the first pass the wheel sinks half as deep: far beyond the noise, on passes that
  // the reference happens not to have driven.
  const DiagnosisSetup setup = simulant_setup();
  std::mt19937_64 random(5);
  const Soil soil = draw(setup.soil, setup.wheel.width_m, random);
  const BedPlan plan{
      .slips = {0, 0.2, 0.4}, .angles_deg = {0, 8, 16}, .conditions = 20, .replicates = 2};
  const Recording reference = record({}, setup, soil, plan, 6);
  Recording test = record({}, setup, soil, plan, 7);
  test.columns.pass = true;
  const auto in_the_rut = [](WheelRun& run) {
    run.conditions.pass = 2;
    run.measured[static_cast<std::size_t>(Channel::kSinkage)] *= 0.5;
  };
  Recording all_in_the_rut = test;
  std::for_each(test.runs.end() - 6, test.runs.end(), in_the_rut);
  std::ranges::for_each(all_in_the_rut.runs, in_the_rut);

  const Diagnosis some = diagnose_difference(test, setup, {{"reference", reference, setup}});
  EXPECT_EQ(some.verdict, Verdict::kConsistent) << some.sentence;
  EXPECT_TRUE(std::ranges::any_of(some.notes, [](const std::string& note) {
    return note.starts_with("6 runs are of a pass that no reference drove");
  }));
  const Diagnosis all =
      diagnose_difference(all_in_the_rut, setup, {{"reference", reference, setup}});
  EXPECT_NE(all.verdict, Verdict::kConsistent) << all.sentence;
}

TEST(Difference, IsTheSameInWhateverOrderReferencesAreGiven) {
  const DiagnosisSetup setup = simulant_setup();
  const TrueWheel wheel = shared_shortcoming();
  const auto with = [&](std::uint64_t seed, int replicates) {
    const BedPlan plan{.slips = {-0.3, 0, 0.2, 0.4, 0.7},
                       .angles_deg = {0, 8, 16},
                       .loads_n = {45, 64.7},
                       .conditions = 20,
                       .replicates = replicates};
    return record(wheel, setup, setup.soil.mean, plan, seed);
  };
  const Recording test = with(1, 2);
  const Reference once{"once", with(2, 1), setup}, twice{"twice", with(3, 2), setup};
  const Diagnosis forth = diagnose_difference(test, setup, {once, twice});
  const Diagnosis back = diagnose_difference(test, setup, {twice, once});
  EXPECT_EQ(forth.verdict, back.verdict);
  EXPECT_NEAR(forth.before.f, back.before.f, 1e-3 * back.before.f);
}

TEST(Difference, NeedsAChannelThatBothMeasured) {
  const DiagnosisSetup setup = simulant_setup();
  std::mt19937_64 random(1);
  const Soil soil = draw(setup.soil, setup.wheel.width_m, random);
  Recording test = record({}, setup, soil, {.conditions = 12}, 1);
  Recording reference = test;
  test.channels = {Channel::kTorque};
  reference.channels = {Channel::kSinkage};
  EXPECT_THROW(diagnose_difference(test, setup, {{"reference", reference, setup}}), InputError);
}

}  // namespace
}  // namespace regoplan
