#include "diagnosis/fit/candidate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/fit/effect_list.h"
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

TEST(Hypothesis, HowLugsDigAndGripIsFreeOnlyWhereAReferenceTellsOfTheWheelWithoutThem) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = record({}, setup, setup.soil.mean, {.conditions = 12}, 1);
  const TestBed bed = condense(recording, setup).bed;
  const auto is_free = [&](EffectsOf of, const std::string& parameter) {
    const std::vector<Effect> effects = effects_for(bed, recording, of);
    const auto block = std::ranges::find(effects, "soil_block", &Effect::form);
    return std::ranges::any_of(block->coordinates,
                               [&](const Coordinate& c) { return c.name == parameter; });
  };
  for (const char* parameter : {"digging", "grip", "held"}) {
    EXPECT_TRUE(is_free(EffectsOf::kDifference, parameter)) << parameter;
    EXPECT_FALSE(is_free(EffectsOf::kRecording, parameter)) << parameter;
  }
}

TEST(Hypothesis, NoFitLeavesWhatTheNumbersOfAMechanismCanBe) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording =
      record({}, setup, setup.soil.mean, {.conditions = 12, .passes = true}, 1);
  for (const Effect& effect : effects_for(condense(recording, setup).bed, recording)) {
    if (effect.kind != EffectKind::kMechanism) continue;
    for (const double x : {-1e3, -30.0, 0.0, 30.0, 1e3}) {
      const auto size = static_cast<Eigen::Index>(effect.coordinates.size());
      const Eigen::VectorXd far = Eigen::VectorXd::Constant(size, x);
      EXPECT_NO_THROW(form_of(mechanism_at(effect, far))) << effect.id << " at " << x;
    }
  }
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
                              Coordinate{.scale = Scale::kLogarithmic, .centre = -1, .spread = 0.7},
                              Coordinate{.scale = Scale::kShare, .spread = 0.7, .max = 3}}) {
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

TEST(Hypothesis, ASensorThatIsTurnedKeepsTheResultantOfBothForces) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = record({}, setup, setup.soil.mean, {.conditions = 12}, 1);
  const TestBed bed = condense(recording, setup).bed;
  const Effect turned{.id = "sensor_crosstalk",
                      .kind = EffectKind::kTurn,
                      .coordinates = {{.name = "turn_rad", .spread = 1}},
                      .to = 0,
                      .from = 1};
  Eigen::VectorXd x(1);
  x << 0.3;
  const Eigen::VectorXd before = *predict(bed, {}, {}, Eigen::VectorXd(0));
  const Eigen::VectorXd after = *predict(bed, {}, {{turned}}, x);
  for (Eigen::Index i = 0; i < bed.channels[0].mean.size(); ++i) {
    const double fx_n = before[bed.offset(0) + i], fy_n = before[bed.offset(1) + i];
    EXPECT_NEAR(after[bed.offset(0) + i], fx_n * std::cos(0.3) + fy_n * std::sin(0.3), 1e-9);
    EXPECT_NEAR(after[bed.offset(1) + i], fy_n * std::cos(0.3) - fx_n * std::sin(0.3), 1e-9);
  }
}

/// A torque is the smaller number by the wheel's radius, but no weaker a signal.
TEST(Hypothesis, OfATorqueAsMuchMayLeakIntoAForceAsOfItsForceAtTheRim) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = record({}, setup, setup.soil.mean, {.conditions = 12}, 1);
  const auto effects = effects_for(condense(recording, setup).bed, recording);
  const auto spread_of = [&](const std::string& form) {
    return std::ranges::find_if(
               effects,
               [&](const Effect& e) { return e.id == "sensor_crosstalk" && e.form == form; })
        ->coordinates.front()
        .spread;
  };
  EXPECT_NEAR(spread_of("torque_nm into fx_n") * setup.wheel.radius_m, 0.08, 0.03);
  EXPECT_NEAR(spread_of("fx_n into torque_nm") / setup.wheel.radius_m, 0.08, 0.03);
}

