#include "app/diagnose_drive/drive_diagnosis_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/page/report_assets.h"
#include "app/page/report_page.h"

namespace regoplan {

std::string drive_diagnosis_headline(const DriveDiagnosisRun& run) {
  const DriveDiagnosis& diagnosis = run.diagnosis;
  const std::string of = run.drive_ids.size() == 1 ? std::string("1 drive")
                                                   : fmt::format("{} drives", run.drive_ids.size());
  if (diagnosis.interrupted) return fmt::format("Interrupted: {}, not diagnosed yet.", of);
  if (diagnosis.verdict == DriveVerdict::kUndecided) {
    return fmt::format("Undecided: nothing of {} could be compared with the model.", of);
  }
  if (diagnosis.claims.empty()) {
    return fmt::format("Consistent: in {} nothing is otherwise than the model has it.", of);
  }
  std::vector<std::string> names;
  for (const DriveClaim& claim : diagnosis.claims) names.push_back(claim.id);
  return fmt::format("{} in {}: {}.",
                     diagnosis.verdict == DriveVerdict::kClass ? "Told as a class" : "Named", of,
                     fmt::join(names, ", "));
}

std::optional<std::string> what_would_decide(const DriveDiagnosis& diagnosis) {
  if (diagnosis.verdict != DriveVerdict::kUndecided || diagnosis.silent.empty()) return {};
  const SilentEffect& first = diagnosis.silent.front();
  return fmt::format("Why: {}. What would decide: {}.", first.why, first.drive);
}

std::string drive_diagnosis_report(const DriveDiagnosisRun& run) {
  nlohmann::json data = nlohmann::json::parse(drive_diagnosis_json(run));
  constexpr std::size_t kDrawn = 4000;
  const std::size_t step = std::max<std::size_t>(1, run.diagnosis.windows.size() / kDrawn);
  nlohmann::json track = nlohmann::json::array();
  for (std::size_t i = 0; i < run.diagnosis.windows.size(); i += step) {
    const DriveWindow& window = run.diagnosis.windows[i];
    if (std::isnan(window.x_m)) continue;
    track.push_back({window.x_m, window.y_m, window.drive});
  }
  data["track"] = std::move(track);
  std::vector<std::string> lead;
  if (const auto what = what_would_decide(run.diagnosis)) lead.push_back(*what);
  for (const DriveClaim& claim : run.diagnosis.claims) {
    lead.push_back(fmt::format("{}: {}.", fmt::join(claim.equivalent, " or "), claim.text));
  }
  return render({.title = "Diagnosis of drives",
                 .headline = drive_diagnosis_headline(run),
                 .lead = lead,
                 .body_html = report_assets::kDrivesHtml,
                 .script = report_assets::kDrivesScript,
                 .data_json = json_for_html(data)});
}

}  // namespace regoplan
