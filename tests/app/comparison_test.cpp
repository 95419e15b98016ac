// Two results side by side.
#include "app/compare/comparison.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>

#include "app/benchmark/benchmark_files.h"
#include "app/compare/comparison_report.h"
#include "tests/app/browser_page.h"
#include "tests/app/flat_map.h"
#include "tests/app/json_schema.h"
#include "tests/app/program_run.h"
#include "tests/benchmarking/made_up_runs.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

ComparedEntry entry(const std::string& name, double margin_p05, double duration_s) {
  ComparedEntry entry{.name = name, .verdict = "feasible", .feasible = true};
  for (const ComparedMetric& metric : metrics_of(ResultKind::kPlan)) {
    entry.values.push_back(metric.key == "margin_p05"   ? std::optional(margin_p05)
                           : metric.key == "duration_s" ? std::optional(duration_s)
                                                        : std::nullopt);
  }
  return entry;
}

ComparedResult plan(std::vector<ComparedEntry> entries) {
  return {.kind = ResultKind::kPlan,
          .file = "plan.json",
          .status = "feasible",
          .version = "1",
          .asked = {{"limits", {{"margin_min", 0.05}, {"slip_max", 0.6}}}},
          .inputs = {{"scenario", "11"}, {"map.soils", "22"}},
          .entries = std::move(entries)};
}

double changed(const Comparison& comparison, const std::string& name, const std::string& metric) {
  const auto pair = std::ranges::find(comparison.pairs, name, &ComparedPair::name);
  const std::vector<ComparedMetric>& metrics = metrics_of(ResultKind::kPlan);
  const auto found = std::ranges::find(metrics, metric, &ComparedMetric::key);
  return pair->change.at(static_cast<std::size_t>(found - metrics.begin())).value();
}

TEST(Comparison, OfAResultWithItselfSaysThatNothingDiffers) {
  const ComparedResult a = plan({entry("candidate 1", 0.2, 60)});
  const Comparison same = compared(a, a);
  EXPECT_TRUE(same.settings.empty());
  EXPECT_TRUE(same.inputs.empty());
  EXPECT_EQ(changed(same, "candidate 1", "margin_p05"), 0);
  EXPECT_EQ(comparison_headline(a, a, same),
            "Of 1 in both, B is the same for 1 (margin, 5 % of soils). "
            "The same was asked of both.");
}

/// With its sampling error.
ComparedEntry drawn(double margin_p05, double low, double high) {
  ComparedEntry of_draws = entry("candidate 1", margin_p05, 60);
  of_draws.intervals.resize(of_draws.values.size());
  of_draws.intervals.front() = {low, high};
  return of_draws;
}

TEST(Comparison, ASamplingErrorIsNeitherBetterNorWorse) {
  const ComparedResult few = plan({drawn(0.305, 0.297, 0.313)}),
                       many = plan({drawn(0.310, 0.308, 0.312)});
  for (const auto& [a, b] : {std::pair(few, many), std::pair(many, few)}) {
    const Comparison comparison = compared(a, b);
    EXPECT_TRUE(comparison_headline(a, b, comparison)
                    .starts_with("Of 1 in both, B is tied within the draws for 1 (margin"));
    const auto tied = comparison_json(a, b, comparison).at("entries").at(0).at("tied");
    EXPECT_EQ(tied.get<std::vector<std::string>>(), std::vector<std::string>{"margin_p05"});
  }
}

TEST(Comparison, ADifferenceIsWithinTheSamplingErrorWhicheverOfTheTwoHasFewDraws) {
  const ComparedResult few = plan({drawn(0.310, 0.29, 0.33)});
  for (const double margin_p05 : {0.300, 0.320}) {
    const ComparedResult many = plan({drawn(margin_p05, margin_p05 - 0.001, margin_p05 + 0.001)});
    EXPECT_TRUE(comparison_headline(few, many, compared(few, many))
                    .starts_with("Of 1 in both, B is tied within the draws"))
        << margin_p05;
  }
}

