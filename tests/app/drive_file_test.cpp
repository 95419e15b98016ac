#include "app/diagnose_drive/drive_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "terramech/basics/input_error.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

using namespace std::string_literals;

DriveRecording read(const std::string& text, const DriveColumnMap& map = {}) {
  std::istringstream stream(text);
  return read_drive(stream, "2024-05-06_a.csv", map);
}

DriveColumnMap mapped(const std::string& yaml) {
  return read_drive_columns(parse_settings(yaml, "map.yaml"));
}

const DriveFinding* finding(const DriveRecording& drive, const std::string& id) {
  for (const DriveFinding& found : drive.findings) {
    if (found.id == id) return &found;
  }
  return nullptr;
}

TEST(DriveFile, UnitsAreBroughtToOneAndEmptyCellsAreNotSampled) {
  const DriveRecording drive = read(
      "time_s,x_m,y_m,yaw_deg,wheel_speed_left_rpm,note\n"
      "0,1,2,180,60,hello\n"
      "1,,,,30,\n");
  ASSERT_EQ(drive.size(), 2U);
  EXPECT_EQ(drive.day, "2024-05-06");
  EXPECT_NEAR(static_cast<double>(drive.channel("yaw_rad")->values[0]), M_PI, 1e-6);
  EXPECT_NEAR(static_cast<double>(drive.channel("wheel_speed_left_rad_s")->values[0]), 2 * M_PI,
              1e-5);
  EXPECT_TRUE(std::isnan(drive.x_m[1]));
  EXPECT_EQ(drive.ignored, std::vector<std::string>{"note"});
}

TEST(DriveFile, SomebodyElsesColumnsNeedAMapOnly) {
  const DriveColumnMap map = mapped(
      "columns:\n"
      "  x_m: pos_x\n"
      "  y_m: pos_y\n"
      "  wheel_speed_front_left_rad_s: vel1_rad_s\n"
      "  current_front_left_a: current1\n"
      "attitude_quaternion: {w: quat_w, x: quat_x, y: quat_y, z: quat_z}\n");
  const DriveRecording drive = read(
      "time_s,pos_x,pos_y,pos_z,quat_w,quat_x,quat_y,quat_z,enc1,vel1_rad_s,current1\n"
      "0,1,2,0,0.70710678,0,0,0.70710678,5,1.5,0.2\n",
      map);
  EXPECT_NEAR(static_cast<double>(drive.channel("yaw_rad")->values[0]), M_PI / 2, 1e-6);
  EXPECT_FLOAT_EQ(drive.channel("wheel_speed_front_left_rad_s")->values[0], 1.5F);
  EXPECT_FLOAT_EQ(drive.channel("current_front_left_a")->values[0], 0.2F);
}

TEST(DriveFile, WhatIsStaleByItsOwnAccountIsNotSampled) {
  const DriveRecording drive =
      read("time_s,x_m,y_m,ok\n0,1,1,1\n1,1,1,0\n2,2,2,1\n",
           mapped("columns:\n  x_m: {column: x_m, fresh: ok}\n  y_m: {column: y_m, fresh: ok}\n"));
  EXPECT_TRUE(std::isnan(drive.x_m[1]));
  EXPECT_DOUBLE_EQ(drive.x_m[2], 2);
}

TEST(DriveFile, TimeThatRunsBackIsToldAndNothingIsLost) {
  const DriveRecording drive =
      read("time_s,x_m,y_m\n10,0,0\n11,1,0\n12,2,0\n0,3,0\n1,4,0\n2,5,0\n3,6,0\n4,7,0\n");
  ASSERT_TRUE(finding(drive, "time_runs_back"));
  EXPECT_DOUBLE_EQ(*finding(drive, "time_runs_back")->value, 12);
  ASSERT_EQ(drive.size(), 8U);
  for (std::size_t i = 1; i < drive.size(); ++i) EXPECT_GT(drive.time_s[i], drive.time_s[i - 1]);
}

TEST(DriveFile, ARowOutOfOrderIsLeftOutAndTold) {
  const DriveRecording drive = read("time_s,x_m,y_m\n1,0,0\n3,1,0\n2,9,0\n4,2,0\n");
  ASSERT_TRUE(finding(drive, "time_out_of_order"));
  EXPECT_EQ(drive.size(), 3U);
}

TEST(DriveFile, WordsAmongNumbersAreToldWithTheirFirstLine) {
  std::string text = "time_s,x_m,y_m\n";
  for (int i = 0; i < 30; ++i) text += std::to_string(i) + (i == 7 ? ",nan,2\n" : ",1,2\n");
  const DriveRecording drive = read(text);
  ASSERT_TRUE(finding(drive, "no_number"));
  EXPECT_NE(finding(drive, "no_number")->text.find("2024-05-06_a.csv:9: x_m: nan"),
            std::string::npos);
  EXPECT_EQ(drive.size(), 30U);
}

TEST(DriveFile, WhereThePowerFailedTheTornRowIsLeftOutAndTold) {
  const std::string sound = "time_s,x_m,y_m\n0,1,1\n1,2,1\n2,3,1\n";
  for (const std::string& torn : {"3,4"s, "\0\0\0\0"s, "3,\0,1\n"s}) {
    const DriveRecording drive = read(sound + torn);
    EXPECT_EQ(drive.size(), 3U);
    const DriveFinding* found = finding(drive, "torn_row");
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->value, 1);
    EXPECT_NE(found->text.find("a.csv:5: "), std::string::npos) << found->text;
  }
}

TEST(DriveFile, AMissingColumnNamesTheWayOut) {
  EXPECT_NE(error_text([] { read("time,x_m,y_m\n0,1,2\n"); }).find("--columns"), std::string::npos);
}

TEST(DriveFile, AMapThatNamesNoColumnOfADriveIsRefused) {
  EXPECT_NE(error_text([] { mapped("columns:\n  speed: v\n"); }).find("map.yaml:2"),
            std::string::npos);
}

TEST(DriveFile, TooManyRowsAreAveragedAndToldSo) {
  std::string text = "time_s,x_m,y_m,current_left_a\n";
  constexpr int kRows = 1'200'000;
  for (int i = 0; i < kRows; ++i) {
    text += std::to_string(i) + "," + std::to_string(i) + ",0," + (i % 2 ? "3\n" : "1\n");
  }
  const DriveRecording drive = read(text);
  EXPECT_EQ(drive.rows_read, kRows);
  EXPECT_EQ(drive.size(), 600'000U);
  EXPECT_EQ(drive.rows_per_sample, 2);
  EXPECT_FLOAT_EQ(drive.channel("current_left_a")->values[1000], 2);
  EXPECT_TRUE(finding(drive, "averaged"));
}

}  // namespace
}  // namespace regoplan
