#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

#include "app/command/command.h"
#include "app/command/kept_page_notice.h"
#include "app/command/plan_options.h"
#include "app/command/progress_line.h"
#include "app/diagnose/diagnosis_files.h"
#include "app/diagnose/diagnosis_report.h"
#include "app/diagnose/diagnosis_summary.h"
#include "app/diagnose/recording_checks.h"
#include "app/diagnose/same_runs.h"
#include "app/diagnose_drive/drive_diagnosis_command.h"
#include "app/io/interrupt.h"
#include "app/io/staged_files.h"
#include "app/settings/scenario_settings.h"
#include "diagnosis/bed/compared_recordings.h"
#include "diagnosis/difference.h"

namespace regoplan {
namespace {

struct Options {
  std::string recording;
  std::vector<std::string> further_drives;
  std::string scenario;
  std::optional<std::string> columns;
  std::string setup;
  std::vector<std::string> references;
  ResultFolder folder;
  std::uint64_t seed = 1;
  std::optional<int> threads;
  bool json = false;
  bool quiet = false;
};

/// What the recording does without; of many rows, the first.
void notify_of_left_out(const std::vector<LeftOutRow>& rows, bool quiet) {
  constexpr std::size_t kShown = 5;
  for (std::size_t i = 0; i < std::min(kShown, rows.size()); ++i) {
    notify(rows[i].why + ": the row is left out", quiet);
  }
  if (rows.size() <= kShown) return;
  notify(
      fmt::format("{} more rows are left out (left_out in diagnosis.json)", rows.size() - kShown),
      quiet);
}

void notify_of_unused(const RecordingFile& file, bool quiet) {
  if (file.recording.ignored.empty()) return;
  notify(fmt::format("{}: {} kept and not used", file.file, fmt::join(ignored_columns(file), ", ")),
         quiet);
}

std::vector<std::vector<Channel>> channels_of(const std::vector<RecordingFile>& files) {
  std::vector<std::vector<Channel>> channels;
  for (const RecordingFile& file : files) channels.push_back(file.recording.channels);
  return channels;
}

/// What is odd about a recording, which is left without channels that tell next to nothing or whose
/// unit is in question.
std::vector<std::string> checked(RecordingFile& file, const DiagnosisSetup& of_file) {
  const DiagnosisSetup setup = setup_with(of_file, file.wheel);
  std::vector<std::string> told = std::exchange(file.recording.warnings, {});
  std::ranges::copy(leave_out_nearly_empty(file, setup), std::back_inserter(told));
  std::ranges::copy(doubtful_values(file, setup), std::back_inserter(told));
  if (const auto left_out = leave_out_kilograms(file, setup)) told.push_back(*left_out);
  return told;
}

/// `diagnose` knows runs, not files: its errors get the file in front.
Diagnosis diagnose_file(const DiagnosisRun& run, const DiagnosisOptions& options) {
  try {
    const DiagnosisSetup setup = run.own_setup();
    if (run.references.empty()) return diagnose(run.recording.recording, setup, options);
    DiagnosisSetup without_lugs = run.setup.setup;
    without_lugs.lug_height_m.reset();
    without_lugs.lug_count.reset();
    std::vector<Reference> references;
    for (const RecordingFile& file : run.references) {
      references.push_back({file.file, file.recording, setup_with(without_lugs, file.wheel)});
    }
    return diagnose_difference(run.recording.recording, setup, references, options);
  } catch (const InputError& bad) {
    throw InputError(fmt::format("{}: {}", run.recording.file, bad.what()));
  }
}

/// Whole drives on a map, in place of the runs of a single wheel.
ExitStatus run_drives(const Options& options) {
  if (!options.references.empty()) {
    throw InputError("--reference is for a single wheel's recording, --scenario for drives");
  }
  DriveDiagnosisCommand command{.drives = {options.recording},
                                .scenario = options.scenario,
                                .setup = {},
                                .columns = options.columns,
                                .folder = options.folder,
                                .seed = options.seed,
                                .threads = overridden({}, {.threads = options.threads}).threads,
                                .json = options.json,
                                .quiet = options.quiet};
  if (!options.setup.empty()) command.setup = options.setup;
  command.drives.insert(command.drives.end(), options.further_drives.begin(),
                        options.further_drives.end());
  return run_drive_diagnosis(command);
}

/// \throws InputError where it is one of those before it: each counts once
RecordingFile another_reference(const std::string& file, const std::vector<RecordingFile>& before) {
  RecordingFile reference = read_recording(file);
  const auto same = std::ranges::find_if(
      before, [&](const RecordingFile& other) { return are_same_runs(reference, other); });
  if (same == before.end()) return reference;
  throw InputError(fmt::format("{}: the same runs as {}: each counts once", file, same->file));
}

ExitStatus run_diagnosis(const Options& options) {
  if (!options.scenario.empty()) return run_drives(options);
  if (options.setup.empty()) throw InputError("--setup is required for a single wheel's recording");
  if (options.columns) throw InputError("--columns is for drives: --scenario is missing");
  if (!options.further_drives.empty()) {
    throw InputError(
        "one recording of a single wheel at a time (several drives: --scenario is missing)");
  }
  require_writable_folder(options.folder);
  DiagnosisRun run{.setup_file = options.setup, .seed = options.seed};
  run.setup = read_setup_file(options.setup);
  run.recording = read_recording(options.recording);
  Recording& recording = run.recording.recording;
  for (const std::string& reference : options.references) {
    run.references.push_back(another_reference(reference, run.references));
    for (const std::string& warning : checked(run.references.back(), run.setup.setup)) {
      recording.warnings.push_back(fmt::format("{}: {}", reference, warning));
    }
    if (are_same_runs(run.references.back(), run.recording)) {
      recording.warnings.push_back(
          fmt::format("{}: the same runs as the recording's: nothing can differ", reference));
    }
    notify_of_left_out(run.references.back().left_out, options.quiet);
    notify_of_unused(run.references.back(), options.quiet);
    // Lugs of the setup alone may be meant for both; those of the recording's own columns are not.
    RecordedWheel& wheel = run.references.back().wheel;
    if (run.recording.wheel.lug_height_m && !wheel.lug_height_m) {
      wheel.lug_height_m = 0;
      recording.warnings.push_back(fmt::format(
          "{}: no lug_height_m: taken to be smooth, as the recording tells of lugs", reference));
    }
  }
  for (std::string& warning : checked(run.recording, run.setup.setup)) {
    recording.warnings.push_back(std::move(warning));
  }
  for (const auto* warnings : {&run.setup.warnings, &recording.warnings}) {
    for (const std::string& warning : *warnings) notify(warning, options.quiet);
  }
  notify_of_left_out(run.recording.left_out, options.quiet);
  notify_of_unused(run.recording, options.quiet);
  const std::string apart = not_compared(recording.channels, channels_of(run.references));
  if (!apart.empty()) notify(apart, options.quiet);

  require_results_fit(options.folder, diagnosis_file_names());
  notify_of_kept_page(options.folder, "diagnose", options.quiet);
  const std::stop_token stop = stop_on_interrupt();
  {
    ProgressLine line(options.quiet);
    run.diagnosis = diagnose_file(
        run,
        {.seed = options.seed,
         .threads = overridden({}, {.threads = options.threads}).threads,
         .stop = stop,
         .progress = [&line](std::string_view stage, double share) { line.show(stage, share); }});
  }
  write_diagnosis_files(run, options.folder);
  if (options.json) {
    fmt::print("{}", diagnosis_json(run));
  } else if (!options.quiet) {
    fmt::print("{}report: {}\n", diagnosis_summary(run),
               (options.folder.path / "report.html").string());
  }
  if (run.diagnosis.interrupted) return kInterrupted;
  return run.diagnosis.verdict == Verdict::kUnexplained ? kNo : kYes;
}

}  // namespace

Command add_diagnose_command(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* parser = program.add_subcommand(
      "diagnose",
      "Say where recordings and the model differ, and what physics the model leaves out: of runs "
      "of "
      "a single wheel (--setup), or of whole drives on a map (--scenario).\n"
      "Writes diagnosis.json and report.html; of a single wheel corrected-model.yaml and "
      "residuals.csv, of drives windows.csv and, where vehicle and ground were compared, "
      "corrected-map/. Exit status 0: consistent or explained, 2: unexplained, or of drives "
      "undecided.");
  parser
      ->add_option(
          "RECORDING.csv", options->recording,
          "runs of a single wheel: run_id, load_n, slip_ratio, slip_angle_deg and at least one "
          "of fx_n, fy_n, torque_nm, sinkage_m, optional day, replicate, pass, ...; with "
          "--scenario a drive, as drive records it or with --columns")
      ->required();
  parser->add_option("MORE.csv", options->further_drives,
                     "with --scenario: further drives of the same vehicle");
  parser
      ->add_option("--scenario", options->scenario,
                   "the recordings are whole drives on the map of this scenario")
      ->type_name("SCENARIO.yaml");
  parser
      ->add_option("--columns", options->columns,
                   "with --scenario: how the columns of the drives' logs are to be read")
      ->type_name("MAP.yaml");
  parser
      ->add_option(
          "--setup", options->setup,
          "model, wheel, gravity_mps2, soil with priors {mean, std}, optional noise; needed "
          "without --scenario")
      ->type_name("SETUP.yaml");
  parser
      ->add_option("--reference", options->references,
                   "recordings of the same rig and soil without the effect: only the difference "
                   "is diagnosed")
      ->type_name("REFERENCE.csv")
      ->expected(1, -1);
  parser->add_option("--out", options->folder.path, "folder for the results")
      ->type_name("DIR")
      ->required();
  parser->add_option("--seed", options->seed, "seed of all random numbers")
      ->type_name("N")
      ->check(a_seed())
      ->capture_default_str();
  parser
      ->add_option("--threads", options->threads,
                   "how many threads compute (default: all cores); changes no result")
      ->type_name("N")
      ->check(whole_in_range({.min = 1, .max = kThreadsMax}));
  add_force_flag(*parser, options->folder);
  add_output_flags(*parser, options->json, options->quiet);
  return {parser, [options] { return run_diagnosis(*options); }};
}

}  // namespace regoplan
