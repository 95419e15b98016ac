#include "diagnosis/checks/instrument_checks.h"

#include <gtest/gtest.h>

#include "synthetic_bed.h"

namespace regoplan {
namespace {

constexpr double kNoise = 0.3;  // N, of one run's forces

Recording both_sides(const std::function<void(WheelRun&)>& instruments) {
  const DiagnosisSetup setup = simulant_setup();
  const BedPlan plan{.angles_deg = {-16, -8, 0, 8, 16},
                     .loads_n = {64.7},
                     .noise = kNoise,
                     .day = 0,
                     .outliers = 0,
                     .instruments = instruments};
  return record({}, setup, setup.soil.mean, plan, 1);
}

std::vector<std::string> checks(const std::function<void(WheelRun&)>& instruments) {
  return instrument_checks(condense(both_sides(instruments), simulant_setup()));
}

bool says(const std::vector<std::string>& findings, const std::string& words) {
  return std::ranges::any_of(findings, [&](const std::string& finding) {
    return finding.find(words) != std::string::npos;
  });
}

TEST(InstrumentChecks, AreSilentOnSoundInstruments) {
  EXPECT_TRUE(checks([](WheelRun&) {}).empty());
}

TEST(InstrumentChecks, SeeSideForceThatLeaksIntoPull) {
  const auto found = checks([](WheelRun& run) { run.measured[0] += 0.1 * run.measured[1]; });
  EXPECT_TRUE(says(found, "fx_n is not mirror-symmetric"));
}

TEST(InstrumentChecks, SeeABiasedSideForce) {
  const auto found = checks([](WheelRun& run) { run.measured[1] += 2; });
  EXPECT_TRUE(says(found, "fy_n is not mirror-symmetric"));
  EXPECT_TRUE(says(found, "fy_n straight ahead is +"));
}

/// Where all runs are of one day it moves all of them alike, and no number of pairs averages it
/// out.
TEST(InstrumentChecks, WhatTheOnlyDayMayDoIsNoFault) {
  const double offset_n = 1.8 * 0.5 * kNoise;  // of one day, assumed to be half of the noise
  Recording recording = both_sides([&](WheelRun& run) { run.measured[1] += offset_n; });
  for (WheelRun& run : recording.runs) run.day = 0;
  EXPECT_TRUE(instrument_checks(condense(recording, simulant_setup())).empty());
}

TEST(InstrumentChecks, SeeATiltedSinkageGauge) {
  const auto found = checks([](WheelRun& run) { run.measured[3] += 0.01 * run.slip_angle_rad; });
  EXPECT_TRUE(says(found, "sinkage_m is not mirror-symmetric"));
}

TEST(InstrumentChecks, SeeMorePowerThanTheAxleGives) {
  const auto found = checks([](WheelRun& run) { run.measured[2] *= 0.2; });
  EXPECT_TRUE(says(found, "more power than its axle"));
}

TEST(InstrumentChecks, PullThatTakesAllOfTheAxlesPowerWithinNoiseIsPossible) {
  // As much pull as the power allows, a little more in every other run.
  int runs = 0;
  const double radius_m = simulant_setup().wheel.radius_m;
  const auto found = checks([&](WheelRun& run) {
    const double off_nm = ++runs % 2 == 0 ? 0.01 : -0.01;
    run.measured[2] = run.measured[0] * radius_m * (1 - run.slip_ratio) + off_nm;
  });
  EXPECT_FALSE(says(found, "more power than its axle"));
}

}  // namespace
}  // namespace regoplan
