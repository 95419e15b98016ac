#include "app/diagnose/recording_checks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "app/diagnose/diagnosis_setup.h"
#include "terramech/basics/angles.h"
#include "tests/app/simulant_model.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

DiagnosisSetup simulant() {
  return read_setup(parse_settings(kSimulantModel, "setup.yaml")).setup;
}

/// What the model itself shows, of which a part is changed.
RecordingFile changed(const std::function<void(WheelRun&)>& change) {
  const DiagnosisSetup setup = simulant();
  const WheelModel model({.variant = setup.variant, .wheel = setup.wheel, .soil = setup.soil.mean});
  RecordingFile file{.file = "r.csv"};
  for (const double beta_deg : {0.0, 8.0, 16.0}) {
    for (const double slip : {-0.4, 0.0, 0.3, 0.6}) {
      WheelRun run{.run_id = "r", .load_n = 64.7, .slip_ratio = slip};
      run.slip_angle_rad = beta_deg * kDegree;
      const WheelForces forces = model.forces(run.load_n, motion_at(slip, run.slip_angle_rad));
      run.measured[0] = forces.fx_n;
      run.measured[1] = forces.fy_n;
      run.measured[2] = forces.torque_nm;
      run.measured[3] = forces.sinkage_m;
      change(run);
      file.recording.runs.push_back(run);
      file.lines.push_back(static_cast<std::int64_t>(file.lines.size()) + 2);
    }
  }
  file.recording.channels = {Channel::kFx, Channel::kFy, Channel::kTorque, Channel::kSinkage};
  return file;
}

void scale(WheelRun& run, Channel channel, double factor) {
  run.measured[static_cast<std::size_t>(channel)] *= factor;
}

std::string refusal(const std::function<void(WheelRun&)>& change) {
  return error_text([&] { doubtful_values(changed(change), simulant()); });
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
  }
}

TEST(RecordingChecks, FindNothingWhereUnitsAndSignsAreRight) {
  EXPECT_EQ(doubtful_values(changed([](WheelRun&) {}), simulant()), std::vector<std::string>{});
  // far off as physics goes, yet no unit does that
  const auto wrong_physics = [](WheelRun& run) {
    run.measured[0] -= 0.7 * run.load_n;  // loose soil, in which even driving wheels need a push
    scale(run, Channel::kFy, 2.5);
    scale(run, Channel::kSinkage, 3);
  };
  EXPECT_EQ(doubtful_values(changed(wrong_physics), simulant()), std::vector<std::string>{});
}

TEST(RecordingChecks, AUnitOffByPowersOfTenIsRefusedByItsName) {
  struct Case {
    Channel channel;
    double factor;
    const char* suspected;
  };
  for (const Case& at :
       {Case{Channel::kFx, 1e3, "fx_n in mN"}, Case{Channel::kFx, 1e-3, "fx_n in kN"},
        Case{Channel::kFy, 1e3, "fy_n in mN"}, Case{Channel::kTorque, 1e3, "torque_nm in N mm"},
        Case{Channel::kTorque, 1e2, "torque_nm in N cm"},
        Case{Channel::kSinkage, 1e3, "sinkage_m in mm"},
        Case{Channel::kSinkage, 1e2, "sinkage_m in cm"},
        Case{Channel::kSinkage, 1e-3, "sinkage_m in km"}}) {
    const std::string text = refusal([&](WheelRun& run) { scale(run, at.channel, at.factor); });
    expect_words(text, {"r.csv:", std::string(name(at.channel)), "suspected: ", at.suspected});
  }
}

TEST(RecordingChecks, ALoadInOtherUnitsIsSuspected) {
  expect_words(refusal([](WheelRun& run) { run.load_n /= 1000; }), {"load_n in kN"});
  expect_words(refusal([](WheelRun& run) { run.load_n /= 9.80665; }), {"load_n in kg (kgf)"});
  expect_words(refusal([](WheelRun& run) { run.load_n *= 1000; }),
               {"r.csv:2: load_n: 64700", "suspected: load_n not in N"});
}

TEST(RecordingChecks, SlipAnglesInRadiansAreSeenByTheirSideForces) {
  expect_words(refusal([](WheelRun& run) { run.slip_angle_rad *= kDegree; }),
               {"r.csv:6: slip_angle_deg: 0.139", "suspected: radians"});
  // angles that are truly small have small side forces
  const auto truly_small = [](WheelRun& run) {
    run.slip_angle_rad *= kDegree;
    scale(run, Channel::kFy, kDegree);
  };
  EXPECT_EQ(refusal(truly_small), "");
}

TEST(RecordingChecks, ColumnsOfForcesThatAreExchangedAreAskedFor) {
  const auto exchanged = [](WheelRun& run) { std::swap(run.measured[0], run.measured[1]); };
  const std::vector<std::string> found = doubtful_values(changed(exchanged), simulant());
  ASSERT_FALSE(found.empty());
  expect_words(found.back(), {"r.csv: fx_n and fy_n lie ", "columns exchanged; are they?"});
}

