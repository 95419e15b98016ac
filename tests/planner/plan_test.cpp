#include "planner/plan.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "planner/driving/replay.h"
#include "planner/problem/world.h"
#include "terramech/basics/input_error.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

PlanResult planned(const PlanningProblem& problem) {
  return plan(problem);
}

std::int64_t count(const PlanResult& result, Rejection reason) {
  return result.rejected[static_cast<std::size_t>(reason)];
}

/// Everything of a result that must not depend on the clock.
std::string fingerprint(const PlanResult& result) {
  std::string text = std::string(name(result.status)) + result.reason;
  for (const Candidate& c : result.candidates) {
    text += c.planner + std::to_string(c.seed);
    for (const TrajectoryPoint& p : c.points) {
      for (const double value : {p.time_s, p.x_m, p.y_m, p.yaw_rad, p.speed_mps, p.margin}) {
        text += std::to_string(std::bit_cast<std::uint64_t>(value)) + ",";
      }
    }
    text += std::to_string(std::bit_cast<std::uint64_t>(c.spread->p05));
  }
  for (const auto n : result.rejected) text += std::to_string(n) + ";";
  return text + std::to_string(result.propagations);
}

}  // namespace

class EveryPlanner : public testing::TestWithParam<std::string> {};

TEST_P(EveryPlanner, FindsAVerifiedPathAcrossOpenGround) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.search.planner = GetParam();
  problem.search.iterations = GetParam() == "SST" ? 6000 : 3000;
  const PlanResult result = planned(problem);
  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  const Candidate& best = result.candidates.front();
  EXPECT_EQ(best.rank, 1);
  EXPECT_TRUE(GetParam() == "auto" || best.planner == GetParam()) << best.planner;
  EXPECT_TRUE(best.verified.passed);
  EXPECT_GE(best.margin_min, problem.limits.margin_min);
  EXPECT_LT(best.verified.deviation_max_m, 0.1);
  const TrajectoryPoint& end = best.points.back();
  EXPECT_LE(std::hypot(end.x_m - problem.goal.x_m, end.y_m - problem.goal.y_m),
            problem.goal.radius_m);
  EXPECT_GT(result.propagations, 0);
}

INSTANTIATE_TEST_SUITE_P(All, EveryPlanner, testing::ValuesIn(planner_names()),
                         [](const auto& planner) { return planner.param; });

TEST(Plan, AStartAtTopSpeedIsDrivenOnFrom) {
  PlanningProblem problem = lrv_problem(one_soil_map(
      50, firm_regolith(), [](double x, double y) { return 0.02 * std::sin(x) * std::cos(y); }));
  problem.search.planner = "Lattice";
  problem.start.speed_mps = problem.speed_max_mps;
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
}

TEST(Plan, SearchesUnderEveryDriveLawAndWithWheelsThatRollFreely) {
  for (const auto change : {+[](Vehicle& v) { v.drive_law = DriveLaw::kEqualSpeed; },
                            +[](Vehicle& v) { v.drive_law = DriveLaw::kEqualTorque; },
                            +[](Vehicle& v) { v.wheels[0].driven = v.wheels[1].driven = false; }}) {
    PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
    change(problem.vehicle);
    // Laws without tables of supply are solved at every state: the shorter the way, the better.
    problem.goal.x_m = 18;
    problem.search.iterations = 300;
    problem.search.soil_draws = 2;
    const PlanResult result = planned(problem);
    ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
    EXPECT_TRUE(result.candidates.front().verified.passed);
  }
}

TEST(Plan, SameSeedAndIterationsGiveTheSameBitsWithAnyNumberOfThreads) {
  PlanningProblem problem = lrv_problem(
      one_soil_map(50, firm_regolith(),
                   [](double x, double y) { return 0.4 * std::sin(x / 4) * std::cos(y / 5); },
                   {{25, 25, 1, 1}, {30, 22, 1, 1}}));
  problem.search.planner = "auto";
  problem.search.iterations = 400;
  problem.search.candidates = 2;
  const PlanResult once = planned(problem);
  EXPECT_EQ(fingerprint(once), fingerprint(planned(problem)));
  problem.search.threads = 1;
  EXPECT_EQ(fingerprint(once), fingerprint(planned(problem)));
  problem.search.seed = 8;
  EXPECT_NE(fingerprint(once), fingerprint(planned(problem)));
}

