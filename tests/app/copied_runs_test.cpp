#include "app/diagnose/copied_runs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace regoplan {
namespace {

constexpr const char* kHeader = "run_id,day,load_n,slip_ratio,slip_angle_deg,fx_n,fy_n,sinkage_m\n";

RecordingFile read_rows(const std::vector<std::string>& rows) {
  std::string text = kHeader;
  for (const std::string& row : rows) text += row + "\n";
  std::istringstream stream(text);
  return read_recording(stream, "r.csv");
}

std::vector<std::string> run_ids(const RecordingFile& file) {
  std::vector<std::string> ids;
  for (const WheelRun& run : file.recording.runs) ids.push_back(run.run_id);
  return ids;
}

TEST(CopiedRuns, AreLeftOutUnderAnotherNameAndOnAnotherDay) {
  const RecordingFile file =
      read_rows({"a,1,64.7,0.3,16,4.512,29.71,.0123", "b,1,64.7,0.3,16,4.498,29.8,",
                 "c,2,64.7,0.3,16,4.512,29.71,.0123", "d,2,64.7,0.3,16,4.498,29.8,",
                 "e,3,64.70,0.3,16.0,4.5120,29.71,.01230"});
  EXPECT_EQ(run_ids(file), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(file.lines, (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(file.cells.size(), 2u);
  EXPECT_EQ(
      file.recording.warnings,
      std::vector<std::string>{
          "r.csv: load, slip, slip angle and every measured value of 3 of 5 rows are those of an "
          "earlier row, to the last digit (run_id c in line 4 those of a in line 2); they are "
          "left out: a copy is no replicate"});
}

TEST(CopiedRuns, StayWhereAnyChannelOrConditionIsAnother) {
  const std::string run = "a,1,64.7,0.3,16,4.512,29.71,.0123";
  for (const char* other :
       {"b,1,64.8,0.3,16,4.512,29.71,.0123", "b,1,64.7,0.4,16,4.512,29.71,.0123",
        "b,1,64.7,0.3,15,4.512,29.71,.0123", "b,1,64.7,0.3,16,4.511,29.71,.0123",
        "b,1,64.7,0.3,16,4.512,29.71,.0124", "b,1,64.7,0.3,16,4.512,29.71,"}) {
    const RecordingFile file = read_rows({run, other});
    EXPECT_EQ(file.recording.runs.size(), 2u) << other;
    EXPECT_TRUE(file.recording.warnings.empty()) << other;
  }
}

TEST(CopiedRuns, AreNotSuspectedWhereFewDigitsAreTold) {
  EXPECT_EQ(
      run_ids(read_rows({"a,1,64.7,0.3,16,4.512,29,.012", "b,1,64.7,0.3,16,4.512,29,.012"})).size(),
      2u);
  // Zeros that a writer adds are no digits.
  EXPECT_EQ(
      run_ids(read_rows({"a,1,64.7,0.3,16,4.512,29.00,0.0", "b,1,64.7,0.3,16,4.512,29.00,0.0"}))
          .size(),
      2u);
}

TEST(CopiedRuns, AreNotSuspectedWhereChannelsOftenAgreeByThemselves) {
  // A quiet rig that reads each force on two steps gives a quarter of its pairs alike.
  std::vector<std::string> rows;
  for (int i = 0; i < 12; ++i) {
    rows.push_back(fmt::format("r{},1,64.7,0.3,16,{},{},", i, i % 2 ? "4.51" : "4.52",
                               i / 2 % 2 ? "29.7" : "29.8"));
  }
  EXPECT_EQ(read_rows(rows).recording.runs.size(), 12u);
}

}  // namespace
}  // namespace regoplan