/// What sinks in as a wheel slides, whichever way, is what sinks in as it slips while it only
/// drives straight ahead: one name for one thing.
TEST(Hypothesis, ToSlideIsToSlipWhereAWheelOnlyDrivesStraightAhead) {
  const DiagnosisSetup setup = simulant_setup();
  const auto offers_sliding = [&](const std::vector<double>& slips,
                                  const std::vector<double>& angles_deg) {
    const Recording recording =
        record({}, setup, setup.soil.mean, {.slips = slips, .angles_deg = angles_deg}, 1);
    return std::ranges::any_of(effects_for(condense(recording, setup).bed, recording),
                               [](const Effect& e) { return e.id == "sliding_sinkage"; });
  };
  const std::vector<double> driving{0.05, 0.15, 0.3, 0.5, 0.8};
  EXPECT_FALSE(offers_sliding(driving, {0}));
  EXPECT_TRUE(offers_sliding(driving, {0, 10}));
  EXPECT_TRUE(offers_sliding({-0.4, 0.05, 0.15, 0.3, 0.5}, {0}));
}

/// A recording of one day whose runs are ten minutes apart.
Recording timed(const DiagnosisSetup& setup) {
  Recording recording = record({}, setup, setup.soil.mean, {.conditions = 12}, 1);
  recording.columns.time = true;
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    recording.runs[i].day = 0;
    recording.runs[i].conditions.time_s = 600 * static_cast<double>(i);
  }
  return recording;
}

/// What a fault makes of each model value, beside that value and the time passed as a share of all.
struct FaultyValue {
  double before, after, passed;
};

std::vector<FaultyValue> faulty_values(const TestBed& bed, const Effect& effect, std::size_t c) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(effect.start.size()));
  x[0] = 2;
  const Eigen::VectorXd before = *predict(bed, {}, {}, Eigen::VectorXd(0));
  const Eigen::VectorXd after = *predict(bed, {}, {{effect}}, x);
  const double first = effect.fixed.at("first_time_s"), last = effect.fixed.at("last_time_s");
  std::vector<FaultyValue> values;
  for (std::size_t i = 0; i < bed.channels[c].conditions.size(); ++i) {
    const Eigen::Index row = bed.offset(c) + static_cast<Eigen::Index>(i);
    const double time_s = bed.conditions[bed.channels[c].conditions[i]].conditions.time_s;
    values.push_back({before[row], after[row], (time_s - first) / (last - first)});
  }
  return values;
}

const Effect& fault(const std::vector<Effect>& effects, const std::string& id,
                    const std::string& form) {
  return *std::ranges::find_if(effects,
                               [&](const Effect& e) { return e.id == id && e.form == form; });
}

TEST(Hypothesis, NoFaultChangesInTimeWhereTheRecordingTellsNone) {
  const DiagnosisSetup setup = simulant_setup();
  Recording recording = timed(setup);
  recording.columns.time = false;
  for (WheelRun& run : recording.runs) run.conditions.time_s = 0;
  const auto changes = [](const Effect& e) { return e.course != FaultCourse::kConstant; };
  EXPECT_TRUE(
      std::ranges::none_of(effects_for(condense(recording, setup).bed, recording), changes));
}

/// A clock may tell seconds since the series began or since 1970: soil that dries dries alike.
TEST(Hypothesis, ACourseOfCohesionIsTheSameWhereverTheClockStands) {
  constexpr double kEpoch_s = 1.7e9;
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = timed(setup);
  Recording later = recording;
  for (WheelRun& run : later.runs) run.conditions.time_s += kEpoch_s;
  const TestBed bed = condense(recording, setup).bed, later_bed = condense(later, setup).bed;
  const std::vector<Effect> effects = effects_for(bed, recording),
                            later_effects = effects_for(later_bed, later);
  const Eigen::VectorXd before = *predict(bed, {}, {}, Eigen::VectorXd(0));
  for (const char* form : {"linear", "drying"}) {
    const Effect& drift = fault(effects, "cohesion_drift", form);
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(std::ssize(drift.coordinates), -1);
    const Eigen::VectorXd after = *predict(bed, {}, {{drift}}, x);
    const Eigen::VectorXd after_later =
        *predict(later_bed, {}, {{fault(later_effects, "cohesion_drift", form)}}, x);
    EXPECT_GT((after - before).cwiseAbs().maxCoeff(), 0.5) << form;
    EXPECT_LT((after - after_later).cwiseAbs().maxCoeff(), 1e-3) << form;
  }
}

