#include "app/plan/plan_files.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <string_view>

#include "app/page/spread_json.h"
#include "app/plan/plan_report.h"
#include "app/settings/effective_settings.h"
#include "app/settings/model_settings.h"
#include "maps/raster_files.h"
#include "planner/problem/terrain_rasters.h"
#include "planner/verdict/pareto.h"
#include "terramech/basics/angles.h"
#include "terramech/tables/csv_cells.h"

namespace regoplan {
namespace {

constexpr const char* kMarginFile = "margin.tif";
constexpr const char* kSupplyFile = "supply.tif";
constexpr const char* kProbabilityFile = "probability.tif";

using Json = nlohmann::ordered_json;

std::string candidate_file(int rank, std::string_view extension) {
  return fmt::format("candidate-{}.{}", rank, extension);
}

Json objective_json(const Objective& objective) {
  return {{"per_s", objective.per_s},
          {"per_m", objective.per_m},
          {"per_j", objective.per_j},
          {"per_exposed_s", objective.per_exposed_s},
          {"exposed_below", objective.exposed_below}};
}

Json timed_step_json(const TimedStep& timed) {
  return {{"step", timed.step}, {"time_s", timed.time_s}};
}

/// Null where a path is as the search found it.
Json improved_json(const std::optional<Improvement>& improvement) {
  if (!improvement) return nullptr;
  return {{"cost_before", improvement->cost_before}, {"cost_after", improvement->cost_after}};
}

Json limiting_json(const LimitingPlace& place) {
  return {{"margin", name(place.margin)},
          {"x_m", place.x_m},
          {"y_m", place.y_m},
          {"time_s", place.time_s}};
}

Json candidate_json(const Candidate& candidate) {
  Json json{{"rank", candidate.rank},
            {"planner", candidate.planner},
            {"seed", candidate.seed},
            {"file", candidate_file(candidate.rank, "csv")},
            {"length_m", candidate.length_m},
            {"duration_s", candidate.duration_s},
            {"energy_j", candidate.energy_j},
            {"margin_min", candidate.margin_min},
            {"margin_worst_tenth", candidate.margin_worst_tenth},
            {"limiting", limiting_json(candidate.limiting)},
            {"off_doubtful_soils", candidate.off_doubtful_soils},
            {"improved", improved_json(candidate.improvement)},
            {"verified",
             {{"margin_min", candidate.verified.margin_min},
              {"max_deviation_m", candidate.verified.deviation_max_m}}}};
  add_spread(json, candidate.spread);
  return json;
}

Json overturned_json(const Candidate& candidate) {
  return {{"planner", candidate.planner},
          {"seed", candidate.seed},
          {"reason", candidate.verified.reason},
          {"margin_min", candidate.verified.margin_min},
          {"max_deviation_m", candidate.verified.deviation_max_m}};
}

Json what_if_json(const WhatIf& what_if) {
  Json json{{"question", what_if.question},
            {"feasible", what_if.feasible},
            {"margin_min", what_if.margin_min}};
  if (what_if.reason) {
    json["rejected"] = name(*what_if.reason);
    json["x_m"] = what_if.x_m;
    json["y_m"] = what_if.y_m;
    json["time_s"] = what_if.time_s;
  }
  if (what_if.end_shift_m) json["end_shift_m"] = *what_if.end_shift_m;
  if (what_if.probability) {
    json["probability_feasible"] = what_if.probability->share;
    json["probability_feasible_ci95"] = {what_if.probability->low, what_if.probability->high};
  }
  return json;
}

Json number_json(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

template <class Items, class ToJson>
Json list_json(const Items& items, ToJson to_json) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(to_json(item));
  return list;
}

Json relaxed_json(const RelaxedAnswer& answer) {
  Json json{{"given_up", answer.given_up}, {"opens", answer.opened.has_value()}};
  if (answer.opened) {
    json["margin_min"] = number_json(answer.opened->margin_min);
    json["length_m"] = answer.opened->length_m;
    json["duration_s"] = answer.opened->duration_s;
  }
  return json;
}

std::string soil_name(const PlanningProblem& problem, int soil) {
  return soil < 0 ? "" : problem.map.soils().at(static_cast<std::size_t>(soil)).name;
}

/// How GeoJSON names the CRS that WKT ends by naming (`ID["EPSG",32633]]`), else the WKT itself,
/// which GDAL reads as well.
Json crs_json(const std::string& wkt) {
  if (wkt.empty()) return nullptr;
  static const std::regex epsg(R"re((?:ID|AUTHORITY)\["EPSG","?(\d+)"?\]\]\s*$)re");
  std::smatch code;
  const std::string crs_name = std::regex_search(wkt, code, epsg)
                                   ? fmt::format("urn:ogc:def:crs:EPSG::{}", code[1].str())
                                   : wkt;
  return {{"type", "name"}, {"properties", {{"name", crs_name}}}};
}

/// What a repeated plan has in common with the earlier one; null where it repeats none.
Json again_json(const PlanOrigin& origin, const Json& candidates,
                const std::filesystem::path& folder) {
  if (!origin.again) return nullptr;
  return {{"file", seen_from(folder, origin.again->file)},
          {"changed", changes_since(*origin.again, origin.inputs)},
          {"same_candidates", candidates.dump() == origin.again->candidates}};
}

}  // namespace

std::string plan_json(const PlanningProblem& problem, const PlanResult& result,
                      const PlanOrigin& origin, const std::filesystem::path& folder) {
  Json rejected = Json::object();
  for (int i = 0; i < kRejectionCount; ++i) {
    rejected[std::string(name(static_cast<Rejection>(i)))] =
        result.rejected.at(static_cast<std::size_t>(i));
  }
  const std::vector<bool> pareto = pareto_best(result.candidates);
  Json candidates = Json::array();
  for (std::size_t i = 0; i < pareto.size(); ++i) {
    candidates.push_back(candidate_json(result.candidates[i]));
    candidates.back()["pareto"] = static_cast<bool>(pareto[i]);
  }
  Json json{{"status", name(result.status)},
            {"reason", result.reason},
            {"certificate", result.certificate ? Json(*result.certificate) : Json(nullptr)},
            {"candidates", candidates},
            {"rejected", rejected},
            {"propagations", result.propagations},
            {"before_search", list_json(result.before_search, timed_step_json)},
            {"planning_time_s", result.planning_time_s},
            {"verification_time_s", result.verification_time_s},
            {"first_verified_s", number_json(result.first_verified_s)},
            {"least_duration_s", number_json(result.least_duration_s)},
            {"fastest_duration_s", number_json(fastest_duration_s(result))},
            {"gap", number_json(duration_gap(result))},
            {"seed", result.seed},
            {"version", REGOPLAN_VERSION},
            {"interrupted", result.interrupted},
            {"planner", problem.search.planner},
            {"vehicle", problem.vehicle.name},
            {"model", variant_name(problem.wheel_variant)},
            {"gravity_mps2", problem.gravity_mps2},
            {"speed_max_mps", problem.speed_max_mps},
            {"limits", limits_json(problem.limits)},
            {"objective", objective_json(problem.search.objective)},
            {"settings", effective_settings(problem)},
            {"inputs", inputs_json(origin.inputs, folder)},
            {"again", again_json(origin, candidates, folder)},
            {"doubtful_soils", result.doubtful_soils},
            {"overturned", list_json(result.overturned, overturned_json)},
            {"what_ifs", list_json(result.what_ifs, what_if_json)},
            {"relaxed", list_json(result.relaxed, relaxed_json)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string candidate_csv(const PlanningProblem& problem, const Candidate& candidate) {
  std::string text =
      "time_s,x_m,y_m,z_m,yaw_deg,speed_mps,yaw_rate_rad_s,steer_deg,slip_max,"
      "slip_angle_max_deg,sinkage_max_m,soil,demand_n,supply_min_n,supply_max_n,"
      "cornering_margin,tip_over_margin,traction_margin,margin,curvature_1pm,acceleration_mps2,"
      "torque_max_nm,energy_j\n";
  for (const TrajectoryPoint& point : candidate.points) {
    for (const double value :
         {point.time_s, point.x_m, point.y_m, point.z_m, degrees(point.yaw_rad), point.speed_mps,
          point.yaw_rate_rad_s, degrees(point.steer_rad), point.slip_max,
          degrees(point.slip_angle_max_rad), point.sinkage_max_m}) {
      text += fmt::format("{},", number_cell(value));
    }
    text += own_text_cell(soil_name(problem, point.soil));
    for (const double value :
         {point.demand_n, point.supply_min_n, point.supply_max_n, point.cornering_margin,
          point.tip_over_margin, point.traction_margin, point.margin, point.curvature_1pm,
          point.acceleration_mps2, point.torque_max_nm, point.energy_j}) {
      text += fmt::format(",{}", number_cell(value));
    }
    text += "\n";
  }
  return text;
}

std::string candidate_geojson(const PlanningProblem& problem, const Candidate& candidate) {
  Json coordinates = Json::array();
  for (const TrajectoryPoint& point : candidate.points) {
    coordinates.push_back(Json::array({point.x_m, point.y_m, point.z_m}));
  }
  const Json feature{{"type", "Feature"},
                     {"properties", candidate_json(candidate)},
                     {"geometry", {{"type", "LineString"}, {"coordinates", coordinates}}}};
  const Json json{{"type", "FeatureCollection"},
                  {"name", fmt::format("candidate-{}", candidate.rank)},
                  {"crs", crs_json(problem.map.elevation().frame.crs_wkt)},
                  {"features", Json::array({feature})}};
  return json.dump() + "\n";
}

namespace {

void write_rasters(const TerrainRasters& rasters, StagedFiles& staged) {
  write_bands(rasters.frame,
              {{.description = "stability margin of driving straight on, smallest over headings",
                .values = rasters.margin}},
              staged.path(kMarginFile));
  std::vector<RasterBand> supply;
  for (std::size_t i = 0; i < rasters.speeds_mps.size(); ++i) {
    supply.push_back(
        {.description = fmt::format("lateral supply in the tightest safe turn at {} m/s, newtons",
                                    rasters.speeds_mps[i]),
         .values = rasters.supply_n[i]});
  }
  write_bands(rasters.frame, supply, staged.path(kSupplyFile));
  if (rasters.probability.empty()) return;
  write_bands(rasters.frame,
              {{.description = "share of the soils' draws in which driving straight on keeps the "
                               "least margin in every direction",
                .values = rasters.probability}},
              staged.path(kProbabilityFile));
}

}  // namespace

std::vector<std::string> plan_file_names(const PlanningProblem& problem) {
  std::vector<std::string> names{"plan.json", "report.html", kMarginFile, kSupplyFile,
                                 kProbabilityFile};
  for (int rank = 1; rank <= problem.search.candidates; ++rank) {
    for (const char* extension : {"csv", "geojson"})
      names.push_back(candidate_file(rank, extension));
  }
  return names;
}

void write_plan_files(const PlanningProblem& problem, const PlanResult& result,
                      const ResultFolder& folder, const PlanOrigin& origin) {
  std::vector<RenderedFile> files{{"report.html", plan_report(problem, result)}};
  for (const Candidate& candidate : result.candidates) {
    files.push_back({candidate_file(candidate.rank, "csv"), candidate_csv(problem, candidate)});
    files.push_back(
        {candidate_file(candidate.rank, "geojson"), candidate_geojson(problem, candidate)});
  }
  files.push_back({"plan.json", plan_json(problem, result, origin,
                                          folder.path)});  // last: it speaks for the others
  StagedFiles staged(folder);
  if (result.rasters) write_rasters(*result.rasters, staged);
  for (const RenderedFile& file : files) staged.write(file);
  staged.commit();
  for (const char* raster : {kMarginFile, kSupplyFile}) {
    if (!result.rasters) staged.remove(raster);
  }
  if (!result.rasters || result.rasters->probability.empty()) staged.remove(kProbabilityFile);
  for (std::size_t rank = result.candidates.size() + 1;; ++rank) {
    bool found = false;
    for (const std::string_view extension : {"csv", "geojson"}) {
      found |= staged.remove(candidate_file(static_cast<int>(rank), extension));
    }
    if (!found) break;
  }
}

}  // namespace regoplan
