#include "app/evaluate/evaluation_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/evaluate/evaluation_report.h"
#include "app/io/staged_files.h"
#include "app/settings/earlier_plan.h"
#include "app/settings/effective_settings.h"
#include "app/settings/model_settings.h"
#include "planner/problem/rejection_text.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

Json refusal_json(const Refusal& refusal) {
  const RejectedQuantity& counted = quantity(refusal.reason);
  const auto shown = [&](double Exceeded::*number) {
    return refusal.exceeded ? Json((*refusal.exceeded).*number / counted.si_per_shown)
                            : Json(nullptr);
  };
  return {{"reason", name(refusal.reason)},
          {"when", refusal.while_stopping   ? "stopping"
                   : refusal.while_tracking ? "driven"
                                            : "commanded"},
          {"x_m", refusal.x_m},
          {"y_m", refusal.y_m},
          {"distance_m", refusal.s_m},
          {"time_s", refusal.time_s},
          {"value", shown(&Exceeded::found)},
          {"limit", shown(&Exceeded::limit)},
          {"unit", counted.unit}};
}

Json limiting_json(const PathEvaluation& evaluation) {
  const LimitingPlace& place = evaluation.limiting;
  Json json{{"margin", name(place.margin)},
            {"x_m", place.x_m},
            {"y_m", place.y_m},
            {"time_s", place.time_s}};
  if (const auto& limit = evaluation.cornering_limit) {
    json["supply_ends_by"] = name(limit->limit);
    json["wheel"] = limit->wheel.empty() ? Json(nullptr) : Json(limit->wheel);
    json["supply_n"] = limit->supply_n;
    json["fold_n"] = limit->fold_n ? Json(*limit->fold_n) : Json(nullptr);
  }
  return json;
}

Json margins_json(const PathMargins& margins) {
  return {{"cornering", margins.cornering},
          {"tip_over", margins.tip_over},
          {"traction", margins.traction}};
}

Json quantiles_json(const Quantiles& quantiles) {
  return {{"p05", quantiles.p05}, {"p50", quantiles.p50}, {"p95", quantiles.p95}};
}

Json tracking_json(const PathEvaluation& evaluation) {
  const TrackingRun& run = evaluation.tracking;
  return {{"arrived", run.end == TrackingEnd::kArrived},
          {"max_deviation_m", run.deviation_max_m},
          {"max_deviation_at", {{"x_m", run.deviation_at.x_m}, {"y_m", run.deviation_at.y_m}}},
          {"deviation_allowed_m", evaluation.deviation_allowed_m},
          {"duration_s", run.duration_s},
          {"energy_j", run.energy_j},
          {"slip_max", run.strain_max.slip},
          {"slip_angle_max_deg", degrees(run.strain_max.slip_angle_rad)},
          {"sinkage_max_m", run.strain_max.sinkage_m},
          {"step_s", run.step_s}};
}

Json soil_draws_json(const SoilSpread& spread) {
  return {{"draws", spread.draws},
          {"by_wheel_model", spread.direct_draws},
          {"places", spread.places},
          {"surrogate_error", margins_json(spread.surrogate_error)}};
}

Json path_json(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  Json influences = Json::array();
  for (const SoilInfluence& influence : e.spread.influences) {
    influences.push_back({{"soil", influence.soil},
                          {"parameter", influence.parameter},
                          {"share", influence.share},
                          {"margin_per_std", influence.margin_per_std}});
  }
  Json json{{"rank", e.rank}};
  json[path.plane ? "manoeuvre" : "file"] = e.name;
  json.update(Json{
      {"vehicle", path.vehicle},
      {"feasible", e.feasible},
      {"reason", e.refusal ? Json(sentence(*e.refusal)) : Json(nullptr)},
      {"refusal", e.refusal ? refusal_json(*e.refusal) : Json(nullptr)},
      {"limiting", limiting_json(e)},
      {"length_m", e.length_m},
      {"duration_s", e.duration_s},
      {"speed_max_mps", e.speed_max_mps},
      {"energy_j", e.tracking.energy_j},
      {"margin_min", e.margin_min},
      {"margin_p05", e.spread.margin.p05},
      {"margin_p05_ci95", {e.spread.margin_p05_interval.low, e.spread.margin_p05_interval.high}},
      {"margin_worst_tenth", e.margin_worst_tenth},
      {"margins", margins_json(e.margins)},
      {"quantiles",
       {{"cornering", quantiles_json(e.spread.cornering)},
        {"tip_over", quantiles_json(e.spread.tip_over)},
        {"traction", quantiles_json(e.spread.traction)},
        {"margin", quantiles_json(e.spread.margin)}}},
      {"probability_feasible", e.spread.feasible.share},
      {"probability_feasible_ci95", {e.spread.feasible.low, e.spread.feasible.high}},
      {"sensitivity", influences},
      {"sensitivity_explained", e.spread.explained},
      {"soil_draws", soil_draws_json(e.spread)},
      {"tracked", tracking_json(e)}});
  if (path.recorded_margin_min) {
    json["recorded"] = {{"margin_min", *path.recorded_margin_min},
                        {"difference", e.margin_min - *path.recorded_margin_min}};
  }
  return json;
}

