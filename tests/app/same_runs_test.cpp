#include "app/diagnose/same_runs.h"

#include <gtest/gtest.h>

#include <sstream>

namespace regoplan {
namespace {

RecordingFile table(const std::string& text) {
  std::istringstream stream(text);
  return read_recording(stream, "r.csv");
}

const char* const kRuns =
    "run_id,load_n,slip_ratio,slip_angle_deg,fx_n,fy_n\n"
    "a,64.7,0.3,16,4.512,29.71\nb,64.9,0.5,16,6.201,\nc,65.1,0.5,8,7.3,12.25\n";

TEST(SameRuns, AreRecognisedInAnyOrderOfRowsAndColumnsAndUnderOtherNames) {
  EXPECT_TRUE(are_same_runs(table(kRuns), table(kRuns)));
  EXPECT_TRUE(are_same_runs(
      table(kRuns),
      table("fy_n,run_id,slip_ratio,load_n,slip_angle_deg,fx_n\n"
            ",1,0.50,64.9,16,6.201\n12.25,2,0.5,65.1,8,7.30\n29.71,3,.3,64.7,16,4.512\n")));
}

TEST(SameRuns, AreNoneWhereOneNumberIsAnotherOrARunIsMissing) {
  std::string other = kRuns;
  other.replace(other.find("12.25"), 5, "12.26");
  EXPECT_FALSE(are_same_runs(table(kRuns), table(other)));
  const std::string fewer = std::string(kRuns).substr(0, std::string(kRuns).rfind("c,"));
  EXPECT_FALSE(are_same_runs(table(kRuns), table(fewer)));
}

}  // namespace
}  // namespace regoplan