TEST(Plan, AVehicleThatRestsInItsGoalHasNoWayToGo) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.goal.x_m = problem.start.x_m + 1;
  for (const bool with_heading : {false, true}) {
    if (with_heading) problem.goal.heading_rad = problem.start.heading_rad;
    problem.goal.heading_tolerance_rad = 5 * kTestDegree;
    const PlanResult result = planned(problem);
    EXPECT_EQ(result.status, PlanStatus::kFeasible);
    EXPECT_EQ(result.reason, "the vehicle stands in its goal already, there is no way to go");
    EXPECT_TRUE(result.candidates.empty());
    EXPECT_EQ(result.propagations, 0);
  }
}

TEST(Plan, AVehicleInItsGoalThatHeadsElsewhereOrStillRollsIsPlannedFor) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.goal.x_m = problem.start.x_m + 1;
  problem.search.planner = "Lattice";
  PlanningProblem rolling = problem;
  rolling.start.speed_mps = 0.3;
  problem.goal.heading_rad = 90 * kTestDegree;
  problem.goal.heading_tolerance_rad = 10 * kTestDegree;
  EXPECT_GT(planned(problem).propagations, 0);
  EXPECT_GT(planned(rolling).propagations, 0);
}

TEST(Plan, APathWithinTheLimitsIsNoReasonToGiveLimitsUp) {
  // A wall with a way round, for which the search that is asked for has too few iterations.
  std::vector<Rock> wall;
  for (double y_m = 12; y_m < 50; ++y_m) wall.push_back({25, y_m, 1, 1});
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, wall));
  problem.search.planner = "RRT";
  problem.search.iterations = 50;
  const PlanResult result = planned(problem);
  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  EXPECT_TRUE(result.relaxed.empty());
  ASSERT_EQ(result.candidates.size(), 1);
  const Candidate& path = result.candidates.front();
  EXPECT_EQ(path.rank, 1);
  EXPECT_EQ(path.planner, "Lattice");
  EXPECT_TRUE(path.verified.passed);
  EXPECT_GE(path.margin_min, problem.limits.margin_min);
  EXPECT_TRUE(path.spread);
  EXPECT_NE(result.reason.find("by Lattice found and those by RRT did not"), std::string::npos)
      << result.reason;
}

TEST(Plan, AWallOfRocksIsInfeasibleWithItsCertificate) {
  std::vector<Rock> wall;
  for (int i = 0; i < 40; ++i) wall.push_back({25, 0.5 + 1.25 * i, 0.8, 2});
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, wall));
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kInfeasible);
  EXPECT_TRUE(result.candidates.empty());
  ASSERT_TRUE(result.certificate);
  EXPECT_NE(result.certificate->find("rocks"), std::string::npos) << *result.certificate;
}

TEST(Plan, WhatCannotBeCertifiedStaysUndecidedAndSaysWhatStoppedIt) {
  // A wall with a gap that the body fits through, but not with the clearance that a search keeps.
  std::vector<Rock> wall;
  for (double away = 1.08 + 0.6; away <= 25; away += 0.8) {
    for (const double side : {-1, 1}) wall.push_back({25, 25 + side * away, 0.6, 3});
  }
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, wall));
  problem.search.iterations = 300;
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kUndecided);
  EXPECT_TRUE(result.candidates.empty());
  EXPECT_GT(count(result, Rejection::kObstacle), 0);
  EXPECT_NE(result.reason.find("obstacle"), std::string::npos) << result.reason;
}

