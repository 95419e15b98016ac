#include "app/diagnose/diagnosis_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "app/diagnose/diagnosis_report.h"
#include "app/io/staged_files.h"
#include "app/settings/model_settings.h"
#include "diagnosis/fit/effect.h"
#include "terramech/tables/csv_cells.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

template <class Items, class ToJson>
Json list_json(const Items& items, ToJson to_json) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(to_json(item));
  return list;
}

/// A parameter that was not fitted has no spread, and says why.
Json estimate_json(const Estimate& estimate) {
  Json json = {{"value", estimate.value}, {"std", estimate.standard_deviation}};
  if (estimate.standard_deviation <= 0) json["fixed"] = true;
  return json;
}

/// A soil number as settings files write it.
Json soil_number_json(const Estimate& estimate) {
  return {{"mean", estimate.value}, {"std", estimate.standard_deviation}};
}

Json channels_json(const std::vector<Channel>& channels) {
  return list_json(channels, [](Channel channel) { return name(channel); });
}

Json share_json(const std::optional<Share>& share) {
  if (!share) return {{"explained", nullptr}, {"low", nullptr}, {"high", nullptr}};
  return {{"explained", share->explained}, {"low", share->low}, {"high", share->high}};
}

Json claim_json(const Claim& claim) {
  Json members = Json::object();
  for (const auto& [id, share] : claim.member_shares) members[id] = share_json(share);
  Json parameters = Json::object();
  for (const auto& [key, estimate] : claim.parameters) parameters[key] = estimate_json(estimate);
  Json over_unexplained;
  if (claim.over_unexplained_nats) over_unexplained = *claim.over_unexplained_nats;
  return {{"id", claim.id},
          {"form", claim.form},
          {"probability", claim.probability},
          {"parameters", parameters},
          {"equivalent", claim.equivalent},
          {"channels", channels_json(claim.channels)},
          {"evidence_nats", claim.evidence_nats},
          {"over_unexplained_nats", over_unexplained},
          {"share", share_json(claim.share)},
          {"member_shares", members}};
}

Json region_json(const MismatchRegion& mismatch) {
  Json region = Json::object();
  for (const auto& [column, ends] : mismatch.region) region[column] = ends;
  return {{"channel", name(mismatch.channel)},
          {"region", region},
          {"effect", mismatch.effect},
          {"ci95", mismatch.ci95},
          {"p_value", mismatch.p_value}};
}

Json fit_json(const Diagnosis& diagnosis) {
  Json fits = Json::object();
  for (const ChannelFit& fit : diagnosis.fit) {
    fits[std::string(name(fit.channel))] = {{"noise_floor", fit.noise_floor},
                                            {"baseline_rmse", fit.baseline_rmse},
                                            {"calibrated_rmse", fit.calibrated_rmse},
                                            {"corrected_rmse", fit.corrected_rmse},
                                            {"held_out_by", diagnosis.held_out_by}};
  }
  return fits;
}

Json step_json(const NameStep& step) {
  Json rmse = Json::object();
  for (const ChannelFit& fit : step.fit) rmse[std::string(name(fit.channel))] = fit.corrected_rmse;
  return {{"id", step.id}, {"rmse", rmse}, {"share_explained", step.share_explained}};
}

Json lack_of_fit_json(const LackOfFit& lack) {
  return {{"f", lack.f},
          {"critical", lack.critical},
          {"p_value", lack.p_value},
          {"degrees_of_freedom", lack.degrees_of_freedom},
          {"pure_error_degrees_of_freedom", lack.pure_error_degrees_of_freedom}};
}

Json soil_json(const std::vector<SoilPull>& pulls) {
  Json soil = Json::object();
  for (const SoilPull& pull : pulls) {
    soil[pull.parameter] = {{"prior", soil_number_json(pull.prior)},
                            {"calibrated", soil_number_json(pull.calibrated)},
                            {"corrected", soil_number_json(pull.corrected)},
                            {"pull", pull.pull},
                            {"corrected_pull", pull.corrected_pull}};
  }
  return soil;
}

