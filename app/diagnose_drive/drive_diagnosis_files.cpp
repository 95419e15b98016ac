#include "app/diagnose_drive/drive_diagnosis_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/diagnose_drive/drive_diagnosis_report.h"
#include "drive_diagnosis/corrected_world.h"
#include "drive_diagnosis/drive_claims.h"
#include "drive_diagnosis/silent_effects.h"
#include "terramech/basics/angles.h"
#include "terramech/tables/csv_cells.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;
Json estimate_json(const DriveEstimate& estimate) {
  return {{"value", estimate.value}, {"std", estimate.std}};
}

Json degrees_json(const std::optional<DriveEstimate>& estimate) {
  if (!estimate) return nullptr;
  return {{"value", estimate->value / kDegree}, {"std", estimate->std / kDegree}};
}

Json claim_json(const DriveClaim& claim) {
  Json parameters = Json::object();
  for (const auto& [key, estimate] : claim.parameters) parameters[key] = estimate_json(estimate);
  Json instead = Json::array();
  for (const FaultEstimate& other : claim.instead) {
    instead.push_back({{"id", other.id},
                       {"parameter", other.parameter},
                       {"value", other.size.value},
                       {"std", other.size.std}});
  }
  return {{"id", claim.id},     {"parameters", parameters},   {"equivalent", claim.equivalent},
          {"instead", instead}, {"channels", claim.channels}, {"sigmas", claim.sigmas},
          {"text", claim.text}};
}

Json where_json(const DriveMismatch& at) {
  Json region = Json::object();
  for (const auto& [column, ends] : at.region) region[column] = ends;
  return {{"channel", at.channel}, {"where", at.where}, {"region", region},
          {"effect", at.effect},   {"ci95", at.ci95},   {"p_value", at.p_value}};
}

Json soil_json(const UncertainSoil& soil) {
  Json numbers = Json::object();
  for (const SoilParameter& parameter : soil_parameters()) {
    numbers[std::string(parameter.name)] = {
        {"mean", soil.mean.*parameter.member / parameter.file_unit},
        {"std", soil.standard_deviation.*parameter.member / parameter.file_unit}};
  }
  return numbers;
}

/// The map's soils that were driven on, as the map has them and as the drives tell them.
Json soils_json(const DriveDiagnosisRun& run, const VehicleEffects& effects) {
  Json soils = Json::object();
  const std::vector<MapSoil>& map = run.setup.setup.map.soils();
  for (const SoilFitted& fitted : effects.soils_fitted) {
    const MapSoil& said = map[fitted.soil];
    Json& soil = soils[said.name] = {{"map", soil_json(said.soil)},
                                     {"drives", soil_json(fitted.estimate)},
                                     {"held_out_nats", fitted.held_out_nats}};
    if (!fitted.is_handed_back()) soil["withheld"] = withheld_text(fitted, said);
  }
  return soils;
}

/// A zone with the soil that is there and the track through it.
Json zone_json(const DriveDiagnosisRun& run, const SoilZoneFound& zone) {
  Json track = Json::array();
  for (const MapPlace& place : zone_track(zone, run.diagnosis.windows)) {
    track.push_back({place.x_m, place.y_m});
  }
  const std::vector<MapSoil>& soils = run.setup.setup.map.soils();
  const MapSoil& said = soils[static_cast<std::size_t>(zone.soil)];
  return {
      {"drive", run.drive_ids[zone.drive]},
      {"map_soil", said.name},
      {"like", zone.like ? Json(soils[static_cast<std::size_t>(*zone.like)].name) : Json(nullptr)},
      {"resistance_share", estimate_json(zone.resistance)},
      {"track", track},
      {"starts_s", zone.starts_s},
      {"starts_ci95_s", zone.start_s},
      {"ends_s", zone.ends_s},
      {"ends_ci95_s", zone.end_s},
      {"soil", soil_json(zone.estimate)},
      {"soil_of_map", soil_json(said.soil)}};
}

Json zones_json(const DriveDiagnosisRun& run) {
  Json zones = Json::array();
  if (!run.diagnosis.effects) return zones;
  for (const VehicleFinding& finding : run.diagnosis.effects->found) {
    if (finding.zone) zones.push_back(zone_json(run, *finding.zone));
  }
  return zones;
}

Json finding_json(const DriveFinding& finding) {
  Json json = {{"id", finding.id}, {"drive", finding.drive}, {"text", finding.text}};
  if (finding.value) json["value"] = *finding.value;
  if (!finding.unit.empty()) json["unit"] = finding.unit;
  json["mended"] = finding.mended;
  return json;
}

