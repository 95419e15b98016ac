#include "app/demo/loop_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/page/report_assets.h"
#include "app/page/report_map.h"
#include "app/page/report_page.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

/// What `drive.json` says of a drive that counts before and after.
Json drive_content(const DriveRecord& record, const PlanningProblem& problem) {
  const Json whole = Json::parse(drive_json(record, problem));
  Json json;
  for (const char* key : {"status", "reason", "limits_broken", "margins_min", "cross_track_rms_m",
                          "duration_s", "length_m", "energy_j"}) {
    json[key] = whole.at(key);
  }
  return json;
}

Json verdict_content(const PathEvaluation& evaluation) {
  const auto& spread = evaluation.spread;
  return {{"feasible", evaluation.feasible},
          {"holds", VerdictChange::holds(evaluation)},
          {"why", evaluation.refusal ? sentence(*evaluation.refusal) : ""},
          {"margin_min", spread ? number(evaluation.margin_min) : Json()},
          {"probability_margins",
           spread && spread->draws > 0 ? number(spread->feasible.share) : Json()}};
}

Json verdicts_content(const ClosedLoop& loop) {
  Json rows = Json::array();
  for (const VerdictChange& change : loop.verdicts) {
    rows.push_back({{"candidate", change.candidate},
                    {"flips", change.flips()},
                    {"before", verdict_content(change.before)},
                    {"after", verdict_content(change.after)}});
  }
  return rows;
}

/// A number of the patch's soil: what is hidden, what the drive tells, what the map says.
Json soil_content(const HiddenPatch& hidden, const SoilZoneFound* zone,
                  const PlanningProblem& known) {
  Json rows = Json::array();
  const std::pair<const char*, double> numbers[] = {
      {"friction_angle_deg", hidden.friction_angle_deg},
      {"cohesion_pa", hidden.cohesion_pa},
      {"kc", hidden.kc},
      {"kphi", hidden.kphi}};
  const auto soil_there = known.map.soil_index(hidden.x_m, hidden.y_m);
  for (const auto& [key, value] : numbers) {
    const auto parameter =
        std::ranges::find(soil_parameters(), std::string_view(key), &SoilParameter::name);
    Json row{{"number", key}, {"hidden", value}, {"map", nullptr}, {"found", nullptr}};
    if (soil_there) {
      const Soil& said = known.map.soils()[static_cast<std::size_t>(*soil_there)].soil.mean;
      row["map"] = said.*parameter->member / parameter->file_unit;
    }
    if (zone) {
      row["found"] = {
          {"mean", zone->estimate.mean.*parameter->member / parameter->file_unit},
          {"std", zone->estimate.standard_deviation.*parameter->member / parameter->file_unit}};
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The first zone that the diagnosis found; null where it found none.
const SoilZoneFound* zone_found(const ClosedLoop& loop) {
  const auto& effects = loop.diagnosis.diagnosis.effects;
  if (!effects) return nullptr;
  const auto zone = std::ranges::find_if(
      effects->found, [](const VehicleFinding& finding) { return finding.zone.has_value(); });
  return zone == effects->found.end() ? nullptr : &*zone->zone;
}

Json loop_content(const ClosedLoop& loop, const PlanningProblem& known) {
  const Json diagnosis = drive_diagnosis_content(loop.diagnosis);
  Json hidden{{"x_m", loop.hidden.x_m},
              {"y_m", loop.hidden.y_m},
              {"radius_m", loop.hidden.radius_m},
              {"soil", soil_content(loop.hidden, zone_found(loop), known)}};
  Json tracks = Json::array();
  for (const Json& zone : diagnosis.at("zones")) tracks.push_back(zone.at("track"));
  return {{"kind", "loop"},
          {"hidden_patch", hidden},
          {"diagnosis", {{"verdict", diagnosis.at("verdict")}, {"zones", tracks}}},
          {"verdicts", verdicts_content(loop)},
          {"second_plan",
           {{"status", name(loop.second_plan.status)}, {"reason", loop.second_plan.reason}}},
          {"first_drive", drive_content(loop.first, known)},
          {"second_drive", loop.second ? drive_content(*loop.second, known) : Json()},
          {"seed", loop.first.settings.seed},
          {"version", REGOPLAN_VERSION}};
}

/// Places of a drive every half second at least: x_m, y_m, way_m, smallest true margin.
Json points(const DriveResult& result) {
  Json rows = Json::array();
  const std::size_t step = std::max<std::size_t>(1, result.moments.size() / 1000);
  std::size_t margin = 0;
  double way_m = 0;
  for (std::size_t i = 0; i < result.moments.size(); ++i) {
    const DriveMoment& moment = result.moments[i];
    if (i > 0) {
      const VehicleState& before = result.moments[i - 1].state;
      way_m += std::hypot(moment.state.x_m - before.x_m, moment.state.y_m - before.y_m);
    }
    if (i % step != 0) continue;
    while (margin + 1 < result.margins.size() &&
           result.margins[margin + 1].time_s <= moment.time_s) {
      ++margin;
    }
    const double smallest =
        result.margins.empty() ? std::nan("") : result.margins[margin].smallest();
    rows.push_back({moment.state.x_m, moment.state.y_m, way_m, number(smallest)});
  }
  return rows;
}

std::string loop_report(const ClosedLoop& loop, const PlanningProblem& known) {
  Json data = loop_content(loop, known);
  data["map"] = report_map(known.map, {.cells_a_side = 400, .rocks = 4000});
  Json corners = Json::array();
  for (const PathPoint& corner : loop.hidden.corners()) corners.push_back({corner.x_m, corner.y_m});
  data["corners"] = std::move(corners);
  data["margin_min_allowed"] = known.limits.margin_min;
  data["paths"] = {{"first", points(loop.first.result)},
                   {"second", loop.second ? points(loop.second->result) : Json::array()}};
  std::vector<std::string> lead;
  for (const DriveClaim& claim : loop.diagnosis.diagnosis.claims) {
    lead.push_back(fmt::format("{}: {}.", claim.id, claim.text));
  }
  return render({.command = "demo",
                 .title = "Plan, drive, diagnosis, plan again",
                 .headline = loop_headline(loop),
                 .lead = lead,
                 .body_html = report_assets::kLoopHtml,
                 .script = report_assets::kLoopScript,
                 .data_json = json_for_html(data)});
}

std::string broken_words(const DriveRecord& record) {
  const DriveResult& result = record.result;
  const std::size_t broken = result.broken.size();
  if (!result.reached) return "did not reach its goal";
  if (broken == 0) return "kept within every limit";
  return fmt::format("broke {} limit{}", broken, broken == 1 ? "" : "s");
}

}  // namespace

std::string loop_headline(const ClosedLoop& loop) {
  const std::string first =
      fmt::format("The best path {} on ground that hid a weak patch; ", broken_words(loop.first));
  if (!loop.second) {
    return first + fmt::format("planned again over what that drive told: {}.",
                               name(loop.second_plan.status));
  }
  return first +
         fmt::format("planned again over what that drive told, it {}.", broken_words(*loop.second));
}

std::string loop_json(const ClosedLoop& loop, const PlanningProblem& known) {
  return loop_content(loop, known).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> loop_file_names() {
  return {"loop.json", "report.html"};
}

void write_loop_files(const PlanningProblem& known, const ClosedLoop& loop,
                      const ResultFolder& folder) {
  StagedFiles files(folder);
  files.write({"loop.json", loop_json(loop, known)});
  files.write({"report.html", loop_report(loop, known)});
  files.commit();
}

}  // namespace regoplan
