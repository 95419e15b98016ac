#include "drive_diagnosis/recording/time_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace regoplan {
namespace {

DriveRecording at_times(std::vector<double> time_s) {
  DriveRecording drive{.drive_id = "d"};
  drive.time_s = std::move(time_s);
  for (const double t : drive.time_s) {
    drive.x_m.push_back(t);
    drive.y_m.push_back(0);
  }
  drive.channels = {{"yaw_rad", std::vector<float>(drive.time_s.size(), 0.F)}};
  return drive;
}

/// The value that is told of a finding; nothing where it is not told.
std::optional<double> told(const DriveRecording& drive, const std::string& id) {
  const auto found = std::ranges::find(drive.findings, id, &DriveFinding::id);
  return found == drive.findings.end() ? std::nullopt : found->value;
}

std::size_t positions(const DriveRecording& drive) {
  return static_cast<std::size_t>(
      std::ranges::count_if(drive.x_m, [](double x) { return !std::isnan(x); }));
}

/// Straight on at so many metres a second, a fix a second.
DriveRecording straight(double speed_mps) {
  std::vector<double> time_s;
  for (int i = 0; i < 60; ++i) time_s.push_back(i);
  DriveRecording drive = at_times(std::move(time_s));
  for (double& x : drive.x_m) x *= speed_mps;
  return drive;
}

TEST(MendTime, RowsInReverseOrderAreTurnedRound) {
  DriveRecording drive = at_times({6, 5, 4, 3, 3, 2, 1, 0.5, 0.4, 0.3, 0.2, 0.1, 0});
  drive.channels[0].values.front() = 7;
  mend_time(drive);
  EXPECT_TRUE(told(drive, "time_reversed"));
  EXPECT_FALSE(told(drive, "time_runs_back"));
  EXPECT_TRUE(std::ranges::is_sorted(drive.time_s));
  EXPECT_EQ(drive.x_m, drive.time_s);  // every row keeps what it held
  EXPECT_EQ(drive.channels[0].values.back(), 7);
}

TEST(MendTime, RowsOutOfOrderAndRepeatedTimesAreLeftOut) {
  DriveRecording drive = at_times({0, 1, 2, 1.5, 3, 3, 4});
  mend_time(drive);
  EXPECT_EQ(drive.time_s, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(drive.x_m, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(drive.channels[0].values.size(), 5);
  EXPECT_EQ(told(drive, "time_out_of_order"), 1);
  EXPECT_EQ(told(drive, "time_repeated"), 1);
}

TEST(MendTime, ShuffledRowsAreSortedAndToldOnce) {
  std::vector<double> time_s(200);
  for (std::size_t i = 0; i < time_s.size(); ++i) time_s[i] = 0.1 * static_cast<double>(i);
  const std::vector<double> in_order = time_s;
  std::mt19937 random(3);
  std::ranges::shuffle(time_s, random);
  DriveRecording drive = at_times(time_s);
  for (std::size_t i = 0; i < time_s.size(); ++i)
    drive.channels[0].values[i] = static_cast<float>(time_s[i]);
  mend_time(drive);
  EXPECT_EQ(drive.time_s, in_order);
  EXPECT_EQ(drive.x_m, in_order);  // every row keeps what it held
  EXPECT_EQ(drive.channels[0].values.back(), static_cast<float>(in_order.back()));
  ASSERT_EQ(drive.findings.size(), 1u);
  EXPECT_EQ(drive.findings[0].id, "time_out_of_order");
  EXPECT_NE(drive.findings[0].text.find("sorted by time"), std::string::npos);
}

TEST(MendTime, AClockThatStartsAnewAgainAndAgainIsNotTakenForShuffledRows) {
  std::vector<double> time_s;
  for (int i = 0; i < 60; ++i) time_s.push_back(i % 6);
  DriveRecording drive = at_times(time_s);
  mend_time(drive);
  EXPECT_TRUE(told(drive, "time_runs_back"));
  EXPECT_FALSE(told(drive, "time_out_of_order"));
  EXPECT_EQ(drive.size(), 60u);
}

TEST(MendTime, AClockThatIsSetBackForGoodCountsOn) {
  DriveRecording drive = at_times({10, 11, 12, 13, 2, 3, 4, 5, 6});
  mend_time(drive);
  EXPECT_EQ(drive.time_s, (std::vector<double>{10, 11, 12, 13, 14, 15, 16, 17, 18}));
  EXPECT_EQ(told(drive, "time_runs_back"), 11);
}

TEST(MendTime, ASoundClockIsLeftAlone) {
  DriveRecording drive = at_times({0, 0.1, 0.2, 5, 5.1});
  mend_time(drive);
  EXPECT_EQ(drive.time_s, (std::vector<double>{0, 0.1, 0.2, 5, 5.1}));
  EXPECT_TRUE(drive.findings.empty());
}

TEST(MendPositions, OfADriveAtTopSpeedNoneJumps) {
  DriveRecording drive = straight(3);
  mend_positions(drive, 3);
  EXPECT_TRUE(drive.findings.empty());
  EXPECT_EQ(positions(drive), 60);
}

TEST(MendPositions, AJumpIsLeftOutAndItsSizeTold) {
  DriveRecording drive = straight(3);
  drive.y_m[30] += 40;
  mend_positions(drive, 3);
  EXPECT_TRUE(std::isnan(drive.x_m[30]) && std::isnan(drive.y_m[30]));
  EXPECT_EQ(positions(drive), 59);
  ASSERT_TRUE(told(drive, "position_jump"));
  EXPECT_NEAR(*told(drive, "position_jump"), 40, 1);
}

TEST(MendPositions, AStepOfTheDatumIsTakenBackAndToldAndSoIsTheOneThatEndsIt) {
  for (const std::size_t end : {40U, 60U}) {
    DriveRecording drive = straight(3);
    const DriveRecording sound = drive;
    for (std::size_t i = 25; i < end; ++i) drive.y_m[i] += 5;
    mend_positions(drive, 3);
    ASSERT_TRUE(told(drive, "position_step"));
    EXPECT_NEAR(*told(drive, "position_step"), 5, 0.1);
    EXPECT_GE(positions(drive), 56);
    for (std::size_t i = 0; i < 60; ++i) {
      if (std::isnan(drive.x_m[i])) continue;
      EXPECT_NEAR(drive.x_m[i], sound.x_m[i], 0.2);
      EXPECT_NEAR(drive.y_m[i], sound.y_m[i], 0.2);
    }
  }
}

TEST(MendPositions, AStepBetweenFixesTwoSecondsApartIsTakenBackHoweverTheirStampsScatter) {
  for (const double scatter_s : {0.0, 0.002}) {
    DriveRecording drive = straight(3);
    for (std::size_t i = 0; i < drive.size(); ++i) {
      drive.time_s[i] = 2 * static_cast<double>(i) + (i % 2 == 0 ? 0 : scatter_s);
      drive.x_m[i] = 3 * drive.time_s[i];
      if (i >= 25) drive.y_m[i] += 15;
    }
    mend_positions(drive, 3);
    ASSERT_TRUE(told(drive, "position_step")) << scatter_s;
    EXPECT_NEAR(*told(drive, "position_step"), 15, 0.1);
    EXPECT_NEAR(drive.y_m[59], 0, 0.2);
  }
}

TEST(MendPositions, FixesThatScatterByMetresDoNotStep) {
  DriveRecording drive = straight(3);
  std::mt19937_64 random(1);
  std::normal_distribution<double> scatter(0, 2);
  for (double& y : drive.y_m) y += scatter(random);
  mend_positions(drive, 3);
  EXPECT_FALSE(told(drive, "position_step"));
}

TEST(MendPositions, RepeatsOfAFixAreStale) {
  DriveRecording drive = straight(3);
  for (std::size_t i = 0; i < drive.size(); ++i) drive.x_m[i] = drive.x_m[i - i % 4];
  mend_positions(drive, 3);
  EXPECT_EQ(positions(drive), 15);
  ASSERT_TRUE(told(drive, "stale_position"));
  EXPECT_DOUBLE_EQ(*told(drive, "stale_position"), 0.75);
}

TEST(MendPositions, AFewRepeatsAreNoFinding) {
  DriveRecording drive = straight(3);
  for (std::size_t i = 2; i < drive.size(); i += 3) drive.x_m[i] = drive.x_m[i - 1];
  mend_positions(drive, 3);
  EXPECT_FALSE(told(drive, "stale_position"));
}

}  // namespace
}  // namespace regoplan
