#include "app/drive/drive_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/drive/broken_limits.h"
#include "tests/app/drive_fixture.h"
#include "tests/app/plan_report_fixture.h"

namespace regoplan {
namespace {

using Data = nlohmann::json;

class DriveReport : public testing::Test {
 protected:
  DriveReport() : problem_(report_test_problem(report_test_map(40))), world_(problem_, {}) {}

  ReferencePath path() const {
    const StartState& start = problem_.start;
    const Goal& goal = problem_.goal;
    PathCurve curve({{start.x_m, start.y_m}, {goal.x_m, goal.y_m}});
    SpeedProfile speed({{.s_m = 0, .speed_mps = 1}, {.s_m = curve.length_m(), .speed_mps = 1}});
    return {.name = "path", .legs = {{std::move(curve), std::move(speed)}}};
  }

  std::string page(const DriveRecord& record) const {
    return drive_report(problem_, path(), record, world_);
  }

  static Data data_of(const std::string& page) {
    const std::string lead = "id=\"data\">";
    const std::size_t at = page.rfind(lead) + lead.size();
    return Data::parse(page.substr(at, page.find("</script>", at) - at));
  }

  PlanningProblem problem_;
  TrueWorld world_;
};

TEST_F(DriveReport, OfALongDriveStaysSmallAndKeepsTheWorst) {
  DriveRecord drive = made_up_drive(problem_, 40000);
  drive.result.moments[12345].wheels[1].slip = 0.99;
  drive.result.moments[23456].offset_m = -0.9;
  const std::string text = page(drive);
  EXPECT_LT(text.size(), 3'000'000U);
  const Data driven = data_of(text).at("candidates").at(0);
  const Data& points = driven.at("points");
  EXPECT_EQ(driven.at("points_total"), 40000);
  EXPECT_LE(points.at("time_s").size(), 1000U);
  EXPECT_NE(std::ranges::find(points.at("slip_max"), Data(0.99)), points.at("slip_max").end());
  EXPECT_NE(std::ranges::find(points.at("cross_track_m"), Data(-0.9)),
            points.at("cross_track_m").end());
  EXPECT_NEAR(points.at("way_m").back(), drive.result.length_m, 0.01);
  for (const auto& [name, column] : points.items()) {
    EXPECT_EQ(column.size(), points.at("time_s").size()) << name;
  }
}

TEST_F(DriveReport, SaysFirstWhereItEndedAndWhichLimitsWereBroken) {
  const DriveRecord drive = made_up_drive(problem_, 200);
  const std::string text = page(drive);
  EXPECT_NE(text.find("Did not reach the goal: deviation 0.5 m (allowed: at most 0.4 m)"),
            std::string::npos);
  EXPECT_NE(text.find("Limit broken: slip 0.7 (allowed: at most 0.6) at worst"), std::string::npos);
}

TEST_F(DriveReport, MarksTheWorstRowOfEachStretch) {
  DriveRecord drive = made_up_drive(problem_, 50);
  for (DriveMoment& moment : drive.result.moments) {
    for (WheelNow& wheel : moment.wheels) wheel.slip = 0.1;
  }
  const double limit = problem_.limits.slip_max;
  for (const auto& [row, share] : {std::pair{10, 1.1}, {11, 1.3}, {12, 1.2}, {30, 1.05}}) {
    drive.result.moments[row].wheels[0].slip = share * limit;
  }
  std::vector<double> times_s;
  for (const Data& mark : broken_limits_json(problem_.limits, drive.result)) {
    if (mark.at("reason") == "slip") times_s.push_back(mark.at("time_s"));
  }
  ASSERT_EQ(times_s.size(), 2U);
  EXPECT_NEAR(times_s[0], 1.1, 1e-9);
  EXPECT_NEAR(times_s[1], 3.0, 1e-9);
}

TEST_F(DriveReport, OfADriveThatNeverBeganIsAPageToo) {
  DriveRecord drive = made_up_drive(problem_, 20);
  drive.result.moments.clear();
  drive.result.rows.clear();
  drive.result.margins.clear();
  drive.result.smallest_margin.reset();
  EXPECT_NE(page(drive).find("Did not reach the goal"), std::string::npos);
}

}  // namespace
}  // namespace regoplan