TEST(Plan, AStartWhereTheVehicleMayNotStandIsInfeasibleWithItsCertificate) {
  const auto steep = [](double /*x*/, double y) { return std::tan(30 * kTestDegree) * y; };
  const PlanResult result = planned(lrv_problem(one_soil_map(50, firm_regolith(), steep)));
  EXPECT_EQ(result.status, PlanStatus::kInfeasible);
  ASSERT_TRUE(result.certificate);
  EXPECT_NE(result.certificate->find("slope"), std::string::npos) << *result.certificate;
}

TEST(Plan, TheBestPathAtTwiceItsSpeedsIsRejectedForCornering) {
  // A rock in the way makes it turn.
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 3, 2}}));
  const PlanResult result = planned(problem);
  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  ASSERT_EQ(result.what_ifs.size(), 3u);
  const WhatIf& faster = result.what_ifs[0];
  EXPECT_FALSE(faster.feasible);
  EXPECT_EQ(faster.reason, Rejection::kCornering);
  EXPECT_GT(faster.time_s, 0);
  const WhatIf& weaker = result.what_ifs[2];
  ASSERT_TRUE(weaker.end_shift_m);
  EXPECT_GT(*weaker.end_shift_m, 0.2);
}

TEST(Plan, UncertainSoilLowersTheMarginThatMostDrawsKeep) {
  UncertainSoil uncertain = firm_regolith();
  uncertain.standard_deviation.friction_angle_rad = 4 * kTestDegree;
  uncertain.standard_deviation.cohesion_pa = 60;
  PlanningProblem problem = lrv_problem(one_soil_map(50, uncertain, flat));
  problem.search.soil_draws = 40;
  const PlanResult result = planned(problem);
  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  const Candidate& best = result.candidates.front();
  EXPECT_LT(best.spread->p05, best.margin_min);
  EXPECT_GT(best.spread->feasible.share, 0.5);

  const PlanResult certain = planned(lrv_problem(one_soil_map(50, firm_regolith(), flat)));
  ASSERT_EQ(certain.status, PlanStatus::kFeasible) << certain.reason;
  EXPECT_NEAR(certain.candidates.front().spread->p05, certain.candidates.front().margin_min, 2e-3);
  EXPECT_EQ(certain.candidates.front().spread->feasible.share, 1);
}

TEST(Plan, FewDrawsAreEnoughForTheRastersOfTheMap) {
  UncertainSoil uncertain = firm_regolith();
  uncertain.standard_deviation.cohesion_pa = 60;
  PlanningProblem problem = lrv_problem(one_soil_map(50, uncertain, flat));
  problem.search.soil_draws = 3;
  const PlanResult result = planned(problem);
  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  ASSERT_TRUE(result.rasters);
  EXPECT_FALSE(result.rasters->probability.empty());
}

TEST(Plan, KnownSoilsHaveNoSamplingErrorAndKeepAnyChanceConstraint) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.search.soil_draws = 20;  // 20 of 20 draws would show .84
  problem.limits.probability_min = 0.999;
  const PlanResult result = planned(problem);
  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  const Candidate& best = result.candidates.front();
  ASSERT_TRUE(best.spread);
  EXPECT_EQ(best.spread->draws, 0);
  for (const double p05 : {best.spread->p05_low, best.spread->p05, best.spread->p05_high}) {
    EXPECT_EQ(p05, best.margin_min);
  }
  EXPECT_EQ(best.spread->feasible.low, 1);
  EXPECT_EQ(best.spread->feasible.high, 1);
  EXPECT_TRUE(result.rasters && !result.rasters->probability.empty());
}

TEST(Plan, AChanceConstraintLeavesOutWhatTheSoilMayNotHold) {
  UncertainSoil uncertain = firm_regolith();
  uncertain.standard_deviation.friction_angle_rad = 4 * kTestDegree;
  PlanningProblem problem = lrv_problem(one_soil_map(50, uncertain, flat));
  problem.search.planner = "Lattice";
  problem.search.soil_draws = 40;
  problem.limits.probability_min = 0.9;  // 40 of 40 draws show 0.91
  const PlanResult kept = planned(problem);
  for (const Candidate& candidate : kept.candidates) {
    EXPECT_EQ(candidate.spread->feasible.share, 1) << kept.reason;
  }
  // As much margin as the mean soil gives: half of the draws give less.
  problem.limits.probability_min = 0;
  const double at_mean = planned(problem).candidates.front().margin_min;
  problem.limits.margin_min = at_mean - 0.02;
  problem.limits.probability_min = 0.9;
  const PlanResult strict = planned(problem);
  EXPECT_NE(strict.status, PlanStatus::kFeasible) << strict.reason;
}

