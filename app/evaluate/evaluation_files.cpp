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

/// Null where the path has no margins.
Json limiting_json(const PathEvaluation& evaluation) {
  if (!evaluation.spread) return nullptr;
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

Json margins_json(const std::optional<PathMargins>& margins) {
  const auto of = [&](double PathMargins::*margin) {
    return margins ? Json((*margins).*margin) : Json(nullptr);
  };
  return {{"cornering", of(&PathMargins::cornering)},
          {"tip_over", of(&PathMargins::tip_over)},
          {"traction", of(&PathMargins::traction)}};
}

Json quantiles_json(const std::optional<SoilSpread>& spread, Quantiles SoilSpread::*margin) {
  const auto of = [&](double Quantiles::*quantile) {
    return spread ? Json((*spread).*margin.*quantile) : Json(nullptr);
  };
  return {{"p05", of(&Quantiles::p05)}, {"p50", of(&Quantiles::p50)}, {"p95", of(&Quantiles::p95)}};
}

Json interval_json(double low, double high) {
  return Json::array({low, high});
}

/// What is told of a path that has margins everywhere; null where it has not.
Json margins_of_path_json(const PathEvaluation& e) {
  const auto& spread = e.spread;
  const auto interval_of = [&](QuantileInterval SoilSpread::*of) {
    return spread ? interval_json(((*spread).*of).low, ((*spread).*of).high) : Json(nullptr);
  };
  const auto of_path = [&](const auto& value) { return spread ? Json(value) : Json(nullptr); };
  Json influences = Json::array();
  if (spread) {
    for (const SoilInfluence& influence : spread->influences) {
      influences.push_back({{"soil", influence.soil},
                            {"parameter", influence.parameter},
                            {"share", influence.share},
                            {"margin_per_std", influence.margin_per_std}});
    }
  }
  return {{"margin_min", of_path(e.margin_min)},
          {"margin_p05", spread ? Json(spread->margin.p05) : Json(nullptr)},
          {"margin_p05_ci95", interval_of(&SoilSpread::margin_p05_interval)},
          {"margin_p50", spread ? Json(spread->margin.p50) : Json(nullptr)},
          {"margin_p50_ci95", interval_of(&SoilSpread::margin_p50_interval)},
          {"margin_worst_tenth", of_path(e.margin_worst_tenth)},
          {"margins", margins_json(spread ? std::optional(e.margins) : std::nullopt)},
          {"quantiles",
           {{"cornering", quantiles_json(spread, &SoilSpread::cornering)},
            {"tip_over", quantiles_json(spread, &SoilSpread::tip_over)},
            {"traction", quantiles_json(spread, &SoilSpread::traction)},
            {"margin", quantiles_json(spread, &SoilSpread::margin)}}},
          {"probability_feasible", spread ? Json(spread->feasible.share) : Json(nullptr)},
          {"probability_feasible_ci95",
           spread ? interval_json(spread->feasible.low, spread->feasible.high) : Json(nullptr)},
          {"sensitivity", influences},
          {"sensitivity_explained", spread ? Json(spread->explained) : Json(nullptr)}};
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

Json soil_draws_json(const std::optional<SoilSpread>& spread) {
  return {{"draws", spread ? spread->draws : 0},
          {"by_wheel_model", spread ? spread->direct_draws : 0},
          {"places", spread ? spread->places : 0},
          {"surrogate_error",
           margins_json(spread ? std::optional(spread->surrogate_error) : std::nullopt)}};
}

Json path_json(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  Json json{{"rank", e.rank}};
  json[path.plane ? "manoeuvre" : "file"] = e.name;
  json.update(
      Json{{"vehicle", path.vehicle},
           {"feasible", e.feasible},
           {"reason", e.refusal ? Json(sentence(*e.refusal)) : Json(nullptr)},
           {"refusal", e.refusal ? refusal_json(*e.refusal) : Json(nullptr)},
           {"limiting", limiting_json(e)},
           {"length_m", e.length_m},
           {"duration_s", e.duration_s},
           {"speed_max_mps", e.speed_max_mps},
           {"energy_j", e.tracking.duration_s > 0 ? Json(e.tracking.energy_j) : Json(nullptr)}});
  json.update(margins_of_path_json(e));
  json.update(Json{{"soil_draws", soil_draws_json(e.spread)}, {"tracked", tracking_json(e)}});
  if (path.recorded_margin_min) {
    json["recorded"] = {
        {"margin_min", *path.recorded_margin_min},
        {"difference", e.spread ? Json(e.margin_min - *path.recorded_margin_min) : Json(nullptr)}};
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

PlanStatus EvaluationResult::status() const {
  if (any_feasible()) return PlanStatus::kFeasible;
  return interrupted ? PlanStatus::kUndecided : PlanStatus::kInfeasible;
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
  const Json json{{"status", name(result.status())},
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
