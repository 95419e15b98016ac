
#include <algorithm>
#include <regex>
#include <set>

#include "app/plan/plan_report.h"
#include "tests/app/browser_page.h"
#include "tests/app/plan_report_fixture.h"

namespace regoplan {
namespace {

class PlanReportInTheBrowser : public InTheBrowser {
 protected:
  std::string drawn(const PlanResult& result) const {
    return InTheBrowser::drawn(plan_report(problem_, result));
  }

  PlanningProblem problem_ = report_test_problem(report_test_map(100));
  PlanResult result_ = report_test_result(problem_);
};

/// Titles of the sections that are seen.
std::vector<std::string> sections_of(const std::string& page) {
  static const std::regex section(R"(<section([^>]*)>\s*<h2[^>]*>([^<]*)</h2>)");
  std::vector<std::string> titles;
  for (std::sregex_iterator at(page.begin(), page.end(), section), end; at != end; ++at) {
    if (at->str(1).find("hidden") == std::string::npos) titles.push_back(at->str(2));
  }
  return titles;
}

TEST_F(PlanReportInTheBrowser, DrawsEveryCandidateAndSectionWithoutAnError) {
  const std::string page = drawn(result_);
  expect_drawn_without_error(page);
  for (const Candidate& candidate : result_.candidates)
    EXPECT_NE(page.find("Follow candidate " + std::to_string(candidate.rank) + " in the charts"),
              std::string::npos);
  EXPECT_NE(page.find("the replay is rejected for cornering after 21.4 s"), std::string::npos);
  const std::vector<std::string> sections = sections_of(page);
  for (const char* title : {"Along the path", "What carries the answer"}) {
    EXPECT_NE(std::ranges::find(sections, title), sections.end()) << title;
  }
}

TEST_F(PlanReportInTheBrowser, LabelsOfPathsThatLieTogetherStandOneBelowTheOther) {
  for (Candidate& candidate : result_.candidates) {
    for (TrajectoryPoint& point : candidate.points) point.x_m = point.y_m = 50;
  }
  const std::string page = drawn(result_);
  static const std::regex label(
      R"-(<text class="label" text-anchor="start" x="([-0-9.]+)" y="([-0-9.]+)">[123]<)-");
  std::set<std::pair<std::string, std::string>> places;
  int labels = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), label), end; at != end; ++at, ++labels)
    places.insert({at->str(1), at->str(2)});
  EXPECT_EQ(labels, 3);
  EXPECT_EQ(places.size(), 3u);
}

TEST_F(PlanReportInTheBrowser, DrawsWhatIsNotKnownAsNothing) {
  Candidate& best = result_.candidates.front();
  for (std::size_t i = 0; i < best.points.size(); i += 2)
    best.points[i].margin = best.points[i].cornering_margin = best.points[i].supply_max_n = kNaN;
  best.points[2].x_m = best.points[2].time_s = best.points[2].yaw_rad = kNaN;
  best.spread.reset();
  best.energy_j = best.verified.margin_min = best.limiting.x_m = kNaN;
  for (TrajectoryPoint& point : result_.candidates[1].points) point = {.x_m = kNaN, .margin = kNaN};
  result_.rejected_states.front().x_m = kNaN;
  result_.rejected_states.front().exceeded = {.found = kNaN, .limit = 0.05};
  result_.what_ifs.front().x_m = kNaN;
  expect_drawn_without_error(drawn(result_));
}

TEST_F(PlanReportInTheBrowser, WritesNoLoadOfASixWheelerOnTheBarOfItsSupply) {
  problem_.vehicle = preset_vehicle("curiosity");
  const std::string page = drawn(result_);
  static const std::regex bar(R"-(<rect class="supply"[^>]* y="([-0-9.]+)" height="([0-9.]+)")-");
  static const std::regex load(R"-(<text class="load"[^>]* y="([-0-9.]+)")-");
  std::smatch supply;
  ASSERT_TRUE(std::regex_search(page, supply, bar));
  const double top = std::stod(supply.str(1)), bottom = top + std::stod(supply.str(2));
  constexpr double kLetters_px = 8;  // above the line that they stand on
  int loads = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), load), end; at != end; ++at, ++loads) {
    const double line = std::stod(at->str(1));
    EXPECT_TRUE(line < top || line - kLetters_px > bottom) << line;
  }
  EXPECT_EQ(loads, 6);
}

TEST_F(PlanReportInTheBrowser, DrawsAnAnswerWithoutAnyPath) {
  PlanResult nothing;
  nothing.status = PlanStatus::kInfeasible;
  expect_drawn_without_error(drawn(nothing));
}

TEST_F(PlanReportInTheBrowser, HasNoSectionThatSaysNothing) {
  PlanResult nothing;
  nothing.status = PlanStatus::kUndecided;
  nothing.rejected[0] = 3;
  const std::vector<std::string> undecided{"Candidates", "Map", "What was rejected, and why",
                                           "How this was decided", "What this does not say"};
  EXPECT_EQ(sections_of(drawn(nothing)), undecided);
  nothing.status = PlanStatus::kInfeasible;
  nothing.rejected[0] = 0;
  nothing.certificate = "the start is walled in";
  EXPECT_EQ(sections_of(drawn(nothing)).size(), undecided.size() - 1);
}

}  // namespace
}  // namespace regoplan
