#include "drive_diagnosis/comparison/window_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "drive_diagnosis/fit/likely_edges.h"
#include "tests/drive_diagnosis/compared_drive.h"

namespace regoplan {
namespace {

void expect_agreement(const Compared& compared) {
  const std::vector<double> rms = compared.rms();
  const std::vector<std::string>& channels = compared.comparison->channels();
  for (std::size_t k = 0; k < channels.size(); ++k) {
    // Below what the sensors of `record` scatter in a window; the heading is smoothed to a
    // parabola.
    const double bound = channels[k] == "yaw_rate_rad_s"      ? 0.002
                         : channels[k].starts_with("torque_") ? 0.8
                         : channels[k] == "left_mps"          ? 0.02
                                                              : 0.01;
    EXPECT_LT(rms[k], bound) << channels[k];
  }
}

TEST(DriveWindows, SmoothedVelocitiesAreTheSharesOfWhatWasDrivenInEachPart) {
  DriveRecording drive{.drive_id = "steps", .file = "steps.csv"};
  DriveChannel yaw{.name = "yaw_rad", .values = {}};
  const auto speed_mps = [](int part) { return 1 + 0.3 * (part * part % 5); };
  double x_m = 0;
  for (int step = 0; step <= 80; ++step) {
    drive.time_s.push_back(0.1 * step);
    drive.x_m.push_back(x_m);
    drive.y_m.push_back(0);
    yaw.values.push_back(0);
    x_m += 0.1 * speed_mps(step / 5);
  }
  drive.channels.push_back(yaw);
  const auto windows = drive_windows(drive, 0, 8.05, 0);
  ASSERT_EQ(windows.size(), 1u);
  double expected_mps = 0, track = 0, turn = 0, mean = 0;
  for (const WindowPart& part : windows[0].divided(16)) {
    expected_mps += part.track_share * speed_mps(static_cast<int>(part.start_s / 0.5 + 0.5));
    track += part.track_share;
    turn += part.turn_share;
    mean += part.mean_share;
  }
  EXPECT_NEAR(windows[0].forward_mps, expected_mps, 1e-9);
  EXPECT_NEAR(track, 1, 1e-9);
  EXPECT_NEAR(turn, 1, 1e-9);
  EXPECT_NEAR(mean, 1, 1e-9);
}

TEST(DriveWindows, AnEndOfTheRecordingIsSmoothedOneSidedAndScattersAsMuchMoreAsIsTold) {
  // Fixes once a second that scatter, of a vehicle that drives straight on: what windows in the
  // middle and the last of all tell of its speed and heading, over many such recordings.
  constexpr double kFix_m = 0.02, kYaw_rad = 0.02, kSpeed_mps = 1.5;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double middle = 0, last = 0, told = 0, yaw_last = 0, yaw_told = 0;
  constexpr int kRecordings = 400;
  for (int i = 0; i < kRecordings; ++i) {
    DriveRecording drive{.drive_id = "straight", .file = "straight.csv"};
    DriveChannel yaw{.name = "yaw_rad", .values = {}};
    for (int step = 0; step <= 300; ++step) {
      const bool fix = step % 10 == 0 && step < 300;
      drive.time_s.push_back(0.1 * step);
      drive.x_m.push_back(fix ? 0.1 * step * kSpeed_mps + kFix_m * normal(random) : kNotSampled);
      drive.y_m.push_back(fix ? kFix_m * normal(random) : kNotSampled);
      yaw.values.push_back(static_cast<float>(fix ? kYaw_rad * normal(random) : kNotSampled));
    }
    drive.channels.push_back(yaw);
    const auto windows = drive_windows(drive, 0, 5, 0.3);
    ASSERT_GE(windows.size(), 5u);
    const DriveWindow &inner = windows[2], &outer = windows.back();
    middle += std::pow(inner.forward_mps - kSpeed_mps, 2) / kRecordings;
    last += std::pow(outer.forward_mps - kSpeed_mps, 2) / kRecordings;
    yaw_last += std::pow(outer.yaw_rate_rad_s, 2) / kRecordings;
    told = kFix_m * outer.velocity_by_fix_1ps;
    yaw_told = kYaw_rad * outer.yaw_rate_by_fix_1ps;
  }
  EXPECT_GT(last, 4 * middle);
  EXPECT_NEAR(std::sqrt(last) / told, 1, 0.1);
  EXPECT_NEAR(std::sqrt(yaw_last) / yaw_told, 1, 0.1);
}

TEST(WindowComparison, TheLastWindowIsToldToScatterMoreThanMostAsItsFixesLieToOneSide) {
  const TerrainMap map = rolling_map();
  const Vehicle vehicle = preset_vehicle("lrv");
  const std::vector<DriveRecording> drives = {record({.seed = 2}, map)};
  const std::vector<DriveWindow> windows = drive_windows(drives[0], 0, 5, 0.3);
  const WindowComparison comparison(drives, windows, map, vehicle, 1.62, 2);
  ASSERT_GT(comparison.size(), 20u);
  const Eigen::MatrixXd& more = comparison.more_std();
  const auto last = more.rows() - 1;
  constexpr double kFix_m = 0.02;  // of `record`
  const DriveWindow &inner = windows[comparison.window(10)],
                    &outer = windows[comparison.window(comparison.size() - 1)];
  const double expected_mps = kFix_m * std::sqrt(std::pow(outer.velocity_by_fix_1ps, 2) -
                                                 std::pow(inner.velocity_by_fix_1ps, 2));
  EXPECT_GT(expected_mps, 0.003);
  EXPECT_NEAR(more(last, 0), expected_mps, 0.3 * expected_mps);
  EXPECT_LT(more(10, 0), 0.2 * expected_mps);  // what the comparison errs by itself
  EXPECT_GT(more(last, 2), 0.002);
  // Torques are no fixes.
  for (Eigen::Index k = 3; k < more.cols(); ++k) {
    EXPECT_GT(more(last, k), 0);
    EXPECT_LT(more(last, k), 0.02);
  }
}

TEST(WindowComparison, TorquesThatJumpWhereSteeringDoesAreNotTakenForScatter) {
  const TerrainMap map = rolling_map();
  const Vehicle vehicle = preset_vehicle("lrv");
  std::vector<DriveRecording> drives = {record({.torque_scatter = 0, .sensor_noise = 0}, map)};
  // A sensor's scatter, and beside it what a follower does that steers anew every second.
  constexpr double kScatter_nm = 0.2, kJump_nm = 4;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (DriveChannel& channel : drives[0].channels) {
    if (!channel.name.starts_with("torque_")) continue;
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      const bool is_jump = i / 10 % 3 == 0 && i % 10 == 0;
      channel.values[i] +=
          static_cast<float>(kScatter_nm * normal(random) + (is_jump ? kJump_nm : 0));
    }
  }
  const std::vector<DriveWindow> windows = drive_windows(drives[0], 0, 5, 0.3);
  const WindowComparison comparison(drives, windows, map, vehicle, 1.62, 2);
  const std::size_t torque = comparison.channel("torque_front_left_nm").value();
  const double of_a_window = kScatter_nm / std::sqrt(50);
  EXPECT_NEAR(comparison.sampled_std()[torque], of_a_window, 0.25 * of_a_window);
}

TEST(WindowComparison, PredictsADriveOfConstantCommands) {
  SimulatedDrive drive;
  drive.speed_mps = [](double, double) { return 1.2; };
  drive.weave_1pm = [](double, double) { return 0.0; };
  expect_agreement(Compared(drive));
}

TEST(WindowComparison, PredictsADriveWhoseSpeedAndSteeringChangeAllTheTime) {
  SimulatedDrive drive;
  drive.speed_mps = [](double time_s, double) { return std::fmod(time_s, 9) < 4 ? 0.8 : 1.8; };
  drive.weave_1pm = [](double time_s, double) { return std::fmod(time_s, 7) < 3.5 ? 0.1 : -0.1; };
  const Compared compared(drive);
  EXPECT_GE(compared.comparison->size() + 1, compared.windows.size());
  expect_agreement(compared);
}

TEST(WindowComparison, SlipIsFollowedWhereAVehicleBeginsToBrake) {
  // Wheels that brake by .3 m/s2 slip by 5 % within a second: with parts of .6 s alone the window
  // in which that begins is 5 mm/s off, which looked like another soil.
  SimulatedDrive drive;
  drive.speed_mps = [](double time_s, double) {
    const double in_cycle_s = std::fmod(time_s, 30);
    return in_cycle_s < 15 ? 2.6 : std::max(1.1, 2.6 - 0.3 * (in_cycle_s - 15));
  };
  drive.weave_1pm = [](double, double) { return 0.0; };
  const Compared compared(drive);
  const Eigen::MatrixXd& measured = compared.comparison->measured();
  const Eigen::MatrixXd predicted = compared.comparison->predicted_as_said({});
  ASSERT_GT(measured.rows(), 15);
  for (Eigen::Index w = 1; w < measured.rows(); ++w) {  // the first begins at rest
    EXPECT_NEAR(predicted(w, 0), measured(w, 0), 0.0006) << "window " << w;
  }
}

TEST(WindowComparison, WindowsThatAreNotComparedAreCountedByReason) {
  SimulatedDrive drive;
  drive.speed_mps = [](double time_s, double) { return time_s > 40 && time_s < 60 ? 0.0 : 1.2; };
  const Compared compared(drive);
  const WindowsUsed& used = compared.comparison->used();
  int all = used.compared;
  for (const int count : used.left_out) all += count;
  EXPECT_EQ(all, static_cast<int>(compared.windows.size()));
  EXPECT_GE(used.left_out.at(static_cast<std::size_t>(LeftOut::kStanding)), 3);
}

TEST(WindowComparison, WindowsWithoutInputSayWhichColumnsHaveNoValueInHowManyOfThem) {
  Compared compared({});
  DriveRecording& drive = compared.drives[0];
  for (DriveChannel& channel : drive.channels) {
    if (channel.name != "steer_front_left_rad" && channel.name != "wheel_speed_rear_right_rad_s")
      continue;
    const double from_s = channel.name.starts_with("steer") ? 20 : 40;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      if (drive.time_s[i] > from_s) channel.values[i] = std::nanf("");
    }
  }
  const WindowComparison gaps(compared.drives, compared.windows, compared.map, compared.vehicle,
                              1.62, 1);
  const WindowsUsed& used = gaps.used();
  const std::map<std::string, int>& missing = used.columns_missing;
  ASSERT_EQ(missing.size(), 2u);
  const int without = used.left_out.at(static_cast<std::size_t>(LeftOut::kNoInput));
  EXPECT_EQ(missing.at("steer_front_left_deg"), without);
  EXPECT_GT(missing.at("wheel_speed_rear_right_rad_s"), 0);
  EXPECT_LT(missing.at("wheel_speed_rear_right_rad_s"), without);
}