Json experiment_json(const Experiment& experiment) {
  return {{"conditions", experiment.conditions},
          {"further_sensor",
           experiment.further_sensor ? Json(name(*experiment.further_sensor)) : Json(nullptr)},
          {"separates", experiment.separates},
          {"expected_gain_nats", experiment.expected_gain_nats}};
}

/// To six digits: ends of ranges are powers that round-off makes long.
double six_digits(double value) {
  return std::stod(fmt::format("{:.6g}", value));
}

/// By mechanism; of several forms the one that stands first. Null where none of a usual size shows.
Json detectable_json(const std::vector<SmallestDetectable>& all) {
  Json detectable = Json::object();
  for (const SmallestDetectable& one : all) {
    if (detectable.contains(one.id)) continue;
    detectable[one.id] = {{"parameter", one.parameter},
                          {"value", one.is_usual ? Json(one.value) : Json(nullptr)},
                          {"usual_range", {six_digits(one.low), six_digits(one.high)}}};
  }
  return detectable;
}

Json left_out_json(const LeftOutRow& row) {
  return {{"line", row.cell.line},
          {"run_id", row.run_id},
          {"column", row.cell.column},
          {"value", row.cell.value},
          {"allowed", row.cell.allowed}};
}

std::vector<std::string> notes(const DiagnosisRun& run) {
  std::vector<std::string> all = run.setup.warnings;
  const auto& found = run.diagnosis.notes;  // begins with the warnings of the recording
  all.insert(all.end(), found.begin(), found.end());
  for (const RecordingFile& reference : run.references) {
    if (reference.left_out.empty()) continue;
    all.push_back(fmt::format("{}: rows left out: {}", reference.file, reference.left_out.size()));
  }
  return all;
}

constexpr std::array<std::pair<const char*, double RunResidual::*>, 7> kResidualColumns{{
    {"adjusted", &RunResidual::measured},
    {"noise", &RunResidual::noise},
    {"baseline", &RunResidual::baseline},
    {"calibrated", &RunResidual::calibrated},
    {"corrected", &RunResidual::corrected},
    {"held_out", &RunResidual::held_out},
    {"held_out_std", &RunResidual::held_out_standard_deviation},
}};

}  // namespace

nlohmann::ordered_json diagnosis_content(const DiagnosisRun& run) {
  const Diagnosis& diagnosis = run.diagnosis;
  const Recording& recording = run.recording.recording;
  return {{"verdict", name(diagnosis.verdict)},
          {"sentence", diagnosis.sentence},
          {"notes", notes(run)},
          {"mechanisms", list_json(diagnosis.claims, claim_json)},
          {"ranking", list_json(diagnosis.ranking,
                                [](const ScoredCandidate& candidate) {
                                  return Json{{"id", candidate.id},
                                              {"probability", candidate.probability},
                                              {"evidence_nats", candidate.evidence_nats}};
                                })},
          {"support",
           {{"tests", name(diagnosis.support.tests)},
            {"best_gain_nats", diagnosis.support.best_gain_nats},
            {"log_odds", diagnosis.support.log_odds}}},
          {"where", list_json(diagnosis.where, region_json)},
          {"where_off", name(diagnosis.where_off)},
          {"fit", fit_json(diagnosis)},
          {"held_out_by", diagnosis.held_out_by},
          {"share_explained", diagnosis.share_explained},
          {"excess_is_clear", diagnosis.excess_is_clear},
          {"names_added", list_json(diagnosis.names_added, step_json)},
          {"remainder", {{"share", diagnosis.remainder_share}}},
          {"suspects", diagnosis.suspects},
          {"chance_nats", diagnosis.chance_nats},
          {"lack_of_fit",
           {{"before", lack_of_fit_json(diagnosis.before)},
            {"after", lack_of_fit_json(diagnosis.after)}}},
          {"soil", soil_json(diagnosis.soil)},
          {"next_experiment", list_json(diagnosis.next_experiments, experiment_json)},
          {"smallest_detectable", detectable_json(diagnosis.smallest_detectable)},
          {"recording", run.recording.file},
          {"references", list_json(run.references,
                                   [](const RecordingFile& reference) { return reference.file; })},
          {"setup", run.setup_file},
          {"runs", recording.runs.size()},
          {"channels", channels_json(recording.channels)},
          {"left_out", list_json(run.recording.left_out, left_out_json)},
          {"ignored_columns", recording.ignored},
          {"corrected_model", "corrected-model.yaml"},
          {"residuals", "residuals.csv"},
          {"seed", run.seed},
          {"version", REGOPLAN_VERSION},
          {"interrupted", diagnosis.interrupted}};
}