TEST(Comparison, ADifferenceBeyondTheSamplingErrorIsTold) {
  const ComparedResult a = plan({drawn(0.305, 0.301, 0.309)}),
                       b = plan({drawn(0.310, 0.306, 0.314)});
  EXPECT_TRUE(comparison_headline(a, b, compared(a, b)).starts_with("Of 1 in both, B is better"));
  EXPECT_TRUE(comparison_headline(b, a, compared(b, a)).starts_with("Of 1 in both, B is worse"));
  // Broken limits are a tier of their own, as in a ranking.
  const ComparedResult broken = plan({drawn(-1, -1, 0.4)});
  EXPECT_TRUE(
      comparison_headline(broken, b, compared(broken, b)).starts_with("Of 1 in both, B is better"));
}

/// Of so few draws that the 5 % quantile has no lower bound.
ComparedEntry of_few_draws(double margin_p05, double margin_p50) {
  ComparedEntry few = drawn(margin_p05, -1, margin_p05 + 0.04);
  const std::vector<ComparedMetric>& metrics = metrics_of(ResultKind::kPlan);
  const auto median = std::ranges::find(metrics, "margin_p50", &ComparedMetric::key);
  const auto at = static_cast<std::size_t>(median - metrics.begin());
  few.values.at(at) = margin_p50;
  few.intervals.at(at) = {margin_p50 - 0.01, margin_p50 + 0.01};
  return few;
}

TEST(Comparison, MediansDecideWhereDrawsAreTooFewToBoundTheLowestMargins) {
  const ComparedResult low = plan({of_few_draws(0.30, 0.35)}),
                       high = plan({of_few_draws(0.33, 0.40)}),
                       like_low = plan({of_few_draws(0.28, 0.36)});
  const auto said = [](const ComparedResult& a, const ComparedResult& b) {
    return comparison_headline(a, b, compared(a, b));
  };
  EXPECT_TRUE(
      said(low, high).starts_with("Of 1 in both, B is better for 1 (margin, 5 % of soils; "
                                  "for 1 by the median"))
      << said(low, high);
  EXPECT_TRUE(said(high, low).starts_with("Of 1 in both, B is worse for 1"));
  EXPECT_TRUE(said(low, like_low).starts_with("Of 1 in both, B is tied within the draws for 1"));
}

TEST(Comparison, MediansDecideNothingThatTheLowestMarginsDo) {
  ComparedEntry bounded = of_few_draws(0.30, 0.45), other = of_few_draws(0.35, 0.40);
  bounded.intervals.front() = {0.29, 0.31};
  other.intervals.front() = {0.34, 0.36};
  const ComparedResult a = plan({bounded}), b = plan({other});
  const std::string said = comparison_headline(a, b, compared(a, b));
  EXPECT_TRUE(said.starts_with("Of 1 in both, B is better for 1 (margin, 5 % of soils).")) << said;
}

/// What is said of B, as it must be said where A and B change places.
std::string mirrored(std::string headline) {
  constexpr std::string_view kBetter = "B is better", kWorse = "B is worse";
  for (const auto& [said, instead] : {std::pair{kBetter, kWorse}, std::pair{kWorse, kBetter}}) {
    const auto at = headline.find(said);
    if (at != std::string::npos) return headline.replace(at, said.size(), instead);
  }
  return headline;
}

TEST(Comparison, OfBWithASaysTheMirrorImageOfWhatItSaysOfAWithB) {
  // Limits hold and break, intervals overlap or not, are of one point, reach far, or are not told.
  std::vector<ComparedEntry> entries{entry("candidate 1", 0.305, 60)};
  for (const auto& [margin_p05, low, high] :
       std::to_array<std::array<double, 3>>({{0.305, 0.297, 0.313},
                                             {0.305, 0.305, 0.305},
                                             {0.310, 0.308, 0.312},
                                             {0.25, 0.1, 0.5},
                                             {-1, -1, 0.4},
                                             {-1, -1, -1},
                                             {0, 0, 0}})) {
    entries.push_back(drawn(margin_p05, low, high));
  }
  for (const ComparedEntry& one : entries) {
    for (const ComparedEntry& other : entries) {
      const ComparedResult a = plan({one}), b = plan({other});
      const Comparison there = compared(a, b), back = compared(b, a);
      EXPECT_EQ(comparison_headline(b, a, back), mirrored(comparison_headline(a, b, there)));
      EXPECT_EQ(back.pairs[0].tied, there.pairs[0].tied);
      EXPECT_EQ(changed(back, "candidate 1", "margin_p05"),
                -changed(there, "candidate 1", "margin_p05"));
    }
  }
}

