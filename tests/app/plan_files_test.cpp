#include "app/plan/plan_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "planner/chart/margin_rasters.h"
#include "terramech/tables/csv_cells.h"
#include "tests/app/flat_map.h"

namespace regoplan {
namespace {

PlanningProblem flat_problem(const std::string& crs_wkt = "") {
  ElevationRaster elevation = flat_elevation();
  elevation.frame.crs_wkt = crs_wkt;
  return {.map = TerrainMap(std::move(elevation), {},
                            read_soil_catalogue(parse_settings(kOneSoil, "soils.yaml"),
                                                WheelVariant::kIshigami2007),
                            {}),
          .vehicle = preset_vehicle("lrv"),
          .gravity_mps2 = 1.62,
          .start = {.x_m = 10, .y_m = 20},
          .goal = {.x_m = 30, .y_m = 20, .radius_m = 3, .heading_rad = {}},
          .speed_max_mps = 3,
          .limits = {.slip_angle_max_rad = 16 * std::numbers::pi / 180},
          .search = {.time_s = {}, .iterations = 100}};
}

Candidate candidate(int rank) {
  Candidate made;
  made.rank = rank;
  made.planner = "SST";
  made.length_m = 0.1 + 0.2;  // no short decimal
  for (const double x_m : {10.0, 11.0}) {
    TrajectoryPoint point;
    point.x_m = x_m;
    point.y_m = 20;
    point.yaw_rad = std::numbers::pi / 2;
    point.soil = 0;
    made.points.push_back(point);
  }
  return made;
}

PlanResult result_with(int candidates) {
  PlanResult result;
  result.status = PlanStatus::kFeasible;
  result.reason = "found";
  for (int rank = 1; rank <= candidates; ++rank) result.candidates.push_back(candidate(rank));
  result.rejected[static_cast<std::size_t>(Rejection::kCornering)] = 7;
  return result;
}

/// The same of a plan that had time for rasters.
PlanResult result_with_rasters(int candidates) {
  PlanResult result = result_with(candidates);
  PlanningProblem problem = flat_problem();
  problem.limits = default_limits(problem.vehicle);
  result.rasters = terrain_rasters(problem);
  result.rasters->probability = straight_on_probability(problem);
  return result;
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

TEST(PlanFiles, PlanJsonHasTheKeysThatOthersRead) {
  const auto json = nlohmann::ordered_json::parse(plan_json(flat_problem(), result_with(2)));
  for (const char* key : {"status", "reason", "certificate", "candidates", "rejected",
                          "propagations", "planning_time_s", "seed", "version"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["status"], "feasible");
  EXPECT_TRUE(json["certificate"].is_null());
  ASSERT_EQ(json["candidates"].size(), 2);
  const auto& second = json["candidates"][1];
  for (const char* key :
       {"rank", "planner", "file", "length_m", "duration_s", "energy_j", "margin_min", "margin_p05",
        "margin_p50", "limiting", "probability_feasible", "verified"}) {
    EXPECT_TRUE(second.contains(key)) << key;
  }
  EXPECT_EQ(second["file"], "candidate-2.csv");
  EXPECT_EQ(second["limiting"]["margin"], "cornering");
  EXPECT_TRUE(second["verified"].contains("margin_min"));
  EXPECT_TRUE(second["verified"].contains("max_deviation_m"));
}

TEST(PlanFiles, PlanJsonSaysWhatWasAskedForAndWhatWasImproved) {
  PlanningProblem problem = flat_problem();
  problem.limits.probability_min = 0.9;
  problem.search.objective = {.per_s = 0.5, .per_j = 2};
  PlanResult result = result_with(2);
  result.candidates[1].improvement = {.cost_before = 30, .cost_after = 20};
  const auto json = nlohmann::json::parse(plan_json(problem, result));
  EXPECT_EQ(json["limits"]["probability_min"], 0.9);
  EXPECT_EQ(json["objective"]["per_s"], 0.5);
  EXPECT_EQ(json["objective"]["per_j"], 2);
  EXPECT_EQ(json["objective"]["exposed_below"], 0.2);
  EXPECT_TRUE(json["candidates"][0]["improved"].is_null());
  EXPECT_EQ(json["candidates"][1]["improved"]["cost_before"], 30);
  EXPECT_EQ(json["candidates"][1]["improved"]["cost_after"], 20);
}

TEST(PlanFiles, RejectionsStandInTheOrderInWhichTheyAreTested) {
  const auto json = nlohmann::ordered_json::parse(plan_json(flat_problem(), result_with(0)));
  std::string order;
  for (const auto& [reason, count] : json["rejected"].items()) order += reason + " ";
  EXPECT_EQ(order,
            "bounds speed unknown_terrain obstacle slope sinkage slip slip_angle traction tip_over "
            "cornering ");
  EXPECT_EQ(json["rejected"]["cornering"], 7);
}

TEST(PlanFiles, NumbersReadBackBitForBitAndNanIsNeverWritten) {
  PlanResult result = result_with(1);
  result.candidates[0].spread.reset();
  const std::string text = plan_json(flat_problem(), result);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["candidates"][0]["length_m"], 0.1 + 0.2);
  EXPECT_TRUE(json["candidates"][0]["margin_p05"].is_null());

  result.candidates[0].points[0].traction_margin = std::numeric_limits<double>::infinity();
  EXPECT_EQ(candidate_csv(flat_problem(), result.candidates[0]).find("inf"), std::string::npos);
}

TEST(PlanFiles, TimesSpentAreAllThatTellTwoEqualRunsApart) {
  PlanResult slow = result_with(2);
  slow.before_search = {{.step = "certificates", .time_s = 10}};
  slow.planning_time_s = 9;
  slow.verification_time_s = 8;
  slow.first_verified_s = 7;
  auto a = nlohmann::json::parse(plan_json(flat_problem(), result_with(2)));
  auto b = nlohmann::json::parse(plan_json(flat_problem(), slow));
  EXPECT_NE(a, b);
  for (auto* json : {&a, &b}) {
    json->erase("before_search");
    json->erase("planning_time_s");
    json->erase("verification_time_s");
    json->erase("first_verified_s");
  }
  EXPECT_EQ(a, b);
}

TEST(PlanFiles, ACandidatesTableHasDegreesAndSoilNames) {
  const std::string csv = candidate_csv(flat_problem(), candidate(1));
  EXPECT_EQ(first_line(csv),
            "time_s,x_m,y_m,z_m,yaw_deg,speed_mps,yaw_rate_rad_s,steer_deg,slip_max,"
            "slip_angle_max_deg,sinkage_max_m,soil,demand_n,supply_min_n,supply_max_n,"
            "cornering_margin,tip_over_margin,traction_margin,margin,curvature_1pm,"
            "acceleration_mps2,torque_max_nm,energy_j");
  const auto columns = split_cells(first_line(csv)).value();
  const auto cells = split_cells(first_line(csv.substr(csv.find('\n') + 1))).value();
  ASSERT_EQ(cells.size(), columns.size());
  EXPECT_EQ(cells[4], "90");
  EXPECT_EQ(cells[11], "mare");
}

TEST(PlanFiles, GeoJsonIsInMapCoordinatesAndNamesTheirCrs) {
  const std::string utm = R"(PROJCRS["WGS 84 / UTM zone 33N",BASEGEOGCRS["WGS 84"],)"
                          R"(ID["EPSG",32633]])";
  const auto crs_name = [](const std::string& wkt) {
    const auto json = nlohmann::json::parse(candidate_geojson(flat_problem(wkt), candidate(1)));
    return json["crs"]["properties"]["name"].get<std::string>();
  };
  EXPECT_EQ(crs_name(utm), "urn:ogc:def:crs:EPSG::32633");
  EXPECT_EQ(crs_name(R"(LOCAL_CS["Moon",UNIT["metre",1]])"), R"(LOCAL_CS["Moon",UNIT["metre",1]])");
  const auto json = nlohmann::json::parse(candidate_geojson(flat_problem(), candidate(1)));
  EXPECT_TRUE(json.contains("crs"));
  EXPECT_EQ(json["features"][0]["geometry"]["type"], "LineString");
  EXPECT_EQ(json["features"][0]["geometry"]["coordinates"][1][0], 11);
  EXPECT_EQ(json["features"][0]["properties"]["rank"], 1);
}

TEST(PlanFiles, AFolderHoldsTheCandidatesOfOnePlanOnly) {
  const ScratchFolder folder;
  folder.write("candidate-notes.csv", "mine");
  write_plan_files(flat_problem(), result_with_rasters(3), {folder.path("")});
  EXPECT_EQ(folder.count(), 1 + 6 + 3 * 2);
  write_plan_files(flat_problem(), result_with_rasters(1), {folder.path("")});
  EXPECT_EQ(folder.count(), 1 + 6 + 1 * 2);
  write_plan_files(flat_problem(), result_with(1), {folder.path("")});
  EXPECT_EQ(folder.count(), 1 + 3 + 1 * 2) << "rasters of an earlier plan";
  EXPECT_EQ(folder.read("plan.json"), plan_json(flat_problem(), result_with(1)));
}

TEST(PlanFiles, MarginAndSupplyLieInTheMapsPlace) {
  const ScratchFolder folder;
  PlanningProblem problem = flat_problem();
  problem.limits = default_limits(problem.vehicle);
  write_plan_files(problem, result_with_rasters(1), {folder.path("out")});
  for (const char* name : {"out/margin.tif", "out/supply.tif", "out/probability.tif"}) {
    const ElevationRaster read = read_elevation(folder.path(name));  // band 1
    EXPECT_EQ(read.frame, problem.map.elevation().frame) << name;
    EXPECT_GT(read.height_m[20 * 40 + 20], 0.1F) << name;
  }
}

TEST(PlanFiles, WhereNothingWasSearchedThereAreNoRastersNotEvenOlderOnes) {
  const ScratchFolder folder;
  write_plan_files(flat_problem(), result_with_rasters(1), {folder.path("")});
  EXPECT_TRUE(std::filesystem::exists(folder.path("margin.tif")));
  PlanResult refused;
  refused.status = PlanStatus::kInfeasible;
  refused.reason = "the start is refused";
  write_plan_files(flat_problem(), refused, {folder.path("")});
  EXPECT_FALSE(std::filesystem::exists(folder.path("margin.tif")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("supply.tif")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("probability.tif")));
  EXPECT_EQ(folder.count(), 3);
}

TEST(PlanFiles, MarksWhatNoOtherCandidateBeats) {
  PlanResult result = result_with(2);
  result.candidates[0].margin_min = 0.2;
  result.candidates[1].margin_min = 0.1;
  const auto candidates = nlohmann::json::parse(plan_json(flat_problem(), result)).at("candidates");
  EXPECT_EQ(candidates[0].at("pareto"), true);
  EXPECT_EQ(candidates[1].at("pareto"), false);
}

}  // namespace
}  // namespace regoplan
