#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

#include "app/plan_report.h"
#include "tests/app/plan_report_fixture.h"

namespace regoplan {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string output_of(const std::string& command) {
  std::string text;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  if (!pipe) return text;
  std::array<char, 65536> part{};
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe.get()))
    text.append(part.data(), count);
  return text;
}

/// What a page shows: its elements without its scripts.
std::string without_scripts(std::string page) {
  const std::string end = "</script>";
  while (true) {
    const std::size_t open = page.find("<script");
    if (open == std::string::npos) return page;
    page.erase(open, page.find(end, open) + end.size() - open);
  }
}

/// Opens pages in Debian's Chromium, where it is installed, and reads what they drew.
class PlanReportInTheBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (output_of("command -v chromium").empty())
      GTEST_SKIP() << "chromium is not installed; pages are not opened";
    folder_ =
        std::filesystem::temp_directory_path() / ("regoplan-report-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }

  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  std::string drawn(const PlanResult& result) const {
    const std::string file = folder_ / "report.html";
    std::ofstream(file) << plan_report(problem_, result);
    return without_scripts(
        output_of("chromium --headless --no-sandbox --disable-gpu --no-first-run "
                  "--disable-background-networking --disable-component-update --disable-sync "
                  "--user-data-dir=" +
                  (folder_ / "profile").string() +
                  " --window-size=1400,2400 --virtual-time-budget=4000 --dump-dom file://" + file +
                  " 2>/dev/null"));
  }

  static void expect_drawn_without_error(const std::string& page) {
    EXPECT_NE(page.find("data-drawn=\"yes\""), std::string::npos);
    const std::size_t failure = page.find("id=\"failure\"");
    EXPECT_NE(page.find("id=\"failure\" role=\"alert\" hidden"), std::string::npos)
        << page.substr(failure, page.find("</p>", failure) - failure);
    EXPECT_EQ(page.find("NaN"), std::string::npos);
    EXPECT_EQ(page.find(">undefined"), std::string::npos);
  }

  PlanningProblem problem_ = report_test_problem(report_test_map(100));
  PlanResult result_ = report_test_result(problem_);
  std::filesystem::path folder_;
};

TEST_F(PlanReportInTheBrowser, DrawsEveryCandidateWithoutAnError) {
  const std::string page = drawn(result_);
  expect_drawn_without_error(page);
  for (const Candidate& candidate : result_.candidates)
    EXPECT_NE(page.find("Follow candidate " + std::to_string(candidate.rank) + " in the charts"),
              std::string::npos);
  EXPECT_NE(page.find("the replay is rejected for cornering after 21.4 s"), std::string::npos);
}

TEST_F(PlanReportInTheBrowser, DrawsWhatIsNotKnownAsNothing) {
  Candidate& best = result_.candidates.front();
  for (std::size_t i = 0; i < best.points.size(); i += 2)
    best.points[i].margin = best.points[i].cornering_margin = best.points[i].supply_max_n = kNaN;
  best.points[2].x_m = best.points[2].time_s = best.points[2].yaw_rad = kNaN;
  best.margin_p05 = best.energy_j = best.verified.margin_min = best.limiting.x_m = kNaN;
  for (TrajectoryPoint& point : result_.candidates[1].points) point = {.x_m = kNaN, .margin = kNaN};
  result_.rejected_states.front().x_m = result_.rejected_states.front().value = kNaN;
  result_.what_ifs.front().x_m = kNaN;
  expect_drawn_without_error(drawn(result_));
}

TEST_F(PlanReportInTheBrowser, DrawsAnAnswerWithoutAnyPath) {
  PlanResult nothing;
  nothing.status = PlanStatus::kInfeasible;
  expect_drawn_without_error(drawn(nothing));
}

}  // namespace
}  // namespace regoplan