TEST(Plan, AStopRequestEndsItWithWhatThereIs) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.search.iterations.reset();
  problem.search.time_s = 600;
  problem.search.candidates = 100;
  std::stop_source stop;
  const PlanResult result =
      plan(problem, {.on_verified = [&](const Candidate&, double) { stop.request_stop(); },
                     .stop = stop.get_token()});
  EXPECT_TRUE(result.interrupted);
  EXPECT_LT(result.planning_time_s, 60);
  EXPECT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
}

TEST(Plan, AStopRequestBeforeAnyPathSaysNothingOfTheTime) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.search.iterations.reset();
  problem.search.time_s = 600;
  std::stop_source stop;
  const PlanResult result = plan(problem, {.on_progress =
                                               [&](const PlanProgress& progress) {
                                                 if (progress.stage == "searching")
                                                   stop.request_stop();
                                               },
                                           .stop = stop.get_token()});
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.status, PlanStatus::kUndecided);
  EXPECT_EQ(result.reason.find("suffice"), std::string::npos) << result.reason;
}

TEST(PlanTime, BeforeTheSearchIsToldStepByStepFromTheStartOn) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.search.planner = "Lattice";
  problem.search.iterations = 100;
  const auto now = std::chrono::steady_clock::now();
  const PlanResult result = plan(problem, {.started = now - std::chrono::seconds(5)});
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - now;
  ASSERT_EQ(result.before_search.size(), 4);
  EXPECT_GE(result.before_search[0].time_s, 5);  // whoever reads the scenario is counted as well
  double whole_s = result.planning_time_s;
  for (const TimedStep& timed : result.before_search) {
    EXPECT_GE(timed.time_s, 0) << timed.step;
    EXPECT_NE(timed.step, "");
    whole_s += timed.time_s;
  }
  EXPECT_LE(whole_s, 5 + taken.count());

  // A certificate needs no search, and has its time too.
  problem.limits.slope_max_rad = 0.01;
  problem.map = one_soil_map(50, firm_regolith(), [](double x, double) { return 0.2 * x; });
  const PlanResult refused = plan(problem, {});
  ASSERT_EQ(refused.status, PlanStatus::kInfeasible);
  EXPECT_EQ(refused.before_search.size(), 3);
}

TEST(PlanTime, IsThatOfTheWholeAnswer) {
  UncertainSoil uncertain = firm_regolith();
  uncertain.standard_deviation.friction_angle_rad = 4 * kTestDegree;
  PlanningProblem problem = lrv_problem(one_soil_map(50, uncertain, flat));
  problem.search.planner = "Lattice";
  problem.search.iterations.reset();
  problem.search.time_s = 4;
  problem.search.candidates = 20;
  problem.search.soil_draws = 100000;  // for which there is no time
  const auto start = std::chrono::steady_clock::now();
  const PlanResult result = plan(problem, {.started = start});
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_LT(taken.count(), 4.5);
  EXPECT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  ASSERT_TRUE(result.first_verified_s);
  EXPECT_LT(*result.first_verified_s, 0.5 * 4);
}

TEST(PlanTime, WantOfItIsSaidFirstWithATimeThatMayDo) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.search.iterations.reset();
  problem.search.time_s = 0.06;
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kUndecided);
  EXPECT_TRUE(result.reason.starts_with("0.06 s did not suffice, give it 0.")) << result.reason;
}

