#include "app/plan/plan_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/app/plan_report_fixture.h"

namespace regoplan {
namespace {

using Json = nlohmann::json;

/// The page without the d3 library, whose text is not ours.
std::string own_text(std::string page) {
  const std::size_t begin = page.find("// https://d3js.org"), end = page.find("</script>", begin);
  EXPECT_NE(begin, std::string::npos) << "d3 is not in the page";
  return page.erase(begin, end - begin);
}

Json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = page.find(open) + open.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

std::string headline_of(const std::string& page) {
  const std::string open = "<h1 id=\"headline\">";
  const std::size_t begin = page.find(open) + open.size();
  return page.substr(begin, page.find("</h1>", begin) - begin);
}

class PlanReport : public testing::Test {
 protected:
  PlanningProblem problem_ = report_test_problem(report_test_map());
  PlanResult result_ = report_test_result(problem_);
};

TEST_F(PlanReport, IsOneFileThatLoadsNothing) {
  const std::string page = own_text(plan_report(problem_, result_));
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0u);
  for (const char* loader : {"<link", "src=", "@import", "url(http", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(page.find(loader), std::string::npos) << loader;
  EXPECT_NE(page.find("Content-Security-Policy\" content=\"default-src 'none'"), std::string::npos);
}

TEST_F(PlanReport, CarriesTheLicenceOfTheLibraryItDrawsWith) {
  EXPECT_NE(plan_report(problem_, result_).find("Redistribution and use in source and binary"),
            std::string::npos);
}

TEST_F(PlanReport, HoldsTheNumbersOfTheCandidatesToTheLastBit) {
  const Json data = data_of(plan_report(problem_, result_));
  ASSERT_EQ(data["candidates"].size(), result_.candidates.size());
  for (std::size_t k = 0; k < result_.candidates.size(); ++k) {
    const Candidate& candidate = result_.candidates[k];
    const Json& row = data["candidates"][k];
    EXPECT_EQ(row["rank"], candidate.rank);
    EXPECT_EQ(row["planner"], candidate.planner);
    EXPECT_EQ(row["length_m"], candidate.length_m);
    EXPECT_EQ(row["duration_s"], candidate.duration_s);
    EXPECT_EQ(row["energy_j"], candidate.energy_j);
    EXPECT_EQ(row["margin_min"], candidate.margin_min);
    EXPECT_EQ(row["margin_p05"], candidate.spread->p05);
    EXPECT_EQ(row["probability_feasible"], candidate.spread->feasible.share);
    EXPECT_EQ(row["verified"]["margin_min"], candidate.verified.margin_min);
    EXPECT_EQ(row["verified"]["max_deviation_m"], candidate.verified.deviation_max_m);
    EXPECT_EQ(row["limiting"]["margin"], name(candidate.limiting.margin));
    EXPECT_EQ(row["limiting"]["x_m"], candidate.limiting.x_m);
  }
}

TEST_F(PlanReport, ThinsALongPathWithoutLosingItsEndsOrItsWorstPoint) {
  const std::vector<TrajectoryPoint>& points = result_.candidates.front().points;
  const Json row = data_of(plan_report(problem_, result_))["candidates"][0];
  const std::vector<double> margins = row["points"]["margin"];
  EXPECT_LT(margins.size(), points.size());
  EXPECT_EQ(row["points_total"], points.size());
  EXPECT_NEAR(row["points"]["x_m"].front(), points.front().x_m, 1e-3);
  EXPECT_NEAR(row["points"]["x_m"].back(), points.back().x_m, 1e-3);
  const auto smaller = [](const auto& a, const auto& b) { return a.margin < b.margin; };
  EXPECT_NEAR(*std::min_element(margins.begin(), margins.end()),
              std::min_element(points.begin(), points.end(), smaller)->margin, 1e-4);
}

TEST_F(PlanReport, KeepsWhatWasRejectedAndWhy) {
  const Json data = data_of(plan_report(problem_, result_));
  ASSERT_EQ(data["rejected"].size(), std::size_t{kRejectionCount});
  for (int k = 0; k < kRejectionCount; ++k) {
    const Json& row = data["rejected"][static_cast<std::size_t>(k)];
    EXPECT_EQ(row["reason"], name(static_cast<Rejection>(k)));
    EXPECT_EQ(row["count"], result_.rejected[static_cast<std::size_t>(k)]);
  }
  EXPECT_EQ(data["rejected_states"].size(), result_.rejected_states.size());
  ASSERT_EQ(data["what_ifs"].size(), 2u);
  EXPECT_EQ(data["what_ifs"][0]["reason"], "cornering");
  EXPECT_TRUE(data["what_ifs"][0]["end_shift_m"].is_null());
  EXPECT_EQ(data["what_ifs"][1]["end_shift_m"], 6.3);
  EXPECT_EQ(data["what_ifs"][1]["driven"].size(), 2u);
  EXPECT_EQ(data["what_ifs"][1]["probability"], 0.95);
}

TEST_F(PlanReport, PowerIsTheEnergyOfTheWayToTheNextPoint) {
  const Json points = data_of(plan_report(problem_, result_))["candidates"][0]["points"];
  const std::vector<double> energy_j = points["energy_j"], time_s = points["time_s"];
  ASSERT_EQ(points["power_w"].size(), energy_j.size());
  EXPECT_TRUE(points["power_w"].back().is_null());
  double sum_j = 0;
  for (std::size_t i = 0; i + 1 < energy_j.size(); ++i) {
    sum_j += points["power_w"][i].get<double>() * (time_s[i + 1] - time_s[i]);
  }
  EXPECT_NEAR(sum_j, energy_j.back() - energy_j.front(), 0.01 * energy_j.back());
}

TEST_F(PlanReport, KeepsThePathThatARelaxationOpens) {
  const Json relaxed = data_of(plan_report(problem_, result_))["relaxed"];
  ASSERT_EQ(relaxed.size(), 2u);
  EXPECT_TRUE(relaxed[0]["path"].is_null());
  EXPECT_EQ(relaxed[1]["given_up"], "with margin_min 0");
  EXPECT_GT(relaxed[1]["path"]["points"]["x_m"].size(), 100u);
}

TEST_F(PlanReport, SaysAnglesOfRejectedStatesInDegrees) {
  result_.rejected_states = {
      {.reason = Rejection::kSlope,
       .exceeded = Exceeded{.found = std::acos(-1.0) / 6, .limit = std::acos(-1.0) / 12}}};
  const Json state = data_of(plan_report(problem_, result_))["rejected_states"][0];
  EXPECT_NEAR(state["value"], 30, 1e-4);
  EXPECT_NEAR(state["limit"], 15, 1e-4);
}

TEST_F(PlanReport, WritesWhatIsNotKnownAsNull) {
  TrajectoryPoint& point = result_.candidates.front().points[0];
  point.margin = point.cornering_margin = kNaN;
  point.supply_max_n = std::numeric_limits<double>::infinity();
  Candidate& best = result_.candidates.front();
  best.spread.reset();
  best.verified.margin_min = kNaN;
  best.limiting.x_m = kNaN;
  result_.rejected_states.front().exceeded = {.found = kNaN, .limit = 0.05};
  result_.what_ifs.front().margin_min = kNaN;
  const std::string page = plan_report(problem_, result_);
  const Json data = data_of(page);
  EXPECT_TRUE(data["candidates"][0]["points"]["margin"][0].is_null());
  EXPECT_TRUE(data["candidates"][0]["points"]["supply_max_n"][0].is_null());
  EXPECT_TRUE(data["candidates"][0]["margin_p05"].is_null());
  EXPECT_TRUE(data["rejected_states"][0]["value"].is_null());
  EXPECT_NE(headline_of(page).find("margin of unknown"), std::string::npos) << headline_of(page);
  EXPECT_EQ(headline_of(page).find("nan"), std::string::npos) << headline_of(page);
}

TEST_F(PlanReport, TiesAreToldByDrawsOnlyOfPathsThatWereDrawn) {
  const Candidate undrawn{.margin_min = 0.2};
  Candidate drawn = undrawn;
  drawn.spread = MarginSpread{.draws = 40, .p05 = 0.1, .p05_high = 0.2};
  EXPECT_EQ(tie_sentence({drawn, undrawn}), "");
  EXPECT_NE(tie_sentence({drawn, drawn}).find("1 and 2 are tied: over the draws"),
            std::string::npos);
  EXPECT_NE(tie_sentence({drawn, undrawn, undrawn}).find("2 and 3 are tied: no draws"),
            std::string::npos);
}

TEST_F(PlanReport, SaysTheVerdictFirst) {
  const std::string page = plan_report(problem_, result_);
  EXPECT_EQ(headline_of(page), plan_headline(result_, problem_.limits));
  EXPECT_LT(page.find("<h1"), page.find("<main>"));
  EXPECT_NE(page.find("Rejected for cornering at"), std::string::npos);
}

TEST_F(PlanReport, SaysOfEachIntervalWhatItIsOf) {
  const std::string page = plan_report(problem_, result_);
  EXPECT_NE(page.find("(95 % interval of the share: "), std::string::npos);
  EXPECT_NE(page.find("(95 % interval of that quantile: "), std::string::npos);
}

TEST_F(PlanReport, ExplainsAMarginOfMinusOne) {
  MarginSpread& spread = result_.candidates.front().spread.emplace();
  spread = {.draws = 40,
            .p05 = 0.1,
            .p05_low = 0.05,
            .p05_high = 0.2,
            .feasible = probability_of(38, 40)};
  const auto tells = [&](const std::string& words) {
    return plan_report(problem_, result_).find(words) != std::string::npos;
  };
  EXPECT_FALSE(tells("no steady drive") || tells("bear no steady drive"));
  spread.p05_low = -1;
  EXPECT_TRUE(tells("Its lower end of -1.00 says that so many draws do not rule out soils"));
  spread.p05 = -1;
  EXPECT_TRUE(tells("A margin of -1.00 stands for a place where the soil of that draw bears no"));
}

TEST_F(PlanReport, OfKnownSoilsSaysNothingOfDraws) {
  result_.candidates = {result_.candidates.front()};
  result_.candidates.front().spread = known_margin(0.3, 0.05);
  const std::string page = plan_report(problem_, result_);
  EXPECT_NE(page.find("there was nothing to draw"), std::string::npos);
  EXPECT_EQ(page.find("95 % interval of"), std::string::npos);
  EXPECT_NE(headline_of(page).find("on soils that are known exactly"), std::string::npos);
}

TEST_F(PlanReport, EscapesTextThatComesFromFiles) {
  std::vector<MapSoil> soils = problem_.map.soils();
  const std::string hostile = "</script><script>alert('soil')</script><!-- & \"";
  soils[0].source = hostile;
  problem_.map = problem_.map.with_soils(soils);
  problem_.vehicle.name = "<b>rover</b>";
  result_.status = PlanStatus::kInfeasible;
  result_.reason = hostile;
  const std::string page = plan_report(problem_, result_);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<b>rover"), std::string::npos);
  EXPECT_NE(page.find("&lt;b&gt;rover&lt;/b&gt;"), std::string::npos);
  const Json data = data_of(page);
  EXPECT_EQ(data["map"]["soils"][0]["source"], hostile);
  EXPECT_EQ(data["reason"], hostile);
}

TEST_F(PlanReport, TakesTextThatIsNotUtf8) {
  problem_.vehicle.source = "caf\xe9";
  EXPECT_NO_THROW(data_of(plan_report(problem_, result_)));
}

TEST(PlanReportSize, StaysUnderFiveMegabytesForAMap4096CellsWide) {
  const PlanningProblem problem = report_test_problem(report_test_map(4096));
  PlanResult result = report_test_result(problem);
  while (result.candidates.size() < 12) result.candidates.push_back(result.candidates.front());
  const std::size_t given = result.rejected_states.size();
  while (result.rejected_states.size() < 20 * given)
    result.rejected_states.push_back(result.rejected_states[result.rejected_states.size() % given]);
  const std::string page = plan_report(problem, result);
  EXPECT_LT(page.size(), std::size_t{5'000'000});
  const Json raster = data_of(page)["map"]["raster"];
  EXPECT_EQ(raster["columns"], 512);
  EXPECT_EQ(raster["cells_averaged"], 8);
}

TEST(PlanHeadline, FeasibleNamesTheMarginAndWhatBindsWhereAndWhen) {
  PlanResult result;
  result.status = PlanStatus::kFeasible;
  result.candidates.resize(2);
  result.candidates[0].limiting = {
      .margin = MarginKind::kTipOver, .x_m = 12.34, .y_m = 56, .time_s = 7.25};
  result.candidates[0].verified.margin_min = 0.213;
  EXPECT_EQ(plan_headline(result, {}),
            "Feasible: 2 verified paths; the best keeps a stability margin of 0.21 at the "
            "mean soils; tip over binds at x = 12.3 m, y = 56.0 m, t = 7.2 s.");
  result.candidates[0].spread = MarginSpread{.draws = 100,
                                             .p05 = -1,
                                             .p05_low = -1,
                                             .p05_high = 0.02,
                                             .feasible = probability_of(58, 100)};
  EXPECT_EQ(
      plan_headline(result, {}),
      "Feasible at the mean soils, doubtful over their draws: 2 verified paths; the best holds in "
      "58 of 100 draws of the soils; in 5 % of them or more the soil bears no steady drive along "
      "it (its stability margin is 0.21 at the mean soils); tip over binds at x = 12.3 m, y = 56.0 "
      "m, t = 7.2 s.");
  EXPECT_EQ(plan_headline(result, {.probability_min = 0.5}).rfind("Feasible: 2", 0), 0u);
}

TEST(PlanHeadline, OnePathIsNotSeveral) {
  PlanResult result;
  result.status = PlanStatus::kFeasible;
  result.candidates.resize(1);
  EXPECT_NE(plan_headline(result, {}).find("1 verified path;"), std::string::npos);
}

TEST(PlanHeadline, InfeasibleGivesTheReason) {
  PlanResult result;
  result.status = PlanStatus::kInfeasible;
  result.reason = "the goal lies in forbidden ground";
  EXPECT_EQ(plan_headline(result, {}), "Infeasible: the goal lies in forbidden ground.");
}

TEST(PlanHeadline, UndecidedNeverSoundsLikeNo) {
  PlanResult result;
  result.status = PlanStatus::kUndecided;
  EXPECT_EQ(plan_headline(result, {}), "Undecided: no path was verified within the budget.");
  result.reason = "no path was found in 20 s.";
  EXPECT_EQ(plan_headline(result, {}), "Undecided: no path was found in 20 s.");
}

TEST_F(PlanReport, SaysWhichRanksAreTied) {
  const auto set = [&](std::size_t k, double p05, double p05_high) {
    result_.candidates[k].spread->p05 = p05;
    result_.candidates[k].spread->p05_high = p05_high;
  };
  set(0, 0.103, 0.12);
  set(1, 0.100, 0.11);
  set(2, 0.05, 0.06);
  EXPECT_NE(plan_report(problem_, result_).find("<p>Ranks 1 and 2 are tied: "), std::string::npos);
  set(1, 0.100, 0.102);
  EXPECT_EQ(plan_report(problem_, result_).find("are tied: "), std::string::npos);
}

}  // namespace
}  // namespace regoplan
