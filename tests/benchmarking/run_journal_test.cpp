#include "benchmarking/run_journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "terramech/basics/input_error.h"
#include "tests/benchmarking/made_up_runs.h"

namespace regoplan {
namespace {

class Journal : public testing::Test {
 protected:
  Journal()
      : folder_(std::filesystem::temp_directory_path() /
                ("regoplan-journal-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
  }
  ~Journal() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(Journal, GivesBackWhatWasAppended) {
  {
    RunJournal journal(folder_, made_up_origin());
    journal.append(verified_run("a", "RRT", 1, 0.5, 30));
  }
  const JournalContents contents = read_journal(folder_);
  ASSERT_EQ(contents.runs.size(), 1U);
  const RunRecord& run = contents.runs.front();
  EXPECT_EQ(run.key, (RunKey{.experiment = "a", .planner = "RRT", .seed = 1}));
  EXPECT_EQ(run.outcome.properties, verified_run("a", "RRT", 1, 0.5, 30).outcome.properties);
  EXPECT_EQ(run.outcome.progress.size(), 3U);
  EXPECT_EQ(run.outcome.path.size(), 2U);
}

TEST_F(Journal, HoldsAfterReopeningWhatItHeldBefore) {
  { RunJournal(folder_, made_up_origin()).append(verified_run("a", "RRT", 1, 0.5, 30)); }
  const RunJournal journal(folder_, made_up_origin());
  EXPECT_TRUE(journal.holds({.experiment = "a", .planner = "RRT", .seed = 1}));
  EXPECT_FALSE(journal.holds({.experiment = "a", .planner = "RRT", .seed = 2}));
}

TEST_F(Journal, MissesTheRunsThatOthersOfTheirExperimentHave) {
  JournalContents contents{.origins = {made_up_origin()}, .runs = {}};  // of RRT and SST
  for (const char* planner : {"RRT", "SST"}) {
    for (const std::uint64_t seed : {1, 4}) {
      contents.runs.push_back(verified_run("a", planner, seed, 0.5, 30));
    }
  }
  EXPECT_TRUE(missing_runs(contents).empty());
  contents.runs.pop_back();
  const RunKey last{.experiment = "a", .planner = "SST", .seed = 4};
  EXPECT_EQ(missing_runs(contents), std::vector{last});
}

TEST_F(Journal, TakesALineThatAKillCutShortForNeverBegun) {
  {
    RunJournal journal(folder_, made_up_origin());
    journal.append(verified_run("a", "RRT", 1, 0.5, 30));
    journal.append(verified_run("a", "RRT", 2, 0.5, 30));
  }
  const std::filesystem::path file = folder_ / "runs.jsonl";
  for (int cut = 1; cut < 100; cut += 7) {
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 7);
    RunJournal journal(folder_, made_up_origin());
    EXPECT_TRUE(journal.holds({.experiment = "a", .planner = "RRT", .seed = 1}));
    EXPECT_FALSE(journal.holds({.experiment = "a", .planner = "RRT", .seed = 2}));
    journal.append(verified_run("a", "RRT", 2, 0.5, 30));
  }
  EXPECT_EQ(read_journal(folder_).runs.size(), 2U);
}

TEST_F(Journal, IsOfOneProcessAtATime) {
  const RunJournal journal(folder_, made_up_origin());
  EXPECT_THROW(RunJournal(folder_, made_up_origin()), InputError);
}

TEST_F(Journal, RefusesRunsThatCannotBeCompared) {
  { const RunJournal journal(folder_, made_up_origin()); }
  JournalOrigin longer = made_up_origin();
  longer.bounds.time_s = 3;
  EXPECT_THROW(RunJournal(folder_, longer), InputError);
  JournalOrigin otherwise = made_up_origin();
  otherwise.planners.front().parameters["goal_bias"] = "0.5";
  EXPECT_THROW(RunJournal(folder_, otherwise), InputError);
  JournalOrigin moved = made_up_origin();
  moved.scenarios["a"] = "33";
  EXPECT_THROW(RunJournal(folder_, moved), InputError);
}

TEST_F(Journal, TakesMorePlannersAndScenarios) {
  { const RunJournal journal(folder_, made_up_origin()); }
  JournalOrigin more = made_up_origin();
  more.scenarios["c"] = "33";
  more.planners.push_back({.label = "EST", .planner = "EST", .parameters = {}});
  EXPECT_NO_THROW(RunJournal(folder_, more));
}

TEST_F(Journal, KnowsWhichShardsItIsNotOf) {
  JournalOrigin first = made_up_origin(), third = made_up_origin();
  first.shard = {.index = 1, .count = 4};
  third.shard = {.index = 3, .count = 4};
  { const RunJournal journal(folder_ / "1", first); }
  { const RunJournal journal(folder_ / "3", third); }
  JournalContents whole = merged({read_journal(folder_ / "1"), read_journal(folder_ / "3")});
  std::vector<int> missing;
  for (const Shard& shard : missing_shards(whole)) missing.push_back(shard.index);
  EXPECT_EQ(missing, (std::vector<int>{2, 4}));
  whole.origins.push_back(made_up_origin());  // of a version that did not tell it
  EXPECT_TRUE(missing_shards(whole).empty());
}

TEST_F(Journal, NamesFileAndLineOfWhatIsNoJournal) {
  std::filesystem::create_directories(folder_);
  std::ofstream(folder_ / "runs.jsonl") << "{\"origin\": 3}\n";
  try {
    read_journal(folder_);
    FAIL();
  } catch (const InputError& bad) {
    EXPECT_NE(std::string(bad.what()).find("runs.jsonl:1: "), std::string::npos) << bad.what();
  }
}

TEST(MergedJournals, HoldEveryRunOnceWhateverTheOrder) {
  JournalContents one{
      .origins = {made_up_origin()},
      .runs = {verified_run("a", "RRT", 1, 1, 30), verified_run("b", "SST", 2, 1, 9)}};
  JournalContents two{
      .origins = {made_up_origin()},
      .runs = {verified_run("a", "SST", 1, 1, 30), verified_run("b", "SST", 2, 5, 9)}};
  const JournalContents forth = merged({one, two}), back = merged({two, one});
  ASSERT_EQ(forth.runs.size(), 3U);
  for (std::size_t i = 0; i < forth.runs.size(); ++i) {
    EXPECT_EQ(forth.runs[i].key, back.runs[i].key);
  }
}

}  // namespace
}  // namespace regoplan