TEST(RecordingChecks, ForcesInKilogramsAreSuspectedByTheFactor) {
  const auto found_with = [](Channel channel, double factor) {
    return doubtful_values(changed([&](WheelRun& run) { scale(run, channel, factor); }),
                           simulant());
  };
  for (const Channel channel : {Channel::kFx, Channel::kFy, Channel::kTorque}) {
    const std::vector<std::string> small = found_with(channel, 1 / 9.80665);
    ASSERT_EQ(small.size(), 1u) << name(channel);
    const char* unit = channel == Channel::kTorque ? "kgf m for N m" : "kgf for N";
    expect_words(small[0], {std::string(name(channel)) + " is 0.1 times", unit});
    // Physics is missing as well: the channel in N would be 1.5 times the model's, or two thirds.
    for (const double beside : {1.5, 1 / 1.5}) {
      const std::vector<std::string> both = found_with(channel, beside / 9.80665);
      ASSERT_EQ(both.size(), 1u) << name(channel);
      expect_words(both[0], {unit});
    }
    EXPECT_TRUE(found_with(channel, 0.2).empty()) << "no unit does that";
    EXPECT_TRUE(found_with(channel, 0.4).empty()) << "physics does that";
  }
}

TEST(RecordingChecks, LoadsAndForcesInKilogramsAreSuspectedByTheSinkage) {
  const auto in_kilograms = [](WheelRun& run) {
    run.load_n /= 9.80665;
    for (const Channel channel : {Channel::kFx, Channel::kFy, Channel::kTorque}) {
      scale(run, channel, 1 / 9.80665);
    }
  };
  const std::vector<std::string> found = doubtful_values(changed(in_kilograms), simulant());
  ASSERT_EQ(found.size(), 1u);
  expect_words(found[0], {"r.csv: sinkage_m is", "load_n, and forces with it, in kgf"});
  // A soil in which wheels sink three times as deep is no unit: its forces are others.
  const auto loose = [](WheelRun& run) {
    scale(run, Channel::kSinkage, 3);
    run.measured[0] -= 0.5 * run.load_n;
  };
  EXPECT_TRUE(doubtful_values(changed(loose), simulant()).empty());
}

TEST(RecordingChecks, SeveralForcesInKilogramsAreLeftOutAndOneAloneStays) {
  const auto in_kilograms = [](std::initializer_list<Channel> channels) {
    return changed([&](WheelRun& run) {
      for (const Channel channel : channels) scale(run, channel, 1 / 9.80665);
    });
  };
  RecordingFile forces = in_kilograms({Channel::kFx, Channel::kFy});
  const RecordingFile before = forces;
  const std::optional<std::string> told = leave_out_kilograms(forces, simulant());
  ASSERT_TRUE(told);
  expect_words(*told, {"r.csv: fx_n, fy_n are left out", "9.80665 times"});
  EXPECT_EQ(forces.recording.channels, (std::vector{Channel::kTorque, Channel::kSinkage}));
  for (std::size_t i = 0; i < forces.recording.runs.size(); ++i) {
    const WheelRun& run = forces.recording.runs[i];
    EXPECT_TRUE(std::isnan(run.value(Channel::kFx)) && std::isnan(run.value(Channel::kFy)));
    EXPECT_EQ(run.value(Channel::kTorque), before.recording.runs[i].value(Channel::kTorque));
  }
  // An amplifier on another range does that to one channel: a sensor is then named.
  RecordingFile amplifier = in_kilograms({Channel::kFx});
  EXPECT_FALSE(leave_out_kilograms(amplifier, simulant()));
  EXPECT_EQ(amplifier.recording.channels, before.recording.channels);

  RecordingFile nothing_else = in_kilograms({Channel::kFx, Channel::kFy});
  nothing_else.recording.channels = {Channel::kFx, Channel::kFy};
  EXPECT_NE(error_text([&] {
              leave_out_kilograms(nothing_else, simulant());
            }).find("no other channel is measured"),
            std::string::npos);
}