/// The faults that a recording of one day may have.
class ChangingFault : public testing::Test {
 protected:
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = timed(setup);
  const TestBed bed = condense(recording, setup).bed;
  const std::vector<Effect> effects = effects_for(bed, recording);
};

TEST_F(ChangingFault, AGainThatSettlesIsLargestAtFirst) {
  const Effect& settling = fault(effects, "sensor_gain", "settling fx_n fy_n");
  const double gain = 2 * settling.coordinates.front().spread;
  const double width = settling.fixed.at("last_time_s") - settling.fixed.at("first_time_s");
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const bool acts = c == settling.to || std::ranges::count(settling.also, c) > 0;
    for (const FaultyValue& v : faulty_values(bed, settling, c)) {
      const double share = std::exp(-v.passed * width / settling.coordinates[1].value(0));
      EXPECT_NEAR(v.after, v.before * (acts ? 1 + gain * share : 1), 1e-9);
    }
  }
  EXPECT_TRUE(is_told_by_time(settling));
  EXPECT_FALSE(has_one_form(settling));
}

TEST_F(ChangingFault, AGainThatDriftsIsLargestAtLast) {
  const Effect& drifting = fault(effects, "sensor_gain", "drifting torque_nm");
  const double gain = 2 * drifting.coordinates.front().spread;
  for (const FaultyValue& v : faulty_values(bed, drifting, drifting.to)) {
    EXPECT_NEAR(v.after, v.before * (1 + gain * v.passed), 1e-9);
  }
}

TEST_F(ChangingFault, AZeroThatSettlesOrDriftsIsAddedWhateverIsMeasured) {
  const Effect& settling = fault(effects, "sensor_bias", "settling fy_n");
  const Effect& drifting = fault(effects, "sensor_bias", "drifting fy_n");
  const double width = settling.fixed.at("last_time_s") - settling.fixed.at("first_time_s");
  const double bias = 2 * settling.coordinates.front().spread;
  for (const FaultyValue& v : faulty_values(bed, settling, settling.to)) {
    const double share = std::exp(-v.passed * width / settling.coordinates[1].value(0));
    EXPECT_NEAR(v.after - v.before, bias * share, 1e-9);
  }
  for (const FaultyValue& v : faulty_values(bed, drifting, drifting.to)) {
    EXPECT_NEAR(v.after - v.before, bias * v.passed, 1e-9);
  }
  EXPECT_FALSE(has_one_form(settling));
}

/// Three days of replicates, the zero of the drawbar pull off on one, by default the second.
class FaultOfADay : public testing::Test {
 protected:
  Recording on_three_days(double off = 1) const {
    Recording made = record({}, setup, setup.soil.mean, {.conditions = 30}, 1);
    for (WheelRun& run : made.runs) run.measured[0] += run.day == off ? kZero_n : 0;
    return made;
  }
  bool is_of_the_day(std::size_t c, Eigen::Index i) const {
    return bed.conditions[bed.channels[c].conditions[static_cast<std::size_t>(i)]].day == 1;
  }

  static constexpr double kZero_n = 10;
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = on_three_days();
  const TestBed bed = condense(recording, setup).bed;
  const std::vector<Effect> effects = effects_for(bed, recording);
};

TEST_F(FaultOfADay, IsLookedForBetweenTheTimesOfThatDay) {
  ASSERT_EQ(bed.times_apart_s.size(), 1);
  EXPECT_EQ(bed.times_apart_s[0].low, 86400);
  EXPECT_EQ(bed.times_apart_s[0].high, 86400);
}

