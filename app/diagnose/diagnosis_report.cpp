#include "app/diagnose/diagnosis_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "app/page/report_assets.h"
#include "app/page/report_page.h"
#include "app/settings/model_settings.h"
#include "terramech/basics/angles.h"
#include "terramech/mechanisms/mechanism.h"

namespace regoplan {
namespace {

using nlohmann::json;

/// A column of the runs; only where the recording gives it.
template <class Get>
json column(const std::vector<WheelRun>& runs, Get get) {
  json values = json::array();
  for (const WheelRun& run : runs) values.push_back(get(run));
  return values;
}

json runs_json(const Recording& recording) {
  const auto& runs = recording.runs;
  json columns = {{"run_id", column(runs, [](const WheelRun& run) { return run.run_id; })},
                  {"load_n", column(runs, [](const WheelRun& run) { return run.load_n; })},
                  {"slip_ratio", column(runs, [](const WheelRun& run) { return run.slip_ratio; })},
                  {"slip_angle_deg",
                   column(runs, [&](const WheelRun& run) { return degrees(run.slip_angle_rad); })}};
  if (recording.columns.pass) {
    columns["pass"] = column(runs, [](const WheelRun& run) { return run.conditions.pass; });
  }
  if (recording.columns.speed) {
    columns["speed_mps"] =
        column(runs, [](const WheelRun& run) { return run.conditions.speed_mps; });
  }
  if (recording.columns.time) {
    columns["time_s"] = column(runs, [](const WheelRun& run) { return run.conditions.time_s; });
  }
  if (recording.columns.wheel) {
    columns["wheel"] = column(runs, [](const WheelRun& run) { return run.wheel; });
  }
  return columns;
}

json residuals_json(const Diagnosis& diagnosis, const std::vector<Channel>& channels) {
  json all = json::object();
  for (const Channel channel : channels) {
    json rows = json::array();
    for (const RunResidual& at : diagnosis.residuals) {
      if (at.channel != channel) continue;
      rows.push_back({{"run", at.run},
                      {"measured", at.measured},
                      {"noise", at.noise},
                      {"baseline", at.baseline},
                      {"calibrated", at.calibrated},
                      {"corrected", at.corrected},
                      {"held_out", at.held_out},
                      {"held_out_std", at.held_out_standard_deviation}});
    }
    all[std::string(name(channel))] = std::move(rows);
  }
  return all;
}

/// Test less reference, for a diagnosis that was given one.
json differences_json(const Diagnosis& diagnosis) {
  json all = json::object();
  for (const RunDifference& at : diagnosis.differences) {
    all[std::string(name(at.channel))].push_back({{"run", at.run},
                                                  {"difference", at.difference},
                                                  {"noise", at.standard_deviation},
                                                  {"by_names", at.by_names}});
  }
  return all;
}

/// What the claimed mechanisms say, in the words of the catalogue.
json forms_json(const Diagnosis& diagnosis) {
  json forms = json::array();
  for (const Claim& claim : diagnosis.claims) {
    for (const MechanismForm& form : mechanism_forms()) {
      if (form.id != claim.id || (!claim.form.empty() && form.form != claim.form)) continue;
      forms.push_back({{"id", form.id},
                       {"form", form.form},
                       {"formula", form.formula},
                       {"source", form.source}});
    }
  }
  return forms;
}

/// What each mechanism is, as the formula of its first form.
json formulas_json() {
  json formulas = json::object();
  for (const MechanismForm& form : mechanism_forms()) {
    if (!formulas.contains(form.id)) formulas[std::string(form.id)] = form.formula;
  }
  return formulas;
}

json report_data(const DiagnosisRun& run) {
  json data = diagnosis_content(run);
  data["kind"] = "diagnosis";
  const Recording& recording = run.recording.recording;
  data["run_columns"] = runs_json(recording);
  data["run_residuals"] = residuals_json(run.diagnosis, recording.channels);
  data["run_differences"] = differences_json(run.diagnosis);
  data["forms"] = forms_json(run.diagnosis);
  data["formulas"] = formulas_json();
  const DiagnosisSetup setup = run.own_setup();
  data["base_model"] = {{"model", variant_name(setup.variant)},
                        {"radius_m", setup.wheel.radius_m},
                        {"width_m", setup.wheel.width_m},
                        {"gravity_mps2", setup.gravity_mps2}};
  data["corrected_model_text"] = corrected_model_text(run);
  return data;
}

std::string verdict_sentence(Verdict verdict, bool has_reference) {
  switch (verdict) {
    case Verdict::kConsistent:
      if (has_reference) {
        return "Consistent: no difference from its reference is proven.";
      }
      return "Consistent: the model at the soil numbers' prior means says what was measured, "
             "within the noise.";
    case Verdict::kParameters:
      return "Parameters: with soil numbers fitted within their priors the model says what was "
             "measured; no physics is missing that these data show.";
    case Verdict::kNamed:
      return "Named: one explanation of each effect fits best.";
    case Verdict::kClass:
      return "Class: the effect is real, and these data cannot tell some explanations apart.";
    case Verdict::kUnexplained:
      return "Unexplained: the mismatch is real and no known mechanism fits it; it is modelled "
             "without a name where it was seen, and nowhere else.";
    case Verdict::kPartly:
      return "Partly: names, or a class of them, explain part of what was found; the rest has no "
             "name.";
    case Verdict::kUndecided:
      return "Undecided: no verdict was reached.";
  }
  return "";
}

/// What the correction of one recording explains of it.
std::string explained_sentence(const Diagnosis& diagnosis) {
  return diagnosis.excess_is_clear
             ? fmt::format(
                   " On conditions held out of the fit (by {}) the correction explains {:.0f} % of "
                   "the excess misfit.",
                   diagnosis.held_out_by, 100 * std::min(diagnosis.share_explained, 1.0))
             : fmt::format(
                   " On conditions held out of the fit (by {}) the calibrated model's misfit is "
                   "not clear of noise: no share of it can be told.",
                   diagnosis.held_out_by);
}

/// Root of the mean square of what a model leaves of the runs of one channel.
double rms_left(const Diagnosis& diagnosis, Channel channel, double RunResidual::*model) {
  double sum = 0, rows = 0;
  for (const RunResidual& at : diagnosis.residuals) {
    const double left = at.measured - at.*model;
    if (at.channel != channel || !std::isfinite(left)) continue;
    sum += left * left;
    ++rows;
  }
  return rows > 0 ? std::sqrt(sum / rows) : 0;
}

/// What the names explain of a difference, and how well the model handed on, which has more than
/// the names, tells the test.
std::string difference_sentence(const Diagnosis& diagnosis) {
  std::string text;
  if (!diagnosis.claims.empty() && diagnosis.excess_is_clear) {
    text = fmt::format(
        " On conditions held out of the fit (by {}) the names explain {:.0f} % of what the "
        "difference is above noise.",
        diagnosis.held_out_by, 100 * std::min(diagnosis.share_explained, 1.0));
  }
  std::string channels;
  for (const ChannelFit& fit : diagnosis.fit) {
    channels +=
        fmt::format("{}{} by {:.3g} ({:.3g})", channels.empty() ? "" : ", ", name(fit.channel),
                    rms_left(diagnosis, fit.channel, &RunResidual::held_out),
                    rms_left(diagnosis, fit.channel, &RunResidual::baseline));
  }
  if (channels.empty()) return text;
  return text + fmt::format(
                    " The corrected model, which has what the references tell of the test too, is "
                    "off on held-out conditions in {} RMS; in brackets the model at the soil "
                    "numbers' prior means.",
                    channels);
}

std::string basis_sentence(const DiagnosisRun& run) {
  const Recording& recording = run.recording.recording;
  std::string names;
  for (const Channel channel : recording.channels) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name(channel));
  }
  std::string text =
      fmt::format("{} runs of {}; measured: {}.", recording.runs.size(),
                  std::filesystem::path(run.recording.file).filename().string(), names);
  if (!run.diagnosis.claims.empty() || run.diagnosis.verdict == Verdict::kUnexplained) {
    text += run.references.empty() ? explained_sentence(run.diagnosis)
                                   : difference_sentence(run.diagnosis);
  }
  return text;
}

}  // namespace

std::string diagnosis_headline(const DiagnosisRun& run) {
  return run.diagnosis.sentence.empty()
             ? verdict_sentence(run.diagnosis.verdict, !run.references.empty())
             : run.diagnosis.sentence;
}

std::string diagnosis_report(const DiagnosisRun& run) {
  std::vector<std::string> lead;
  if (run.diagnosis.interrupted) {
    lead.emplace_back(
        "The diagnosis was interrupted: this is what it had found by then, and no "
        "verdict to rely on.");
  }
  if (!run.diagnosis.sentence.empty())
    lead.push_back(verdict_sentence(run.diagnosis.verdict, !run.references.empty()));
  lead.push_back(basis_sentence(run));
  return render(
      {.command = "diagnose",
       .title = fmt::format("Diagnosis of {}",
                            std::filesystem::path(run.recording.file).filename().string()),
       .headline = diagnosis_headline(run),
       .lead = lead,
       .body_html = report_assets::kDiagnosisHtml,
       .script = report_assets::kDiagnosisScript,
       .data_json = json_for_html(report_data(run))});
}

}  // namespace regoplan