TEST(RecordingChecks, AChannelOfAHandfulOfValuesIsLeftOutUnlessTheSetupTellsItsNoise) {
  const auto with_values = [](int values, std::vector<Channel> channels) {
    RecordingFile file = changed([left = values](WheelRun& run) mutable {
      if (left-- <= 0) {
        run.measured[static_cast<std::size_t>(Channel::kSinkage)] = WheelRun::kNotMeasured;
      }
    });
    file.recording.channels = std::move(channels);
    return file;
  };
  const std::vector<Channel> all{Channel::kFx, Channel::kFy, Channel::kTorque, Channel::kSinkage};
  RecordingFile three = with_values(3, all);
  const std::vector<std::string> told = leave_out_nearly_empty(three, simulant());
  ASSERT_EQ(told.size(), 1u);
  expect_words(told[0], {"r.csv: sinkage_m is left out: values in 3 of 12 rows tell",
                         "in 4 and more, or noise: {sinkage_m: ...} in the setup"});
  EXPECT_EQ(three.recording.channels, (std::vector{Channel::kFx, Channel::kFy, Channel::kTorque}));
  EXPECT_TRUE(std::isnan(three.recording.runs[0].value(Channel::kSinkage)));

  RecordingFile four = with_values(4, all);
  EXPECT_TRUE(leave_out_nearly_empty(four, simulant()).empty());
  DiagnosisSetup with_noise = simulant();
  with_noise.noise_standard_deviation[Channel::kSinkage] = 5e-4;
  EXPECT_TRUE(leave_out_nearly_empty(three = with_values(3, all), with_noise).empty());

  RecordingFile alone = with_values(3, {Channel::kSinkage});
  expect_words(error_text([&] { leave_out_nearly_empty(alone, simulant()); }),
               {"no other channel is measured"});
}

TEST(RecordingChecks, ASideForceThatOpposesTheConventionIsReported) {
  const auto warnings =
      doubtful_values(changed([](WheelRun& run) { scale(run, Channel::kFy, -1); }), simulant());
  ASSERT_EQ(warnings.size(), 1u);
  expect_words(warnings[0], {"r.csv:", "fy_n opposes the convention", "8 of 8 runs"});
}

TEST(RecordingChecks, ADrawbarPullThatOpposesTheMotionIsReported) {
  const auto warnings =
      doubtful_values(changed([](WheelRun& run) { scale(run, Channel::kFx, -1); }), simulant());
  ASSERT_EQ(warnings.size(), 1u);
  expect_words(warnings[0], {"r.csv:2: fx_n opposes a wheel that drives",
                             "is an axis of the sensor turned round?"});
}

TEST(RecordingChecks, WithoutATorqueTheSlipMayBeWhatIsTurned) {
  RecordingFile file = changed([](WheelRun& run) {
    scale(run, Channel::kFx, -1);
    run.measured[static_cast<std::size_t>(Channel::kTorque)] = WheelRun::kNotMeasured;
  });
  std::erase(file.recording.channels, Channel::kTorque);
  const auto warnings = doubtful_values(file, simulant());
  ASSERT_EQ(warnings.size(), 1u);
  expect_words(warnings[0], {"fx_n opposes", "or the sign of slip_ratio, turned round?"});
}

TEST(RecordingChecks, ASlipOfTheOtherSignIsRefused) {
  expect_words(refusal([](WheelRun& run) { run.slip_ratio = -run.slip_ratio; }),
               {"r.csv:2: slip_ratio: 0.4 is not valid", "above 0 where the wheel drives",
                "suspected: slip_ratio of the other sign"});
}

TEST(RecordingChecks, SinkageAboveTheSoilIsRefused) {
  expect_words(refusal([](WheelRun& run) { scale(run, Channel::kSinkage, -1); }),
               {"r.csv:2: sinkage_m: -0.0", "(allowed: from 0, the depth below the soil",
                "negative in 12 of 12 runs", "suspected: an axis that points up"});
  const auto noise_about_hard_ground = [side = -1](WheelRun& run) mutable {
    run.measured[static_cast<std::size_t>(Channel::kSinkage)] = 1e-3 * (side = -side);
  };
  EXPECT_EQ(refusal(noise_about_hard_ground), "");
}

TEST(RecordingChecks, AChannelOfZerosIsCalledDead) {
  for (const Channel channel : {Channel::kFx, Channel::kFy, Channel::kTorque, Channel::kSinkage}) {
    expect_words(refusal([&](WheelRun& run) { scale(run, channel, 0); }),
                 {"r.csv:", fmt::format("{}: 0 is not valid in every run", name(channel)),
                  "suspected: a dead channel; remedy: leave the column out"});
  }
  // straight ahead there is no side force
  const auto straight = [](WheelRun& run) {
    run.slip_angle_rad = 0;
    scale(run, Channel::kFy, 0);
  };
  EXPECT_EQ(refusal(straight), "");
}

TEST(RecordingChecks, OneOddValueIsAnOutlierNotAUnit) {
  const auto warnings = doubtful_values(changed([](WheelRun& run) {
                                          if (run.slip_ratio == 0.3 && run.slip_angle_rad == 0) {
                                            run.measured[0] = 5000;
                                          }
                                        }),
                                        simulant());
  ASSERT_EQ(warnings.size(), 1u);
  expect_words(warnings[0], {"r.csv:4: fx_n: 5000 is an outlier by size"});
}

}  // namespace
}  // namespace regoplan