TEST(WindowComparison, EachWheelComesOntoASoftStretchWhenItIsThereItself) {
  const OverAStretch drive;
  const Eigen::MatrixXd plain = drive.predicted({}), with = drive.predicted({drive.zone});
  const Eigen::MatrixXd& measured = drive.comparison->measured();
  for (const double edge : {drive.zone.begins, drive.zone.ends}) {
    const auto w = static_cast<Eigen::Index>(edge);
    const Eigen::RowVectorXd does = measured.row(w) - plain.row(w),
                             off = measured.row(w) - with.row(w);
    constexpr double kShare = 0.1;  // of what the stretch does there
    EXPECT_LT(off.norm(), kShare * does.norm()) << "at " << edge;
    EXPECT_LT(std::abs(off[0]), 0.001);
  }
}

TEST(WindowComparison, OnlyTheWindowsThatAreNamedArePredicted) {
  const OverAStretch drive;
  const Eigen::MatrixXd plain = drive.predicted({}), with = drive.predicted({drive.zone});
  const WindowSet touching = drive.comparison->touching({drive.zone});
  ASSERT_GT(touching.size(), 2U);
  ASSERT_LT(touching.size(), drive.comparison->size());
  EXPECT_EQ(drive.comparison->predicted(touching, {}, {drive.zone}, plain, {}), with);
  EXPECT_NE(plain, with);
}

