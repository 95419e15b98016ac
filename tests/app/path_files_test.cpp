// Paths as files give them.
#include "app/evaluate/path_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "tests/app/plan_report_fixture.h"
#include "tests/error_text.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

using namespace std::string_literals;

/// Rows of a candidate that goes 8 m ahead, stands, and goes 6 m back, on a line along x.
std::string there_and_back() {
  std::string text = "time_s,x_m,y_m,yaw_deg,speed_mps,steer_deg,demand_n,margin,curvature_1pm\n";
  const auto row = [&](double time_s, double x_m, double speed_mps) {
    text += fmt::format("{},{},5100,0,{},0,0,0.5,0\n", time_s, x_m, speed_mps);
  };
  for (int i = 0; i <= 16; ++i) {
    row(i, 1050 + 8 * (1 - std::cos(i * M_PI / 16)) / 2, 0.78 * std::sin(i * M_PI / 16));
  }
  for (int i = 1; i <= 16; ++i) {
    row(16 + i, 1058 - 6 * (1 - std::cos(i * M_PI / 16)) / 2, -0.58 * std::sin(i * M_PI / 16));
  }
  return text;
}

TEST(PathFiles, ACandidateThatChangesItsDirectionHasLegs) {
  const ScratchFolder folder;
  folder.write("candidate-1.csv", there_and_back());
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  const ReferencePath path = read_path(folder.path("candidate-1.csv"), problem, 3).path;
  ASSERT_EQ(path.legs.size(), 2u);
  EXPECT_FALSE(path.legs[0].reverse);
  EXPECT_TRUE(path.legs[1].reverse);
  EXPECT_NEAR(path.length_m(), 14, 0.05);
  EXPECT_NEAR(path.leg_start_m(1), 8, 0.05);
  EXPECT_NEAR(std::abs(path.place(10).on_curve().heading_rad), M_PI, 1e-6);
  EXPECT_EQ(path.legs[0].recorded.size() + path.legs[1].recorded.size(), 33u);
  EXPECT_NEAR(path.legs[1].recorded.back().s_m, path.legs[1].length_m(), 1e-9);
  // It stands where its direction changes.
  EXPECT_LT(path.legs[0].speed.at(path.legs[0].length_m()).speed_mps, 1e-6);
  EXPECT_LT(path.legs[1].speed.at(0).speed_mps, 1e-6);
}

TEST(PathFiles, GoingBackByAHandAtAPlaceWhereItAllButStandsIsNoLeg) {
  const ScratchFolder folder;
  std::string text = "time_s,x_m,y_m,yaw_deg,speed_mps,steer_deg,demand_n,margin,curvature_1pm\n";
  double time_s = 0;
  const auto row = [&](double x_m, double speed_mps) {
    text += fmt::format("{},{},5100,0,{},0,0,0.5,0\n", time_s++, x_m, speed_mps);
  };
  for (int i = 0; i <= 4; ++i) row(1050 + i, i < 4 ? 1 : 0.03);
  row(1053.98, -0.05);
  row(1053.97, 0.03);
  for (int i = 5; i <= 8; ++i) row(1050 + i, i < 8 ? 1 : 0);
  folder.write("candidate-1.csv", text);
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  const ReferencePath path = read_path(folder.path("candidate-1.csv"), problem, 3).path;
  ASSERT_EQ(path.legs.size(), 1u);
  EXPECT_FALSE(path.legs[0].reverse);
  EXPECT_NEAR(path.length_m(), 8, 0.05);
  EXPECT_EQ(path.legs[0].recorded.size(), 11u);
}

TEST(PathFiles, WhatIsLeftOfASpeedAtRestSaysNothingOfADirection) {
  const ScratchFolder folder;
  folder.write("candidate-1.csv",
               "time_s,x_m,y_m,yaw_deg,speed_mps,steer_deg,demand_n,margin,curvature_1pm\n"
               "0,1050,5100,0,1,0,0,0.5,0\n1,1051,5100,0,1,0,0,0.5,0\n"
               "2,1051.5,5100,0,-1.7e-10,0,0,0.5,0\n");
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  const ReferencePath path = read_path(folder.path("candidate-1.csv"), problem, 3).path;
  ASSERT_EQ(path.legs.size(), 1u);
  const VehicleState& last = path.legs[0].recorded.back().state;
  EXPECT_EQ(last.rim_speed_mps, 0);
  EXPECT_EQ(last.direction_at_rest, 1);
}

TEST(PathFiles, ACandidateEndsAtTheSpeedOfItsLastRowHoweverNearTheOneBeforeLies) {
  for (const double end_mps : {0.0, 0.5}) {
    const ScratchFolder folder;
    std::string text = "time_s,x_m,y_m,yaw_deg,speed_mps,steer_deg,demand_n,margin,curvature_1pm\n";
    for (int i = 0; i < 8; ++i) text += fmt::format("{},{},5100,0,1,0,0,0.5,0\n", i, 1050 + i);
    text += "8,1057.95,5100,0,0.24,0,0,0.5,0\n";
    text += fmt::format("9,1058,5100,0,{},0,0,0.5,0\n", end_mps);
    folder.write("candidate-1.csv", text);
    const PlanningProblem problem = report_test_problem(report_test_map(40));
    const ReferencePath path = read_path(folder.path("candidate-1.csv"), problem, 3).path;
    ASSERT_EQ(path.legs.size(), 1u);
    EXPECT_EQ(path.legs[0].speed.at(path.length_m()).speed_mps, end_mps);
  }
}