/// What a benchmark comes to whose runs take `time_s`, a hundredth more from run to run.
ComparedResult benchmarked(const ScratchFolder& folder, int runs, double time_s) {
  JournalContents journal{.origins = {made_up_origin()}, .runs = {}};
  for (int run = 0; run < runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run + 1);
    journal.runs.push_back(verified_run("a", "RRT", seed, time_s + 0.01 * run, 30));
  }
  folder.write("benchmark.json", benchmark_json({.journal = journal}));
  return read_compared_result(folder.path("benchmark.json"));
}

TEST(Comparison, AMedianOfAHandfulOfRunsIsNeitherBetterNorWorse) {
  const ScratchFolder folder;
  for (const auto& [runs, told_apart] :
       {std::pair(1, false), std::pair(5, false), std::pair(6, true)}) {
    const ComparedResult a = benchmarked(folder, runs, 1), b = benchmarked(folder, runs, 3);
    const auto tied = comparison_json(a, b, compared(a, b)).at("entries").at(0).at("tied");
    EXPECT_EQ(std::ranges::find(tied, "time_median_s") == tied.end(), told_apart) << runs;
  }
}

TEST(Comparison, ASettingThatIsThereAndEmptyIsTheSameAsNone) {
  ComparedResult a = plan({}), b = plan({});
  a.asked["goal"]["heading_deg"] = nullptr;
  EXPECT_TRUE(compared(a, b).settings.empty());
  EXPECT_TRUE(compared(b, a).settings.empty());
}

TEST(Comparison, HoldsEntriesOfOneNameAgainstEachOther) {
  const ComparedResult a = plan({entry("candidate 1", 0.2, 60), entry("candidate 2", 0.1, 50)});
  const ComparedResult b = plan({entry("candidate 3", 0.3, 40), entry("candidate 1", 0.15, 48)});
  const Comparison comparison = compared(a, b);
  ASSERT_EQ(comparison.pairs.size(), 3u);
  EXPECT_NEAR(changed(comparison, "candidate 1", "margin_p05"), -0.05, 1e-12);
  EXPECT_NEAR(changed(comparison, "candidate 1", "duration_s"), -12, 1e-12);
  EXPECT_EQ(comparison.pairs[1].name, "candidate 2");
  EXPECT_EQ(comparison.pairs[1].b, nullptr);
  EXPECT_EQ(comparison.pairs[2].name, "candidate 3");
  EXPECT_EQ(comparison.pairs[2].a, nullptr);
  EXPECT_NE(comparison_headline(a, b, comparison).find("Of 1 in both, B is worse for 1 (margin"),
            std::string::npos);
}

using ComparisonPage = InTheBrowser;

TEST_F(ComparisonPage, NamesOfFilesStandAsTheyAre) {
  const ComparedResult a = plan({entry("path.csv", 0.2, 40)}), b = plan({});
  const std::string page = drawn(comparison_report(a, b, compared(a, b)));
  expect_drawn_without_error(page);
  EXPECT_NE(page.find(">path.csv<"), std::string::npos);
  EXPECT_EQ(page.find("Path.csv"), std::string::npos);
}

TEST(Comparison, ToldIsEveryNumberThatWasSetOtherwise) {
  const ComparedResult a = plan({});
  ComparedResult b = plan({});
  b.asked["limits"]["margin_min"] = 0.1;
  b.asked["limits"].erase("slip_max");
  b.asked["gravity_mps2"] = 3.71;
  b.inputs["map.soils"] = "33";
  b.version = "2";
  const Comparison comparison = compared(a, b);
  ASSERT_EQ(comparison.settings.size(), 4u);
  EXPECT_EQ(comparison.settings[0].key, "limits.margin_min");
  EXPECT_EQ(comparison.settings[0].b, 0.1);
  EXPECT_EQ(comparison.settings[1].key, "limits.slip_max");
  EXPECT_TRUE(comparison.settings[1].b.is_null());
  EXPECT_EQ(comparison.settings[2].key, "gravity_mps2");
  EXPECT_TRUE(comparison.settings[2].a.is_null());
  EXPECT_EQ(comparison.settings[3].key, "version");
  EXPECT_EQ(comparison.inputs, std::vector<std::string>{"map.soils"});
}