TEST(WindowComparison, AFrontWheelTouchesAZoneBeforeTheMiddleOfTheVehicleDoes) {
  const OverAStretch drive;
  const auto before = static_cast<std::size_t>(drive.zone.begins);
  const auto does = [&](double begins) {
    WindowZone zone = drive.zone;
    zone.begins = begins;
    const WindowSet touching = drive.comparison->touching({zone});
    const auto row = static_cast<Eigen::Index>(before);
    const bool changes = drive.predicted({zone}).row(row) != drive.predicted({}).row(row);
    EXPECT_EQ(changes, std::ranges::binary_search(touching, before)) << begins;
    return changes;
  };
  EXPECT_TRUE(does(static_cast<double>(before) + 1.02));
  EXPECT_FALSE(does(static_cast<double>(before) + 1.95));
}

TEST(WindowComparison, AZoneIsWidenedAsFarAsWindowsFollowEachOther) {
  const OverAStretch drive;
  const auto windows = static_cast<double>(drive.comparison->size());
  const WindowZone inner = drive.comparison->widened({.begins = 5.3, .ends = 8.6}, 2);
  EXPECT_DOUBLE_EQ(inner.begins, 3.3);
  EXPECT_DOUBLE_EQ(inner.ends, 10.6);
  const WindowZone all = drive.comparison->widened({.begins = 1.3, .ends = windows - 0.4}, 2);
  EXPECT_DOUBLE_EQ(all.begins, 0);
  EXPECT_DOUBLE_EQ(all.ends, windows);
}