TEST(PathFiles, AFileOfAnotherProgramSaysWhatIsWrongWithIt) {
  const ScratchFolder folder;
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  const auto refusal = [&](const std::string& text) {
    folder.write("path.csv", text);
    return error_text([&] { read_path(folder.path("path.csv"), problem, 3); });
  };
  EXPECT_TRUE(refusal("x_m;y_m\n1050;5100\n")
                  .ends_with("path.csv:1: cells are separated by semicolons (allowed: commas)"));
  EXPECT_TRUE(refusal("x_m\ty_m\n1050\t5100\n").ends_with("by tabs (allowed: commas)"));
  EXPECT_TRUE(refusal("\xFF\xFEx").ends_with("path.csv:1: the file is UTF-16 (allowed: UTF-8)"));
  EXPECT_TRUE(refusal("x_m,y_m\r1050,5100\r1060,5100\r")
                  .ends_with("path.csv:1: a carriage return within the line (allowed: lines that "
                             "end in a line feed)"));
  const std::string no_number = refusal("x_m,y_m\n1050,abc\n1060,5100\n");
  EXPECT_NE(no_number.find("path.csv:2: y_m: abc is not valid (allowed: a number, "),
            std::string::npos)
      << no_number;
  const std::string far = refusal("x_m,y_m\n9e9,5100\n1060,5100\n");
  EXPECT_EQ(far.find("a number"), std::string::npos) << far;
  EXPECT_FALSE(std::regex_search(far, std::regex(R"(\.\d{3})"))) << "at most centimetres: " << far;
  const std::string two_bytes_a_letter = "x\0,\0y\0\n\0"s;
  EXPECT_TRUE(refusal(two_bytes_a_letter)
                  .ends_with("path.csv:1: zero bytes, as of UTF-16 (allowed: UTF-8)"));
}

TEST(PathFiles, AZeroByteIsToldAndDoesNotCutTheMessage) {
  const ScratchFolder folder;
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  folder.write("path.csv", "x_m,y_m\n1050,5100\0\n1060,5100\n"s);
  EXPECT_TRUE(error_text([&] {
                read_path(folder.path("path.csv"), problem, 3);
              }).ends_with("path.csv:2: a zero byte (allowed: text in UTF-8)"));
}

TEST(PathFiles, ASpeedThatIsTooHighIsToldWithWhatSetsTheLargest) {
  const ScratchFolder folder;
  PlanningProblem problem = report_test_problem(report_test_map(40));
  const std::string candidate =
      "time_s,x_m,y_m,yaw_deg,speed_mps,steer_deg,demand_n,margin\n"
      "0,1050,5100,0,9,0,0,.2\n1,1060,5100,0,9,0,0,.2\n";
  const auto refusal = [&](const std::string& text, double speed_max_mps) {
    folder.write("path.csv", text);
    return error_text([&] { read_path(folder.path("path.csv"), problem, speed_max_mps); });
  };
  problem.vehicle.name = "rover";
  problem.vehicle.speed_max_mps = 3;
  problem.speed_max_mps = 2;
  const std::string points = "x_m,y_m,speed_mps\n1050,5100,0\n1060,5100,9\n1070,5100,0\n";
  EXPECT_TRUE(refusal(candidate, 3)
                  .ends_with("path.csv:2: speed_mps: 9 is not valid (allowed: -3 to 3, "
                             "speed_max_mps of the vehicle rover)"))
      << refusal(candidate, 3);
  EXPECT_TRUE(
      refusal(points, 2).ends_with("path.csv:3: speed_mps: 9 is not valid (allowed: above 0 to 2, "
                                   "speed_mps.max of the scenario; "
                                   "0 only at the ends)"))
      << refusal(points, 2);
  EXPECT_TRUE(refusal(points, 1).ends_with("above 0 to 1, --speed; 0 only at the ends)"))
      << refusal(points, 1);
}

TEST(PathFiles, AMissingColumnIsToldWithTheOneThatMayBeMeant) {
  const ScratchFolder folder;
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  const auto refusal = [&](const std::string& header) {
    folder.write("path.csv", header + "\n1050,5100\n1060,5100\n");
    return error_text([&] { read_path(folder.path("path.csv"), problem, 3); });
  };
  EXPECT_TRUE(refusal("X_M,Y_M").ends_with(":1: column x_m is missing (the header has X_M)"));
  EXPECT_TRUE(refusal("# x_m,y_m").ends_with(":1: column x_m is missing (the header has # x_m)"));
  EXPECT_TRUE(refusal("x_m,z_m").ends_with(":1: column y_m is missing"));
}

}  // namespace
}  // namespace regoplan