TEST(Comparison, AFileWithoutADigestCountsAsAnother) {
  ComparedResult a = plan({});
  a.inputs["map.elevation"] = nullptr;
  EXPECT_EQ(compared(a, a).inputs, std::vector<std::string>{"map.elevation"});
}

/// `compare` as a person meets it: the same scenario planned from two seeds, once for all tests.
class CompareProgram : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    planned_ = std::make_unique<ScratchFolder>();
    write_flat_scenario(*planned_);
    for (const char* name : {"before", "after"}) {
      const std::string scenario = planned_->write(
          std::string(name) + ".yaml",
          replaced(planned_->read("scenario.yaml"), "planner: {",
                   name == std::string("after") ? "planner: {seed: 7, " : "planner: {"));
      const ProgramRun run =
          run_program(*planned_, fmt::format("plan '{}' --candidates 1 --quiet --out '{}'",
                                             scenario, planned_->path(name)));
      ASSERT_EQ(run.status, 0) << run.errors;
    }
  }
  static void TearDownTestSuite() { planned_.reset(); }
  CompareProgram() { folder_.copy_from(*planned_); }

  ProgramRun compare(const std::string& a, const std::string& b,
                     const std::string& options = "") const {
    return run_program(
        folder_, fmt::format("compare '{}' '{}' {}", folder_.path(a), folder_.path(b), options));
  }

  static inline std::unique_ptr<ScratchFolder> planned_;
  ScratchFolder folder_;
};

TEST_F(CompareProgram, TellsWhatWasAskedOtherwiseAndWhatCameOut) {
  const ProgramRun run = compare("before", "after");
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.output.find("asked: planner.seed 1 -> 7"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("input: scenario"), std::string::npos) << run.output;
}

TEST_F(CompareProgram, WritesAPageAndWhatItsSchemaSays) {
  const ProgramRun run =
      compare("before/plan.json", "after", "--out '" + folder_.path("both") + "'");
  ASSERT_EQ(run.status, 0) << run.errors;
  const nlohmann::json json = nlohmann::json::parse(folder_.read("both/comparison.json"));
  EXPECT_EQ(schema("comparison").errors(json), std::vector<std::string>());
  EXPECT_EQ(json.at("kind"), "plan");
  EXPECT_EQ(json.at("entries").at(0).at("name"), "candidate 1");
  EXPECT_NE(folder_.read("both/report.html").find("Paths over each other"), std::string::npos);
}

TEST_F(CompareProgram, NeverReplacesThePageOfAResult) {
  const std::string page = folder_.read("after/report.html");
  for (const std::string b : {"after", "after/plan.json"}) {
    expect_refusal(compare("before", b, "--out '" + folder_.path("after") + "'"),
                   {"--out", "holds one of the results"});
  }
  EXPECT_EQ(folder_.read("after/report.html"), page);
}

TEST_F(CompareProgram, RefusesWhatIsNoResultAndResultsOfTwoKinds) {
  expect_refusal(compare("before", "nowhere"), {"nowhere", "plan.json, evaluation.json"});
  folder_.write("plan.json", "{\"version\": \"1\"}");
  expect_refusal(compare("before", "plan.json"), {"plan.json", "is not as plan writes it"});
  for (const char* cut_short : {"plan.json", "renamed.json"}) {
    folder_.write(cut_short, "{\"status\":");
    expect_refusal(compare("before", cut_short), {cut_short, "not valid JSON from byte 11 on"});
  }
  folder_.write("path.csv", "x_m,y_m\n8,20\n20,20.5\n");
  ASSERT_EQ(run_program(folder_, fmt::format("evaluate '{}' '{}' --draws 10 --quiet --out '{}'",
                                             folder_.path("before.yaml"), folder_.path("path.csv"),
                                             folder_.path("judged")))
                .status,
            0);
  expect_refusal(compare("before", "judged"), {"is of plan", "of evaluation"});
  EXPECT_EQ(compare("judged", "judged").status, 0);
}

}  // namespace
}  // namespace regoplan