/// What paths are judged by, under the keys of a scenario where it has them. Where the vehicle
/// starts and what a search is given say nothing of a path.
Json settings_json(const PlanningProblem& problem, const EvaluationResult& result) {
  Json json = effective_settings(problem);
  for (const char* key : {"start", "goal", "planner"}) json.erase(key);
  Json vehicles = Json::object();
  for (const Vehicle& vehicle : result.vehicles)
    vehicles[vehicle.name] = vehicle_file_json(vehicle);
  const EvaluationSettings& settings = result.settings;
  json["speed_mps"]["max"] = result.speed_max_mps;
  json["manoeuvre_vehicles"] = vehicles;
  json["follower"] = name(settings.follower.kind);
  json["deviation_max_m"] =
      settings.deviation_max_m ? Json(*settings.deviation_max_m) : Json(nullptr);
  json["soil_draws"] = settings.soil_draws;
  json["seed"] = settings.seed;
  return json;
}

}  // namespace

bool EvaluationResult::any_feasible() const {
  return std::ranges::any_of(paths, [](const EvaluatedPath& p) { return p.evaluation.feasible; });
}

void rank(EvaluationResult& result) {
  std::vector<Standing> standings;
  for (const EvaluatedPath& path : result.paths) standings.push_back(standing_of(path.evaluation));
  std::vector<EvaluatedPath> ranked;
  for (const std::size_t i : rank_order(standings)) {
    ranked.push_back(std::move(result.paths[i]));
    ranked.back().evaluation.rank = static_cast<int>(ranked.size());
  }
  result.paths = std::move(ranked);
}

std::string steering_law_text(const SteeringLaw& law) {
  return fmt::format(
      "commanded curvature = path curvature {} s ahead - offset/L^2 - {:g} (course - path "
      "heading)/L"
      ", L = the longer of {:g} wheelbases and {:g} s of way; rim speed = path speed over the "
      "ratio "
      "of speed and rim speed, averaged over {:g} s",
      law.reaction_s, 2 * law.damping, law.lookahead_wheelbases, law.lookahead_s,
      law.slip_memory_s);
}

std::string evaluation_json(const PlanningProblem& problem, const EvaluationResult& result,
                            const std::filesystem::path& folder) {
  Json paths = Json::array();
  for (const EvaluatedPath& path : result.paths) paths.push_back(path_json(path));
  const SteeringLaw& law = result.settings.follower.law;
  const Json json{{"status", result.any_feasible() ? "feasible" : "infeasible"},
                  {"paths", paths},
                  {"follower", name(result.settings.follower.kind)},
                  {"steering_law",
                   {{"text", steering_law_text(law)},
                    {"lookahead_wheelbases", law.lookahead_wheelbases},
                    {"lookahead_s", law.lookahead_s},
                    {"damping", law.damping},
                    {"reaction_s", law.reaction_s},
                    {"slip_memory_s", law.slip_memory_s}}},
                  {"limits", limits_json(problem.limits)},
                  {"vehicle", problem.vehicle.name},
                  {"model", variant_name(problem.wheel_variant)},
                  {"gravity_mps2", problem.gravity_mps2},
                  {"settings", settings_json(problem, result)},
                  {"inputs", inputs_json(result.inputs, folder)},
                  {"seed", result.settings.seed},
                  {"evaluation_time_s", result.evaluation_time_s},
                  {"version", REGOPLAN_VERSION},
                  {"interrupted", result.interrupted}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_evaluation_files(const PlanningProblem& problem, const EvaluationResult& result,
                            const ResultFolder& folder) {
  const RenderedFile report{"report.html", evaluation_report(problem, result)};
  const RenderedFile json{"evaluation.json", evaluation_json(problem, result, folder.path)};
  StagedFiles staged(folder);
  staged.write(report);
  staged.write(json);
  staged.commit();
}

}  // namespace regoplan