Json currents_json(const DriveDiagnosisRun& run, const CurrentDiagnosis& currents) {
  const HeldOutCurrents& held_out = currents.held_out;
  Json charges = Json::array();
  for (const HeldOutCurrents::Charge& charge : held_out.charges) {
    charges.push_back({{"drive", run.drive_ids[charge.drive]},
                       {"measured_ah", charge.measured_ah},
                       {"predicted_ah", charge.predicted_ah},
                       {"constant_ah", charge.constant_ah}});
  }
  const auto side_json = [&](int side) {
    const CurrentModel::Terms& c = currents.model.sides.at(static_cast<std::size_t>(side));
    return Json{{"not_driven_a", c[0]},
                {"constant_a", c[1]},
                {"direction_a", c[2]},
                {"per_sin_pitch_a", c[3]},
                {"braking_per_sin_pitch_a", c[4]},
                {"turn_a", c[5]},
                {"either_turn_a", c[6]}};
  };
  Json json = {{"windows", currents.windows},
               {"model",
                {{"left", side_json(0)},
                 {"right", side_json(1)},
                 {"half_track_m", currents.model.half_track_m}}},
               {"held_out", held_out.held_out},
               {"rms_a", held_out.both_rms_a},
               {"constant_rms_a", held_out.both_constant_rms_a},
               {"charge_error_median", held_out.median_charge_error},
               {"constant_charge_error_median", held_out.median_constant_error},
               {"charges", charges},
               {"left_excess_a", estimate_json(currents.left_excess_a)},
               {"left_excess_ci95_a", currents.left_excess_ci95_a},
               {"gravity_ratio_left_right", estimate_json(currents.gravity_ratio)}};
  json["standing_excess_a"] =
      currents.standing_excess_a ? estimate_json(*currents.standing_excess_a) : Json(nullptr);
  return json;
}

Json fit_json(const DriveDiagnosis& diagnosis) {
  Json fit = Json::object();
  if (diagnosis.currents) {
    const HeldOutCurrents& held_out = diagnosis.currents->held_out;
    for (std::size_t side = 0; side < 2; ++side) {
      fit[side == 0 ? "current_left_a" : "current_right_a"] = {
          {"noise_floor", nullptr},
          {"baseline_rmse", held_out.constant_rms_a.at(side)},
          {"corrected_rmse", held_out.rms_a.at(side)},
          {"held_out", held_out.held_out}};
    }
  }
  if (diagnosis.effects) {
    const VehicleEffects& effects = *diagnosis.effects;
    for (std::size_t k = 0; k < effects.channels.size(); ++k) {
      fit[effects.channels[k]] = {{"noise_floor", effects.noise[k]},
                                  {"baseline_rmse", effects.rms[k]},
                                  {"corrected_rmse", effects.rms_after[k]},
                                  {"held_out", nullptr}};
    }
  }
  return fit;
}

/// The numbers of the vehicle that the setup says nobody knows well, as the drives tell them.
Json vehicle_json(const UncertainVehicle& vehicle) {
  Json json = Json::object();
  for (const auto& [key, number] : {std::pair{"mass_kg", vehicle.mass_kg},
                                    {"wheel_radius_m", vehicle.wheel_radius_m},
                                    {"motor_constant", vehicle.motor_constant}}) {
    if (number) json[key] = estimate_json(*number);
  }
  return json;
}

/// By id and parameter.
Json smallest_json(const std::vector<FaultShown>& faults) {
  Json json = Json::object();
  for (const FaultShown& fault : faults) json[fault.id][fault.parameter] = fault.least;
  return json;
}

Json windows_used_json(const WindowsUsed& used) {
  Json left_out = Json::object();
  for (std::size_t i = 0; i < kLeftOutReasons; ++i) {
    left_out[std::string(name(static_cast<LeftOut>(i)))] = used.left_out.at(i);
  }
  return {{"compared", used.compared},
          {"left_out", left_out},
          {"columns_missing", used.columns_missing}};
}

template <class Items, class ToJson>
Json list_json(const Items& items, ToJson to_json) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(to_json(item));
  return list;
}

}  // namespace

Json drive_diagnosis_content(const DriveDiagnosisRun& run) {
  const DriveDiagnosis& diagnosis = run.diagnosis;
  Json json = {{"kind", "drives"}, {"verdict", name(diagnosis.verdict)}};
  if (diagnosis.interrupted) json["interrupted"] = true;
  json["scenario"] = run.scenario_file;
  json["drives"] = Json::array();
  for (std::size_t i = 0; i < run.drive_ids.size(); ++i) {
    json["drives"].push_back({{"drive_id", run.drive_ids[i]},
                              {"file", run.drive_files[i]},
                              {"rows", run.drive_rows[i]}});
  }
  json["mechanisms"] = list_json(diagnosis.claims, claim_json);
  json["where"] = list_json(diagnosis.where, where_json);
  json["zones"] = zones_json(run);
  json["verdicts"] = list_json(run.verdicts, [&run](const VerdictFlip& flip) {
    return Json{{"drive", run.drive_ids[flip.drive]},
                {"starts_s", flip.starts_s},
                {"ends_s", flip.ends_s},
                {"x_m", flip.x_m},
                {"y_m", flip.y_m},
                {"before", flip.before},
                {"after", flip.after}};
  });
  json["findings"] = list_json(diagnosis.findings, finding_json);
  json["fit"] = fit_json(diagnosis);
  if (diagnosis.currents) json["currents"] = currents_json(run, *diagnosis.currents);
  if (diagnosis.effects) {
    json["vehicle"] = vehicle_json(diagnosis.effects->vehicle);
    json["soils"] = soils_json(run, *diagnosis.effects);
  }
  json["mounting"] = list_json(diagnosis.mountings, [](const Mounting& day) {
    return Json{{"day", day.day},
                {"pitch_deg", degrees_json(day.pitch_rad)},
                {"roll_deg", degrees_json(day.roll_rad)},
                {"windows", day.windows}};
  });
  json["not_shown"] = list_json(diagnosis.silent, [](const SilentEffect& silent) {
    return Json{{"ids", silent.ids}, {"why", silent.why}, {"next_drive", silent.drive}};
  });
  if (diagnosis.effects) {
    json["smallest_detectable"] = smallest_json(diagnosis.effects->faults_shown);
  }
  json["windows"] = diagnosis.windows.size();
  if (diagnosis.windows_used) json["windows_used"] = windows_used_json(*diagnosis.windows_used);
  json["share_on_map"] = diagnosis.share_on_map;
  json["seed"] = run.seed;
  return json;
}