TEST(PlanningProblem, WhatCannotBeAskedNamesFieldAndRange) {
  const PlanningProblem good = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  EXPECT_NO_THROW(validate(good));
  const auto message = [&](const std::function<void(PlanningProblem&)>& spoil) -> std::string {
    PlanningProblem problem = good;
    spoil(problem);
    try {
      validate(problem);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto names = [&](const char* text, const std::function<void(PlanningProblem&)>& spoil) {
    EXPECT_NE(message(spoil).find(text), std::string::npos) << message(spoil);
  };
  names("goal.radius_m", [](PlanningProblem& p) { p.goal.radius_m = 0; });
  names("outside the map", [](PlanningProblem& p) { p.start.x_m = 500; });
  names("outside the map", [](PlanningProblem& p) { p.goal.y_m = -3; });
  names("vehicle's 5", [](PlanningProblem& p) { p.speed_max_mps = 9; });
  names("start.speed_mps", [](PlanningProblem& p) { p.start.speed_mps = -1; });
  names("planner.name", [](PlanningProblem& p) { p.search.planner = "A*"; });
  names("exactly one", [](PlanningProblem& p) { p.search.time_s = 3; });
  names("planner.candidates", [](PlanningProblem& p) { p.search.candidates = 0; });
  names("limits.margin_min", [](PlanningProblem& p) { p.limits.margin_min = -0.1; });
  names("limits.slip_max", [](PlanningProblem& p) { p.limits.slip_max = NAN; });
  names("limits.probability_min", [](PlanningProblem& p) { p.limits.probability_min = 1; });
  names("planner.soil_draws", [](PlanningProblem& p) {
    UncertainSoil uncertain = firm_regolith();
    uncertain.standard_deviation.cohesion_pa = 60;
    p.map = one_soil_map(50, uncertain, flat);
    p.limits.probability_min = 0.9;
  });
  names("planner.objective", [](PlanningProblem& p) { p.search.objective = {.per_s = 0}; });
  names("planner.objective.per_j", [](PlanningProblem& p) { p.search.objective.per_j = -1; });
  names("gravity_mps2", [](PlanningProblem& p) { p.gravity_mps2 = 0; });
  const auto spoil_soil = [](const std::function<void(UncertainSoil&)>& spoil) {
    return [spoil](PlanningProblem& p) {
      UncertainSoil soil = firm_regolith();
      spoil(soil);
      p.map = one_soil_map(50, soil, flat);
    };
  };
  names("soils.regolith.cohesion_pa.std: -3 is not valid (allowed: at least 0)",
        spoil_soil([](UncertainSoil& soil) { soil.standard_deviation.cohesion_pa = -3; }));
  names("soils.regolith.lambda.std",
        spoil_soil([](UncertainSoil& soil) { soil.standard_deviation.lambda = NAN; }));
  names("soils.regolith.n: nan", spoil_soil([](UncertainSoil& soil) { soil.mean.n = NAN; }));
  names("soils.regolith.kphi: 0", spoil_soil([](UncertainSoil& soil) { soil.mean.kphi = 0; }));
  names("mechanism id: mud is not known",
        [](PlanningProblem& p) { p.mechanisms = {{.id = "mud", .form = {}, .parameters = {}}}; });
  names("touches a rock", [](PlanningProblem& p) {
    p.map = one_soil_map(50, firm_regolith(), flat, {{10.5, 25, 1, 2}});
  });
}

TEST(Replay, TheFinerReplayEndsWhereTheSearchDid) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), [](double x, double y) {
        return 0.5 * std::sin(x / 5) * std::cos(y / 6);
      }));
  const World search(problem, WorldUse::kSearch, 2);
  const World verdict(problem, WorldUse::kVerdict, 1);
  const std::vector<ControlSegment> controls{{6.0, 2.5, 0.05}, {2.0, 2.5, -0.05}, {2.0, 2.5, 0}};
  const ReplaySteps fine = verification_steps(verdict);
  const Replay a = replay(search, controls, {.coarse_s = fine.coarse_s}, false);
  const Replay b = replay(verdict, controls, fine, false);
  EXPECT_GT(b.length_m, 10);
  EXPECT_LT(deviation_max_m(a, b), 0.02);
}

}  // namespace regoplan