/// Scatter as what the stretch leaves of the measurement has it.
ResidualNoise noise_of(const OverAStretch& drive) {
  const Eigen::MatrixXd& measured = drive.comparison->measured();
  const auto channels = static_cast<std::size_t>(measured.cols());
  std::vector<bool> follows;
  for (std::size_t i = 0; i < drive.comparison->size(); ++i) {
    follows.push_back(drive.comparison->consecutive(i));
  }
  return ResidualNoise({.residuals = measured - drive.predicted({drive.zone}),
                        .columns = {},
                        .may_be_wrong = {},
                        .inputs = {},
                        .scatters_unknown = {},
                        .follows = follows,
                        .sizes = Eigen::MatrixXd::Zero(measured.rows(), measured.cols()),
                        .sampled_std = std::vector<double>(channels, 0.0),
                        .more_std = Eigen::MatrixXd::Zero(measured.rows(), measured.cols())});
}

TEST(LikelyEdges, AreWhereASoftStretchBeginsAndEnds) {
  const OverAStretch drive;
  WindowZone said = drive.zone;
  said.begins += 0.8;
  said.ends -= 0.7;
  const Eigen::MatrixXd& measured = drive.comparison->measured();
  const ResidualNoise noise = noise_of(drive);
  const LikelyEdges edges = likely_edges({.comparison = *drive.comparison,
                                          .deviation = {},
                                          .measured = measured,
                                          .predicted = drive.predicted({said}),
                                          .noise = noise},
                                         {said}, {});
  constexpr double kNear = 0.15;  // windows
  EXPECT_NEAR(edges.at.begins, drive.zone.begins, kNear);
  EXPECT_NEAR(edges.at.ends, drive.zone.ends, kNear);
  EXPECT_LE(edges.begins_ci95[0], drive.zone.begins);
  EXPECT_GE(edges.begins_ci95[1], drive.zone.begins);
  EXPECT_LE(edges.ends_ci95[0], drive.zone.ends);
  EXPECT_GE(edges.ends_ci95[1], drive.zone.ends);
}

TEST(LikelyEdges, SlantWhereTheWheelsOfOneSideComeOntoASoftStretchFirst) {
  const OverAStretch drive;
  WindowZone truth = drive.zone, said = drive.zone;
  truth.begins_slant = 0.7;
  truth.ends_slant = -0.7;
  said.begins += 0.3;
  const ResidualNoise noise = noise_of(drive);
  const LikelyEdges edges = likely_edges({.comparison = *drive.comparison,
                                          .deviation = {},
                                          .measured = drive.predicted({truth}),
                                          .predicted = drive.predicted({said}),
                                          .noise = noise},
                                         {said}, {});
  constexpr double kNear = 0.1, kSlant = 0.35;
  EXPECT_NEAR(edges.at.begins, truth.begins, kNear);
  EXPECT_NEAR(edges.at.begins_slant, truth.begins_slant, kSlant);
  EXPECT_NEAR(edges.at.ends_slant, truth.ends_slant, kSlant);
}

TEST(WindowComparison, WindowsWhoseWheelsAreInTheSameZonesArePredictedAlike) {
  // The search for edges predicts each window once for all edges that leave its wheels in place.
  const OverAStretch drive;
  const auto begin = static_cast<std::size_t>(drive.zone.begins);
  const auto over = [&](double begins) {
    WindowZone zone = drive.zone;
    zone.begins = begins;
    const WindowQuestion question{{}, {zone}};
    return std::pair{drive.comparison->zones_under_wheels(begin, question),
                     drive.comparison->predicted_each({{begin, question}}, {}).front()};
  };
  const auto middle = static_cast<double>(begin) + 0.5;
  const auto [zones, values] = over(middle);
  int alike = 0, other = 0;
  for (double off = -0.4; off < 0.45; off += 0.04) {
    const auto [there, predicted] = over(middle + off);
    ++(there == zones ? alike : other);
    EXPECT_EQ(there == zones, predicted == values) << off;
  }
  EXPECT_GT(alike, 0);
  EXPECT_GT(other, 10);
}

}  // namespace
}  // namespace regoplan