TEST_F(FaultOfADay, AZeroOrGainIsThereOnThatDayOnly) {
  for (const std::string id : {"sensor_bias", "sensor_gain"}) {
    const Effect& zero = fault(effects, id, "for_a_time fx_n");
    const Eigen::VectorXd before = *predict(bed, {}, {}, Eigen::VectorXd(0));
    const Eigen::VectorXd after = *predict(bed, {}, {{zero}}, Eigen::VectorXd::Ones(1));
    const double spread = zero.coordinates.front().spread;
    for (Eigen::Index i = 0; i < bed.channels[0].mean.size(); ++i) {
      const double there = is_of_the_day(0, i) ? spread : 0;
      EXPECT_NEAR(after[i] - before[i], id == "sensor_bias" ? there : there * before[i], 1e-9);
    }
    EXPECT_TRUE(is_told_by_time(zero));
    EXPECT_FALSE(has_one_form(zero));
  }
}

TEST_F(FaultOfADay, ABedMayHaveBeenAnotherOnThatDayOnly) {
  const Effect& other_bed = fault(effects, "soil_change", "for_a_time");
  ASSERT_EQ(other_bed.coordinates.size(), 2);
  const Eigen::VectorXd before = *predict(bed, {}, {}, Eigen::VectorXd(0));
  constexpr double kIntegration_n = 1e-4;  // by which the two ways to integrate agree
  const Eigen::VectorXd alike = *predict(bed, {}, {{other_bed}}, Eigen::VectorXd::Zero(2));
  EXPECT_LT((alike - before).cwiseAbs().maxCoeff(), kIntegration_n);
  const Eigen::VectorXd after = *predict(bed, {}, {{other_bed}}, Eigen::VectorXd::Ones(2));
  for (Eigen::Index i = 0; i < bed.channels[0].mean.size(); ++i) {
    const double change = std::abs(after[i] - before[i]);
    EXPECT_EQ(change > kIntegration_n, is_of_the_day(0, i)) << change;
  }
  EXPECT_TRUE(is_told_by_time(other_bed));
}

TEST_F(FaultOfADay, TheRestMayBeWhatIsOffWhereTheFirstOrTheLastDayDiffers) {
  using Days = std::vector<std::array<double, 2>>;
  const auto days_of = [&](const std::string& id, double day) {
    const Recording made = on_three_days(day);
    Days days;
    for (const Effect& e : effects_for(condense(made, setup).bed, made)) {
      if (e.id != id || e.form != "for_a_time") continue;
      days.push_back({e.fixed.at("from_s") / 86400, e.fixed.at("to_s") / 86400});
    }
    return days;
  };
  for (const std::string id : {"soil_change", "cohesion_drift"}) {
    EXPECT_EQ(days_of(id, 0), (Days{{0, 0}, {1, 2}}));
    EXPECT_EQ(days_of(id, 1), (Days{{1, 1}}));
    EXPECT_EQ(days_of(id, 2), (Days{{2, 2}, {0, 1}}));
  }
}

TEST_F(FaultOfADay, IsNotLookedForWhereClocksStartAnewEachDay) {
  Recording made = on_three_days();
  made.columns.time = true;
  for (std::size_t i = 0; i < made.runs.size(); ++i) {
    made.runs[i].conditions.time_s = 600 * static_cast<double>(i % 30);
  }
  const CondensedRecording found = condense(made, setup);
  ASSERT_TRUE(found.course.has_value());
  EXPECT_EQ(found.course->column, "on_day");
  EXPECT_TRUE(found.bed.times_apart_s.empty());
}

TEST_F(FaultOfADay, IsLookedForOnlyWhereADayDiffers) {
  Recording alike = recording;
  for (WheelRun& run : alike.runs) run.measured[0] -= run.day == 1 ? kZero_n : 0;
  const TestBed without = condense(alike, setup).bed;
  EXPECT_TRUE(without.times_apart_s.empty());
  for (const Effect& effect : effects_for(without, alike)) {
    EXPECT_NE(effect.id, "soil_change");
    EXPECT_NE(effect.course, FaultCourse::kForATime);
  }
}

}  // namespace
}  // namespace regoplan
