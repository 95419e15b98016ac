#include "app/diagnose_drive/drive_diagnosis_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/page/report_assets.h"
#include "app/page/report_map.h"
#include "app/page/report_page.h"
#include "drive_diagnosis/drive_claims.h"
#include "drive_diagnosis/silent_effects.h"

namespace regoplan {

std::string drive_diagnosis_headline(const DriveDiagnosisRun& run) {
  const DriveDiagnosis& diagnosis = run.diagnosis;
  const std::string of = run.drive_ids.size() == 1 ? std::string("1 drive")
                                                   : fmt::format("{} drives", run.drive_ids.size());
  if (diagnosis.interrupted) return fmt::format("Interrupted: {}, not diagnosed yet.", of);
  if (diagnosis.verdict == DriveVerdict::kUndecided) {
    if (diagnosis.effects && diagnosis.effects->unnamed) {
      return fmt::format("Undecided: in {} something is otherwise that has no name.", of);
    }
    if (is_found(diagnosis, "map_slopes") && !is_found(diagnosis, "drives_differ")) {
      return fmt::format("Undecided: the ground of {} is not the map's.", of);
    }
    if (diagnosis.effects) {
      return fmt::format("Undecided: {} differ from the model, and not in the same way.", of);
    }
    if (diagnosis.currents) {
      return fmt::format(
          "Undecided: of {} the currents are told no better by a model of them than "
          "by a constant.",
          of);
    }
    return fmt::format("Undecided: nothing of {} could be compared with the model.", of);
  }
  if (diagnosis.claims.empty()) {
    return fmt::format("Consistent: in {} nothing is otherwise than the model has it.", of);
  }
  std::vector<std::string> names;
  for (const DriveClaim& claim : diagnosis.claims) {
    const bool alone = claim.equivalent.size() < 2;
    names.push_back(alone ? claim.id : fmt::format("{}", fmt::join(claim.equivalent, " or ")));
  }
  return fmt::format("Found in {}: {}.", of, fmt::join(names, "; "));
}

std::optional<std::string> what_would_decide(const DriveDiagnosis& diagnosis) {
  if (diagnosis.verdict != DriveVerdict::kUndecided || diagnosis.silent.empty()) return {};
  if (diagnosis.effects && diagnosis.effects->unnamed) {
    return "What would decide: what the sensors of torque read at rest and of a wheel in the air, "
           "and a look at how the wheels are mounted.";
  }
  if (is_found(diagnosis, "map_slopes") && !is_found(diagnosis, "drives_differ")) {
    return "What would decide: a map of the ground that was driven, or positions in its "
           "coordinates.";
  }
  if (diagnosis.effects) {
    return "Faults and zones are sought in all drives together. What would decide: each of them "
           "diagnosed by itself.";
  }
  const SilentEffect& first = diagnosis.silent.front();
  return fmt::format("Why: {}. What would decide: {}.", first.why, first.drive);
}

std::vector<std::string> withheld_texts(const DriveDiagnosisRun& run) {
  std::vector<std::string> texts;
  if (!run.diagnosis.effects) return texts;
  for (const SoilFitted& fitted : run.diagnosis.effects->soils_fitted) {
    if (fitted.is_handed_back()) continue;
    texts.push_back(withheld_text(fitted, run.setup.setup.map.soils()[fitted.soil]));
  }
  return texts;
}

namespace {

/// A page under 5 MB: the map and the tracks as fine as a person can see.
constexpr ReportMapDetail kSmall{.cells_a_side = 400, .rocks = 4000};
constexpr std::size_t kPlacesDrawn = 4000;

/// Where was driven, as finely as a bend is seen; a stretch each time nothing was sampled for long.
nlohmann::json tracks_json(const std::vector<DriveWindow>& windows) {
  constexpr int kMostOfAWindow = 5;
  const std::size_t count = std::max<std::size_t>(1, windows.size());
  const int places_of_window =
      std::clamp(static_cast<int>(kPlacesDrawn / count), 1, kMostOfAWindow);
  const std::size_t step = std::max<std::size_t>(1, windows.size() / kPlacesDrawn);
  nlohmann::json tracks = nlohmann::json::array();
  const DriveWindow* last = nullptr;
  for (std::size_t i = 0; i < windows.size(); i += step) {
    const DriveWindow& window = windows[i];
    if (std::isnan(window.x_m)) continue;
    const double gap_max_s = 3 * static_cast<double>(step) * (window.end_s - window.start_s);
    const bool goes_on =
        last && last->drive == window.drive && window.start_s - last->end_s < gap_max_s;
    if (!goes_on) {
      tracks.push_back({{"drive", window.drive}, {"points", nlohmann::json::array()}});
    }
    for (int k = 0; k < places_of_window; ++k) {
      const double share = (k + 0.5) / places_of_window - 0.5;
      const MapPlace place = window.place_at(share * window.duration_s());
      tracks.back()["points"].push_back({place.x_m, place.y_m});
    }
    last = &window;
  }
  return tracks;
}

/// Measured less modelled of each window that was compared; of many windows, as many as are seen.
nlohmann::json residuals_json(const DriveDiagnosis& diagnosis) {
  nlohmann::json residuals = nlohmann::json::array();
  for (const ComparedChannel* channel : compared_channels(diagnosis)) {
    const std::size_t step = 1 + channel->windows.size() / kPlacesDrawn;
    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t i = 0; i < channel->windows.size(); i += step) {
      const DriveWindow& window = diagnosis.windows[channel->windows[i]];
      const auto left = [&](const std::vector<double>& model) {
        return model.empty() ? kNotSampled : channel->measured[i] - model[i];
      };
      rows.push_back({window.drive, (window.start_s + window.end_s) / 2, left(channel->model),
                      left(channel->corrected)});
    }
    residuals.push_back({{"channel", channel->name}, {"noise", channel->noise}, {"rows", rows}});
  }
  return residuals;
}

}  // namespace

std::string drive_diagnosis_report(const DriveDiagnosisRun& run) {
  nlohmann::json data = nlohmann::json::parse(drive_diagnosis_json(run));
  data["tracks"] = tracks_json(run.diagnosis.windows);
  data["residuals"] = residuals_json(run.diagnosis);
  data["map"] = report_map(run.setup.setup.map, kSmall);
  std::vector<std::string> lead;
  if (const auto what = what_would_decide(run.diagnosis)) lead.push_back(*what);
  for (const DriveClaim& claim : run.diagnosis.claims) {
    lead.push_back(fmt::format("{}: {}.", fmt::join(claim.equivalent, " or "), claim.text));
  }
  if (const auto nearest = nearest_text(run.diagnosis)) lead.push_back(*nearest + ".");
  for (const std::string& withheld : withheld_texts(run)) lead.push_back(withheld + ".");
  return render({.command = "diagnose",
                 .title = "Diagnosis of drives",
                 .headline = drive_diagnosis_headline(run),
                 .lead = lead,
                 .body_html = report_assets::kDrivesHtml,
                 .script = report_assets::kDrivesScript,
                 .data_json = json_for_html(data)});
}

}  // namespace regoplan
