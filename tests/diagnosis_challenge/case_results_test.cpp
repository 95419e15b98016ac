#include "benchmarks/diagnosis/case_results.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "terramech/basics/input_error.h"

namespace regoplan::challenge {
namespace {

class ResultLogTest : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "results.jsonl"; }
  CaseResult of(std::uint64_t index) const {
    return {.truth = {.stratum = Stratum::kNulls, .index = index},
            .outcomes = {{.method = "diagnosis", .verdict = "consistent"}}};
  }
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("regoplan-results-" + std::to_string(getpid()));
};

TEST_F(ResultLogTest, GoesOnWhereItWas) {
  {
    ResultLog log(file(), "seed 1");
    log.append(of(0));
    log.append(of(7));
  }
  const ResultLog again(file(), "seed 1");
  EXPECT_EQ(again.results().size(), 2);
  EXPECT_TRUE(again.contains({Stratum::kNulls, 7}));
  EXPECT_FALSE(again.contains({Stratum::kNulls, 1}));
  EXPECT_FALSE(again.contains({Stratum::kUnlisted, 7}));
}

TEST_F(ResultLogTest, DropsALineThatWasCutShort) {
  { ResultLog(file(), "seed 1").append(of(0)); }
  const auto whole = std::filesystem::file_size(file());
  { ResultLog(file(), "seed 1").append(of(1)); }
  std::filesystem::resize_file(file(), std::filesystem::file_size(file()) - 5);
  ResultLog log(file(), "seed 1");
  EXPECT_EQ(std::filesystem::file_size(file()), whole);
  EXPECT_FALSE(log.contains({Stratum::kNulls, 1}));
  log.append(of(1));
  EXPECT_EQ(ResultLog(file(), "seed 1").results().size(), 2);
}

TEST_F(ResultLogTest, NeverMixesSeedsOrBuilds) {
  { ResultLog(file(), "seed 1").append(of(0)); }
  EXPECT_THROW(ResultLog(file(), "seed 2"), InputError);
}

}  // namespace
}  // namespace regoplan::challenge