std::string drive_diagnosis_json(const DriveDiagnosisRun& run) {
  return drive_diagnosis_content(run).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<const ComparedChannel*> compared_channels(const DriveDiagnosis& diagnosis) {
  std::vector<const ComparedChannel*> channels;
  const auto add = [&channels](const std::vector<ComparedChannel>& more) {
    for (const ComparedChannel& channel : more) channels.push_back(&channel);
  };
  if (diagnosis.currents) add(diagnosis.currents->compared);
  if (diagnosis.effects) add(diagnosis.effects->compared);
  return channels;
}

namespace {

constexpr std::array<std::pair<const char*, std::vector<double> ComparedChannel::*>, 3>
    kComparedColumns{{{"measured", &ComparedChannel::measured},
                      {"model", &ComparedChannel::model},
                      {"corrected", &ComparedChannel::corrected}}};

/// Every window, with what was compared in it; cells are empty where nothing was.
std::string windows_csv(const DriveDiagnosisRun& run) {
  std::string text =
      "drive_id,start_s,end_s,x_m,y_m,yaw_deg,speed_mps,acceleration_mps2,yaw_rate_rad_s,"
      "pitch_deg,roll_deg";
  const std::vector<const ComparedChannel*> channels = compared_channels(run.diagnosis);
  const std::vector<DriveWindow>& windows = run.diagnosis.windows;
  std::vector<std::vector<double>> added;
  for (const ComparedChannel* channel : channels) {
    for (const auto& [prefix, values] : kComparedColumns) {
      text += fmt::format(",{}_{}", prefix, channel->name);
      std::vector<double>& column = added.emplace_back(windows.size(), kNotSampled);
      for (std::size_t i = 0; i < (channel->*values).size(); ++i) {
        column[channel->windows[i]] = (channel->*values)[i];
      }
    }
  }
  text += '\n';
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const DriveWindow& window = windows[w];
    text += text_cell(run.drive_ids[window.drive]);
    const auto add = [&text](double value) {
      text += ',';
      text += number_cell(value);
    };
    for (const double value :
         {window.start_s, window.end_s, window.x_m, window.y_m, window.yaw_rad / kDegree,
          window.speed_mps, window.acceleration_mps2, window.yaw_rate_rad_s,
          window.pitch_rad / kDegree, window.roll_rad / kDegree}) {
      add(value);
    }
    for (const std::vector<double>& column : added) add(column[w]);
    text += '\n';
  }
  return text;
}

}  // namespace

std::string drive_diagnosis_summary(const DriveDiagnosisRun& run) {
  const DriveDiagnosis& diagnosis = run.diagnosis;
  std::string text = drive_diagnosis_headline(run) + "\n";
  if (const auto what = what_would_decide(diagnosis)) text += *what + "\n";
  for (const DriveClaim& claim : diagnosis.claims) {
    text += fmt::format("  {}: {}\n", fmt::join(claim.equivalent, " | "), claim.text);
  }
  if (const auto nearest = nearest_text(diagnosis)) text += "  " + *nearest + "\n";
  for (const std::string& withheld : withheld_texts(run)) text += "  " + withheld + "\n";
  if (diagnosis.currents) {
    const HeldOutCurrents& held_out = diagnosis.currents->held_out;
    text += fmt::format(
        "currents, each {} held out: {:.2f} A RMS (a constant: {:.2f}), charge of a drive within "
        "{:.1f} % in the median (a constant: {:.1f} %)\n",
        held_out.held_out, held_out.both_rms_a, held_out.both_constant_rms_a,
        100 * held_out.median_charge_error, 100 * held_out.median_constant_error);
  }
  return text;
}

std::vector<std::string> drive_diagnosis_file_names(const std::string& page) {
  return {"diagnosis.json", "windows.csv", page};
}

void write_drive_diagnosis_files(const DriveDiagnosisRun& run, const ResultFolder& folder) {
  StagedFiles files(folder);
  files.write({"diagnosis.json", drive_diagnosis_json(run)});
  files.write({"windows.csv", windows_csv(run)});
  files.write({run.page, drive_diagnosis_report(run)});
  files.commit();
}

}  // namespace regoplan
