#include "drive_diagnosis/instruments/track_unit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "drive_diagnosis/drive_diagnosis.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

/// A drive whose time and positions are told in so many times s and m.
DriveRecording told_in(double time, double position) {
  DriveRecording drive = record({}, rolling_map());
  for (double& time_s : drive.time_s) time_s *= time;
  for (double& x_m : drive.x_m) x_m *= position;
  for (double& y_m : drive.y_m) y_m *= position;
  return drive;
}

/// What is suspected of it; empty: nothing.
std::string suspected(const DriveRecording& drive) {
  const Vehicle vehicle = preset_vehicle("lrv");
  const auto found = doubtful_track_unit(drive, &vehicle);
  return found ? found->id + ": " + found->text : "";
}

TEST(TrackUnit, OfTimeAndPositionsIsSuspectedByHowFarTheRimsRoll) {
  struct Case {
    double time, position;
    const char* words;
  };
  for (const Case& told : {Case{1e3, 1, "time in ms"},
                           {1e6, 1, "microseconds"},
                           {1e9, 1, "nanoseconds"},
                           {1 / 60.0, 1, "minutes"},
                           {1, 1e-3, "positions in km"},
                           {1, 3.2808, "feet"},
                           {1, 100, "positions in cm"},
                           {1, 1000, "positions in mm"}}) {
    const std::string text = suspected(told_in(told.time, told.position));
    EXPECT_TRUE(text.starts_with("unit: ")) << told.words;
    EXPECT_NE(text.find(told.words), std::string::npos) << text;
  }
  EXPECT_EQ(suspected(told_in(1, 1)), "");
  EXPECT_EQ(suspected(told_in(1, 0.5)), "");  // wheels of another radius, or that slip by half
  EXPECT_EQ(suspected(told_in(1, 2)), "");
}

TEST(TrackUnit, IsSuspectedByASensorOfSpeedWhereNoRimsAreKnown) {
  DriveRecording drive = told_in(1e3, 1);
  const auto is_of_a_wheel = [](const DriveChannel& channel) {
    return channel.name.starts_with("wheel_speed_");
  };
  const auto wheel = std::ranges::find_if(drive.channels, is_of_a_wheel);
  DriveChannel sensed{.name = "speed_mps", .values = wheel->values};
  const auto radius_m = static_cast<float>(preset_vehicle("lrv").wheel.radius_m);
  for (float& value : sensed.values) value *= radius_m;
  EXPECT_FALSE(doubtful_track_unit(drive, nullptr));  // a wheel's radius is not known
  drive.channels.push_back(std::move(sensed));
  EXPECT_TRUE(doubtful_track_unit(drive, nullptr));
  DriveRecording in_seconds = told_in(1, 1);
  in_seconds.channels = drive.channels;
  EXPECT_FALSE(doubtful_track_unit(in_seconds, nullptr));
}

TEST(TrackUnit, IsNotSuspectedOfAVehicleThatIsStuckOrTurnsRound) {
  DriveRecording stuck = told_in(1, 1);
  std::mt19937_64 random(1);
  std::normal_distribution<double> scatter(0, 0.02);
  for (std::size_t i = 0; i < stuck.size(); ++i) {
    if (std::isnan(stuck.x_m[i])) continue;
    stuck.x_m[i] = 10 + scatter(random);
    stuck.y_m[i] = 10 + scatter(random);
  }
  EXPECT_EQ(suspected(stuck), "");
  DriveRecording turns = told_in(1, 1);
  for (DriveChannel& channel : turns.channels) {
    if (!channel.name.starts_with("wheel_speed_") || !channel.name.ends_with("left_rad_s"))
      continue;
    for (float& value : channel.values) value *= -1;
  }
  EXPECT_EQ(suspected(turns), "");
}

DriveDiagnosis diagnosis_of(std::vector<DriveRecording> drives) {
  return diagnose_drives(
      std::move(drives),
      {.map = rolling_map(), .vehicle = preset_vehicle("lrv"), .gravity_mps2 = 1.62}, {});
}

TEST(TrackUnit, NothingIsClaimedOfADriveWhoseUnitIsInDoubt) {
  for (const auto& [time, position] : {std::pair{1e3, 1.0}, {1.0, 1e-3}, {1.0, 3.2808}}) {
    const DriveDiagnosis diagnosis = diagnosis_of({told_in(time, position)});
    EXPECT_EQ(diagnosis.verdict, DriveVerdict::kUndecided);
    EXPECT_TRUE(diagnosis.claims.empty() && !diagnosis.effects && !diagnosis.currents);
    ASSERT_EQ(diagnosis.findings.size(), 1u);
    EXPECT_EQ(diagnosis.findings[0].id, "unit");
    EXPECT_FALSE(diagnosis.findings[0].mended);
    ASSERT_FALSE(diagnosis.silent.empty());
    EXPECT_NE(diagnosis.silent[0].why.find("unit"), std::string::npos) << diagnosis.silent[0].why;
  }
}

TEST(TrackUnit, AllElseIsAsIfADriveInDoubtWereNotGiven) {
  const DriveDiagnosis alone = diagnosis_of({told_in(1, 1)});
  const DriveDiagnosis beside = diagnosis_of({told_in(1e3, 1), told_in(1, 1)});
  EXPECT_EQ(beside.verdict, alone.verdict);
  ASSERT_TRUE(beside.effects && alone.effects);
  EXPECT_EQ(beside.effects->windows, alone.effects->windows);
  EXPECT_EQ(beside.effects->rms_after, alone.effects->rms_after);
}

}  // namespace
}  // namespace regoplan
