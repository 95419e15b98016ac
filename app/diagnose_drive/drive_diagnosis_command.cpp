#include "app/diagnose_drive/drive_diagnosis_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "app/command/kept_page_notice.h"
#include "app/command/progress_line.h"
#include "app/diagnose_drive/corrected_files.h"
#include "app/diagnose_drive/drive_diagnosis_files.h"
#include "app/diagnose_drive/drive_file.h"
#include "app/io/interrupt.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

/// Drives that share an id get the place in the order given behind it.
void make_ids_distinct(std::vector<DriveRecording>& drives) {
  for (std::size_t i = 1; i < drives.size(); ++i) {
    const auto same = [&](const DriveRecording& other) {
      return other.drive_id == drives[i].drive_id;
    };
    if (std::any_of(drives.begin(), drives.begin() + static_cast<std::ptrdiff_t>(i), same)) {
      drives[i].drive_id += fmt::format(" ({})", i + 1);
    }
  }
}

/// A drive given twice would count twice.
void require_different(const std::vector<DriveRecording>& drives) {
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b, [](double one, double other) {
      return one == other || (std::isnan(one) && std::isnan(other));
    });
  };
  for (std::size_t i = 0; i < drives.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (same(drives[i].time_s, drives[k].time_s) && same(drives[i].x_m, drives[k].x_m) &&
          same(drives[i].y_m, drives[k].y_m)) {
        throw InputError(fmt::format("{}: the same drive as {}: each counts once", drives[i].file,
                                     drives[k].file));
      }
    }
  }
}

}  // namespace

DriveDiagnosisRun diagnosed(const DriveDiagnosisCommand& command) {
  const auto started = std::chrono::steady_clock::now();
  DriveDiagnosisRun run{.scenario_file = command.scenario,
                        .setup = read_drive_setup(command.scenario, command.setup),
                        .seed = command.seed,
                        .page = command.page};
  const DriveColumnMap columns =
      command.columns ? read_drive_columns_file(*command.columns) : DriveColumnMap{};
  for (const std::string& notice : run.setup.notices) notify(notice, command.quiet);
  require_results_fit(command.folder, drive_diagnosis_file_names(run.page));
  require_results_fit(corrected_folder(command.folder), corrected_file_names());
  ProgressLine line(command.quiet);
  std::vector<DriveRecording> drives;
  for (const std::string& file : command.drives) {
    line.show("reading drives",
              static_cast<double>(drives.size()) / static_cast<double>(command.drives.size()));
    drives.push_back(read_drive(file, columns));
  }
  require_different(drives);
  make_ids_distinct(drives);
  for (const DriveRecording& drive : drives) {
    run.drive_ids.push_back(drive.drive_id);
    run.drive_files.push_back(drive.file);
    run.drive_rows.push_back(drive.rows_read);
  }
  std::set<std::vector<std::string>> told;  // of files alike once
  for (const DriveRecording& drive : drives) {
    if (drive.ignored.empty() || !told.insert(drive.ignored).second) continue;
    notify(fmt::format("{}: {} not used", drive.file, fmt::join(drive.ignored, ", ")),
           command.quiet);
  }
  const std::stop_token stop = stop_on_interrupt();
  run.diagnosis = diagnose_drives(
      std::move(drives), run.setup.setup,
      {.seed = command.seed,
       .threads = command.threads,
       .stop = stop,
       .progress = [&line](std::string_view stage, double share) { line.show(stage, share); },
       .news =
           [&](const std::string& text) {
             const std::chrono::duration<double> since = std::chrono::steady_clock::now() - started;
             line.wipe();
             notify(fmt::format("after {:.1f} s: {}", since.count(), text), command.quiet);
           }});
  if (has_corrected_map(run)) {
    line.show("judging the drives again", 1);
    run.verdicts =
        verdict_flips(run.setup.setup, run.setup.limits, run.diagnosis, run.seed, command.threads);
  }
  line.show("writing", 1);
  for (const DriveFinding& finding : run.diagnosis.findings) {
    notify(finding.drive.empty() ? finding.text : finding.drive + ": " + finding.text,
           command.quiet);
  }
  return run;
}

void write_drive_diagnosis(const DriveDiagnosisRun& run, const ResultFolder& folder) {
  if (has_corrected_map(run)) {
    write_corrected_map(run, corrected_folder(folder));
  } else {
    remove_corrected_map(corrected_folder(folder));
  }
  write_drive_diagnosis_files(run, folder);
}

ExitStatus run_drive_diagnosis(const DriveDiagnosisCommand& command) {
  require_writable_folder(command.folder);
  notify_of_kept_page(command.folder, "diagnose", command.quiet);
  const DriveDiagnosisRun run = diagnosed(command);
  write_drive_diagnosis(run, command.folder);
  if (command.json) {
    fmt::print("{}", drive_diagnosis_json(run));
  } else if (!command.quiet) {
    fmt::print("{}report: {}\n", drive_diagnosis_summary(run),
               (command.folder.path / run.page).string());
    if (has_corrected_map(run)) {
      fmt::print("map, soils and vehicle as the drives tell them: regoplan plan {}\n",
                 (corrected_folder(command.folder).path / "scenario.yaml").string());
    }
  }
  if (run.diagnosis.interrupted) return kInterrupted;
  return run.diagnosis.verdict == DriveVerdict::kUndecided ? kNo : kYes;
}

}  // namespace regoplan