std::string diagnosis_json(const DiagnosisRun& run) {
  return diagnosis_content(run).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

/// A comment line for each name that the corrected model does without.
std::string left_out_text(const std::vector<Claim>& claims, const WheelModelSpec& model) {
  std::string text;
  for (const Claim& claim : claims) {
    if (std::ranges::count(model.mechanisms, claim.id, &Mechanism::id) > 0) continue;
    text += fmt::format("# {} is left out: {}\n", claim.id,
                        is_instrument(claim.id)
                            ? "a fault of an instrument is no part of a model of the wheel"
                            : "see the notes of diagnosis.json");
  }
  return text;
}

}  // namespace

std::string corrected_model_text(const DiagnosisRun& run) {
  const Diagnosis& diagnosis = run.diagnosis;
  const DiagnosisSetup setup = run.own_setup();
  ModelSettings settings{.spec = diagnosis.corrected_model,
                         .soil = diagnosis.corrected_soil,
                         .soil_name = run.setup.soil_name};
  if (settings.spec.wheel.radius_m == 0) {
    settings.spec = {.variant = setup.variant,
                     .wheel = setup.wheel,
                     .soil = setup.soil.mean,
                     .gravity_mps2 = setup.gravity_mps2};
    settings.soil = setup.soil;
  }
  std::string sentence = diagnosis.sentence;
  std::ranges::replace(sentence, '\n', ' ');
  std::string text = fmt::format("# {}: {}\n", name(diagnosis.verdict), sentence) +
                     left_out_text(diagnosis.claims, settings.spec) + model_text(settings);
  read_model(parse_settings(text, "corrected-model.yaml"));  // whoever is given it can read it
  return text;
}

std::string residuals_csv(const DiagnosisRun& run) {
  const RecordingFile& recording = run.recording;
  std::vector<std::string> added;
  for (const Channel channel : recording.recording.channels) {
    for (const auto& [prefix, member] : kResidualColumns) {
      added.push_back(fmt::format("{}_{}", prefix, name(channel)));
    }
  }
  std::string text;
  for (const std::string& column : names_beside(recording.columns, added)) {
    text += text_cell(column) + ",";
  }
  text += fmt::format("{}\n", fmt::join(added, ","));

  std::map<std::pair<std::size_t, Channel>, const RunResidual*> residuals;
  for (const RunResidual& residual : run.diagnosis.residuals) {
    residuals[{residual.run, residual.channel}] = &residual;
  }
  for (std::size_t i = 0; i < recording.cells.size(); ++i) {
    for (const std::string& cell : recording.cells[i]) text += text_cell(cell) + ",";
    for (const Channel channel : recording.recording.channels) {
      const auto found = residuals.find({i, channel});
      for (const auto& [prefix, member] : kResidualColumns) {
        if (found != residuals.end()) text += number_cell(found->second->*member);
        text += ",";
      }
    }
    text.back() = '\n';
  }
  return text;
}

std::vector<std::string> diagnosis_file_names() {
  return {"report.html", "corrected-model.yaml", "residuals.csv", "diagnosis.json"};
}

void write_diagnosis_files(const DiagnosisRun& run, const ResultFolder& folder) {
  StagedFiles staged(folder);
  staged.write({"report.html", diagnosis_report(run)});
  staged.write({"corrected-model.yaml", corrected_model_text(run)});
  staged.write({"residuals.csv", residuals_csv(run)});
  staged.write({"diagnosis.json", diagnosis_json(run)});  // last: it speaks for the others
  staged.commit();
}

}  // namespace regoplan
