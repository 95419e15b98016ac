#include "app/diagnose/recording_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/error_text.h"

namespace regoplan {
namespace {

constexpr const char* kRecording =
    "run_id,day,replicate,load_n,slip_ratio,slip_angle_deg,fx_n,fy_n,torque_nm,sinkage_m,wheel,"
    "oven_deg\n"
    "r1,2020-11-16,1,64.7,-0.25,0,-20,0.5,-0.8,0.012,smooth,21\n"
    "r2,2020-11-17,,65.1,0.30,16,4.5,18,1.2,,smooth,22\n"
    "\"r, 3\",2020-11-17,2,64.9,0.60,-16,6,-11,1.9,.021,smooth,\n";

RecordingFile read(const std::string& text) {
  std::istringstream stream(text);
  return read_recording(stream, "r.csv");
}

std::string recording_error(const std::string& from, const std::string& to) {
  return error_text([&] { read(replaced(kRecording, from, to)); });
}

TEST(RecordingFile, IsReadAsItStands) {
  const RecordingFile file = read(kRecording);
  const Recording& recording = file.recording;
  ASSERT_EQ(recording.runs.size(), 3u);
  const WheelRun& second = recording.runs[1];
  EXPECT_EQ(second.run_id, "r2");
  EXPECT_EQ(second.load_n, 65.1);
  EXPECT_EQ(second.slip_ratio, 0.3);
  EXPECT_EQ(second.slip_angle_rad, 16 * std::numbers::pi / 180);
  EXPECT_EQ(second.value(Channel::kFy), 18);
  EXPECT_EQ(second.wheel, "smooth");
  EXPECT_FALSE(second.replicate);
  EXPECT_EQ(recording.runs[2].replicate, 2);
  EXPECT_EQ(recording.runs[2].run_id, "r, 3");
  EXPECT_EQ(recording.runs[1].day - recording.runs[0].day, 1);
  EXPECT_EQ(file.lines, (std::vector<std::int64_t>{2, 3, 4}));
}

TEST(RecordingFile, AnEmptyCellIsNotMeasured) {
  const Recording recording = read(kRecording).recording;
  EXPECT_TRUE(std::isnan(recording.runs[1].value(Channel::kSinkage)));
  EXPECT_EQ(recording.runs[2].value(Channel::kSinkage), 0.021);
}

TEST(RecordingFile, SaysWhatWasRecorded) {
  const Recording recording = read(kRecording).recording;
  EXPECT_TRUE(recording.columns.day);
  EXPECT_TRUE(recording.columns.wheel);
  EXPECT_FALSE(recording.columns.pass);
  EXPECT_FALSE(recording.columns.speed);
  EXPECT_EQ(recording.channels, (std::vector<Channel>{Channel::kFx, Channel::kFy, Channel::kTorque,
                                                      Channel::kSinkage}));
  EXPECT_EQ(recording.ignored, std::vector<std::string>{"oven_deg"});
}

TEST(RecordingFile, AColumnOfEmptyCellsIsNotGivenAndHalfAColumnIsAnError) {
  const std::string head = "run_id,load_n,slip_ratio,slip_angle_deg,fx_n,pass,sinkage_m\n";
  const Recording recording = read(head + "a,60,0.1,0,3,,\nb,60,0.2,0,4,,\n").recording;
  EXPECT_FALSE(recording.columns.pass);
  EXPECT_EQ(recording.channels, std::vector<Channel>{Channel::kFx});
  EXPECT_EQ(
      error_text([&] { read(head + "a,60,0.1,0,3,1,\nb,60,0.2,0,4,,\n"); }),
      "r.csv:3: pass: an empty cell is not valid (allowed: a value in every row, or in none)");
}

TEST(RecordingFile, CircumstancesGoWhereTheModelLooksForThem) {
  const Recording recording =
      read(
          "run_id,load_n,slip_ratio,slip_angle_deg,fx_n,pass,speed_mps,position_m,time_s,"
          "wheel_angle_deg,day\na,60,0.1,0,3,2,0.05,1.5,-7,90,3.5\n")
          .recording;
  const WheelConditions& conditions = recording.runs[0].conditions;
  EXPECT_EQ(conditions.pass, 2);
  EXPECT_EQ(conditions.speed_mps, 0.05);
  EXPECT_EQ(conditions.position_m, 1.5);
  EXPECT_EQ(conditions.time_s, -7);
  EXPECT_EQ(conditions.wheel_angle_rad, 90 * (std::numbers::pi / 180));
  EXPECT_EQ(recording.runs[0].day, 3.5);
}

TEST(RecordingFile, WhatCannotBeIsAnErrorWithItsPlace) {
  const std::string one_of_three = "; 1 of 3 rows are out of range (up to 5 % are left out)";
  EXPECT_EQ(recording_error("64.7,", "0,"),
            "r.csv:2: load_n: 0 is not valid (allowed: above 0 to 1000000000)" + one_of_three);
  EXPECT_EQ(recording_error("64.7,", "-3,"),
            "r.csv:2: load_n: -3 is not valid (allowed: above 0 to 1000000000)" + one_of_three);
  const std::string empty = "; leave the cell empty where nothing was measured";
  EXPECT_EQ(recording_error("-20,", "nan,"),
            "r.csv:2: fx_n: nan is not valid (allowed: -1000000000 to 1000000000)" + empty);
  EXPECT_EQ(recording_error("4.5,18", "4.5,inf"),
            "r.csv:3: fy_n: inf is not valid (allowed: -1000000000 to 1000000000)" + empty);
  EXPECT_EQ(recording_error("0.30,16", "0.30,106"),
            "r.csv:3: slip_angle_deg: 106 is not valid (allowed: -90 to 90)" + one_of_three);
  EXPECT_EQ(recording_error("2020-11-16", "2020-02-30"),
            "r.csv:2: day: 2020-02-30 is not valid (allowed: a number or an ISO date such as "
            "2020-11-16)");
  EXPECT_EQ(recording_error("17,2,", "17,two,"),
            "r.csv:4: replicate: two is not valid (allowed: 0 to 1000000)");
  EXPECT_EQ(recording_error(",wheel,", ",wheel"), "r.csv:2: 12 cells (the header has 11)");
}

/// A recording of so many rows, some of them with a slip angle that no wheel can have.
std::string recording_with(int rows, int out_of_range) {
  std::string text = "run_id,load_n,slip_ratio,slip_angle_deg,fx_n\n";
  for (int i = 0; i < rows; ++i) {
    text += "r" + std::to_string(i) + ",64.7,0.3," + (i < out_of_range ? "90.04" : "16") + ",4.5\n";
  }
  return text;
}

TEST(RecordingFile, ARowThatIsACopyOfAnotherIsNoReplicate) {
  const std::string row = "r1,64.7,0.3,16,4.5\n", head = recording_with(1, 0);
  EXPECT_EQ(read(head + row + "r2,64.7,0.3,16,4.5\n").recording.runs.size(), 3u);
  EXPECT_EQ(error_text([&] { read(head + row + row); }),
            "r.csv:4: run_id: r1: this row is a copy of line 3 (allowed: each run once; a copy is "
            "no replicate)");
}

TEST(RecordingFile, RunsOfOneNameAreToldUnlessTheyAreItsReplicates) {
  const std::string head = "run_id,load_n,slip_ratio,slip_angle_deg,replicate,fx_n\n";
  const std::string rows = "a,64.7,0.3,16,1,4.5\na,64.7,0.3,16,2,4.6\n";
  EXPECT_TRUE(read(head + rows).recording.warnings.empty());
  EXPECT_EQ(
      read(head + rows + "b,64.7,0.3,16,1,4.5\nb,64.7,0.2,16,1,4.3\n").recording.warnings,
      std::vector<std::string>{"r.csv: run_id: b on lines 4 and 5 are different runs; what is "
                               "told of one may be of another"});
}

TEST(RecordingFile, AMeasuredValueThatIsNoNumberAsksForAnEmptyCell) {
  const std::string error =
      error_text([] { read("run_id,load_n,slip_ratio,slip_angle_deg,fx_n\na,64.7,0.3,16,n/a\n"); });
  EXPECT_NE(error.find("leave the cell empty where nothing was measured"), std::string::npos)
      << error;
}

TEST(RecordingFile, ARowOutOfRangeIsLeftOutAndListedAndTheRestIsKept) {
  const RecordingFile file = read(recording_with(40, 2));
  EXPECT_EQ(file.recording.runs.size(), 38u);
  EXPECT_EQ(file.recording.runs.front().run_id, "r2");
  EXPECT_EQ(file.lines.front(), 4);
  EXPECT_EQ(file.cells.size(), 38u);
  ASSERT_EQ(file.left_out.size(), 2u);
  EXPECT_EQ(file.left_out[1].run_id, "r1");
  EXPECT_EQ(file.left_out[1].cell.line, 3);
  EXPECT_EQ(file.left_out[1].cell.column, "slip_angle_deg");
  EXPECT_EQ(file.left_out[1].cell.value, 90.04);
  EXPECT_EQ(file.left_out[1].cell.allowed, "-90 to 90");
  EXPECT_EQ(file.left_out[1].why,
            "r.csv:3: slip_angle_deg: 90.04 is not valid (allowed: -90 to 90)");
}

TEST(RecordingFile, WhatNoSensorCanSayIsOutOfRange) {
  for (const char* huge : {"1e100", "-1e300"}) {
    std::string text = "run_id,load_n,slip_ratio,slip_angle_deg,fx_n\n";
    for (int run = 0; run < 40; ++run) {
      text += "r" + std::to_string(run) + ",60,0.2,0," + (run == 7 ? huge : "5") + "\n";
    }
    const RecordingFile file = read(text);
    EXPECT_EQ(file.recording.runs.size(), 39u);
    ASSERT_EQ(file.left_out.size(), 1u);
    EXPECT_EQ(file.left_out[0].run_id, "r7");
    EXPECT_EQ(file.left_out[0].cell.column, "fx_n");
  }
}

TEST(RecordingFile, MoreThanOneRowInTwentyOutOfRangeIsRefused) {
  EXPECT_EQ(error_text([] { read(recording_with(40, 3)); }),
            "r.csv:2: slip_angle_deg: 90.04 is not valid (allowed: -90 to 90); 3 of 40 rows are "
            "out of range (up to 5 % are left out)");
}

TEST(RecordingFile, WhatIsNoNumberIsNeverLeftOut) {
  EXPECT_EQ(error_text([] { read(replaced(recording_with(100, 0), "r7,64.7", "r7,heavy")); }),
            "r.csv:9: load_n: heavy is not valid (allowed: above 0 to 1000000000)");
}

TEST(RecordingFile, ASlipInPerCentIsSuspectedAsSuch) {
  EXPECT_NE(
      recording_error("0.30", "30")
          .find("r.csv:3: slip_ratio: 30 is not valid (allowed: -1 to 1); is it in per cent?"),
      std::string::npos);
  EXPECT_NE(
      recording_error("-0.25", "-25")
          .find("r.csv:2: slip_ratio: -25 is not valid (allowed: -1 to 1); is it in per cent?"),
      std::string::npos);
  EXPECT_NE(recording_error("-0.25", "-1.5").find("a braking wheel's slip is (r w - Vx)/Vx"),
            std::string::npos);
}

TEST(RecordingFile, AColumnInAnotherWritingIsToldWhereTheKnownOneIsMissing) {
  for (const char* written : {"Load_N", "load_n [N]", "load [N]"}) {
    EXPECT_EQ(recording_error("load_n", written),
              fmt::format("r.csv:1: column load_n is missing (the header has {})", written));
  }
  // a column that means something itself is not meant to be another
  EXPECT_EQ(recording_error("run_id,", "wheel_radius_m,"), "r.csv:1: column run_id is missing");
}

TEST(RecordingFile, AnIgnoredColumnIsHeldAgainstTheKnownOnesThatAreNotGiven) {
  const RecordingFile file =
      read("run_id,load_n,slip_ratio,slip_angle_deg,fx_n,Fy [N],fx_n [N],oven\na,60,0,0,1,2,3,4\n");
  EXPECT_EQ(ignored_columns(file),
            (std::vector<std::string>{"Fy [N] (did you mean fy_n?)", "fx_n [N]", "oven"}));
}

TEST(RecordingFile, AMeantCommentIsToldThatCommentsAreNotRead) {
  const std::string unread = "; comments (lines that begin with #) are not read";
  EXPECT_EQ(error_text([] { read(std::string("# bed 3, loose\n") + kRecording); }),
            "r.csv:1: column run_id is missing" + unread);
  EXPECT_EQ(recording_error("r2,", "# pause\nr2,"),
            "r.csv:3: 1 cells (the header has 12)" + unread);
  EXPECT_EQ(recording_error("r2,2020-11-17,,65.1", "# r2,2020-11-17,,off"),
            "r.csv:3: load_n: off is not valid (allowed: above 0 to 1000000000)" + unread);
  // A run may be called so.
  EXPECT_EQ(read(replaced(kRecording, "r2,", "#2,")).recording.runs[1].run_id, "#2");
}

TEST(RecordingFile, MissingColumnsAreNamed) {
  for (const char* column : {"run_id", "load_n", "slip_ratio", "slip_angle_deg"}) {
    EXPECT_EQ(recording_error(column, "other"),
              std::string("r.csv:1: column ") + column + " is missing");
  }
  EXPECT_NE(error_text([] {
              read("run_id,load_n,slip_ratio,slip_angle_deg\na,60,0,0\n");
            }).find("r.csv:1: no measured column"),
            std::string::npos);
  EXPECT_EQ(error_text([] { read("run_id,load_n,slip_ratio,slip_angle_deg,fx_n\na,60,0,0,\n"); }),
            "r.csv: no channel is measured in any run");
  EXPECT_EQ(error_text([] { read("run_id,load_n,slip_ratio,slip_angle_deg,fx_n\n"); }),
            "r.csv: no runs below the header");
  EXPECT_EQ(error_text([] { read_recording("/no/such/file.csv"); }),
            "/no/such/file.csv: no such file");
}

}  // namespace
}  // namespace regoplan
