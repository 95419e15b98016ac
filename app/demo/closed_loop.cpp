#include "app/demo/closed_loop.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <utility>

#include "app/command/progress_line.h"
#include "app/demo/demo_scenario.h"
#include "app/demo/loop_files.h"
#include "app/diagnose_drive/corrected_files.h"
#include "app/diagnose_drive/drive_diagnosis_command.h"
#include "app/drive/drive_run.h"
#include "app/evaluate/path_files.h"
#include "app/io/interrupt.h"
#include "app/plan/plan_run.h"
#include "app/settings/map_files.h"
#include "app/settings/sensor_settings.h"
#include "app/settings/truth_settings.h"
#include "planner/evaluation/manoeuvres.h"
#include "planner/problem/changed_problem.h"

namespace regoplan {
namespace {

constexpr const char* kSensors = "A";

/// Where the loop's files go.
struct Folders {
  explicit Folders(const ResultFolder& first_plan)
      : plan(first_plan),
        drive{plan.path / "drive", plan.force},
        map{drive.path / "map", plan.force},
        again{drive.path / "again", plan.force},
        second_drive{again.path / "drive", plan.force} {}

  ResultFolder plan, drive, map, again, second_drive;

  std::string scenario() const { return (map.path / "scenario.yaml").string(); }
  std::string truth() const { return (drive.path / "truth.yaml").string(); }
  static std::string candidate(const ResultFolder& of, int rank) {
    return (of.path / fmt::format("candidate-{}.csv", rank)).string();
  }
};

class Loop {
 public:
  Loop(const PlanningProblem& known, const PlanResult& plan, const LoopSettings& settings)
      : known_(with_speed_max(known, kSpeedTolerance * known.speed_max_mps)),
        plan_(plan),
        settings_(settings),
        folders_(settings.plan) {}

  ExitStatus run() {
    hide();
    say("\nThe best path is driven, with sensors A, over ground that hides a weak patch "
        "(--no-drive leaves this out).\n");
    DriveRecord first = drive(known_, Folders::candidate(folders_.plan, 1), folders_.scenario(),
                              "drive.html", folders_.drive);
    if (first.result.interrupted) return kInterrupted;

    DriveDiagnosisRun diagnosis =
        diagnosed({.drives = {(folders_.drive.path / "drive.csv").string()},
                   .scenario = folders_.scenario(),
                   .setup = {},
                   .columns = {},
                   .folder = folders_.drive,
                   .page = "diagnosis.html",
                   .quiet = settings_.quiet});
    write_drive_diagnosis(diagnosis, folders_.drive);
    say(drive_diagnosis_summary(diagnosis));
    if (diagnosis.diagnosis.interrupted) return kInterrupted;
    if (!has_corrected_map(diagnosis)) {
      say("The drive is too short to be compared with the model: nothing to plan again with.\n");
      return kYes;
    }
    return go_on(std::move(first), std::move(diagnosis));
  }

 private:
  void say(const std::string& text) const {
    if (settings_.quiet) return;
    fmt::print("{}", text);
    std::fflush(stdout);
  }

  /// Plans again over the corrected map, and drives that.
  ExitStatus go_on(DriveRecord first, DriveDiagnosisRun diagnosis) {
    const std::string scenario = (corrected_folder(folders_.drive).path / "scenario.yaml").string();
    const Scenario corrected = read_scenario(scenario, settings_.overrides);
    const PlanningProblem problem =
        with_speed_max(corrected.problem, kSpeedTolerance * corrected.problem.speed_max_mps);
    std::vector<VerdictChange> verdicts = judged_again(problem);
    if (stop_on_interrupt().stop_requested()) return kInterrupted;

    say("Planned again over the map as the drive tells it:\n");
    PlanRun second = run_plan(corrected, {.folder = folders_.again,
                                          .quiet = settings_.quiet,
                                          .started = std::chrono::steady_clock::now()});
    if (second.status == kInterrupted) return kInterrupted;
    std::optional<DriveRecord> second_drive;
    if (!second.result.candidates.empty()) {
      second_drive = drive(problem, Folders::candidate(folders_.again, 1), scenario, "report.html",
                           folders_.second_drive);
      if (second_drive->result.interrupted) return kInterrupted;
    }
    const ClosedLoop loop{.hidden = hidden_,
                          .first = std::move(first),
                          .diagnosis = std::move(diagnosis),
                          .verdicts = std::move(verdicts),
                          .second_plan = std::move(second.result),
                          .second = std::move(second_drive)};
    write_loop_files(known_, loop, folders_.drive);
    say(fmt::format("\n{}\nbefore and after: {}\nreport: {}\n", loop_headline(loop),
                    (folders_.drive.path / "report.html").string(),
                    (folders_.plan.path / "report.html").string()));
    return kYes;
  }

  /// Writes the map as the planner knows it, and what it does not know.
  void hide() {
    hidden_ = hidden_patch(plan_.candidates.front(), known_.map);
    StagedFiles map(folders_.map);
    write_map_files(known_.map, map);
    map.write({"scenario.yaml", demo_scenario_text()});
    map.commit();
    StagedFiles truth(folders_.drive);
    truth.write({"truth.yaml", truth_text(hidden_)});
    truth.commit();
  }

  /// \param planned what the follower knows; the world driven in is what the truth makes of the map
  /// known at first
  DriveRecord drive(const PlanningProblem& planned, const std::string& path,
                    const std::string& scenario, const std::string& page,
                    const ResultFolder& folder) {
    const GivenPath given = read_path(path, planned, planned.speed_max_mps);
    DriveRecord record{.scenario = scenario,
                       .path = path,
                       .truth = folders_.truth(),
                       .truth_text = truth_text(hidden_),
                       .sensors = kSensors,
                       .page = page,
                       .settings = {.sensors = read_sensors(sensors_file(kSensors)),
                                    .deviation_max_m = default_deviation_max_m(planned.vehicle),
                                    .seed = planned.search.seed,
                                    .stop = stop_on_interrupt()}};
    const DriveTruth truth = parse_truth(record.truth_text, record.truth, known_);
    record.zones = truth.zones;
    const TrueWorld world(known_, truth);
    {
      ProgressLine line(settings_.quiet);
      record.result = regoplan::drive(
          World(planned, WorldUse::kVerdict, 1), world, given.path, record.ends_in_goal,
          record.settings, [&](double share) { line.show({.stage = "driving", .share = share}); });
    }
    write_drive(record, planned, given.path, world, folder);
    say(drive_summary(record));
    return record;
  }

  /// The first plan's candidates over the map as it was known, and as it is corrected; fewer where
  /// it was interrupted.
  std::vector<VerdictChange> judged_again(const PlanningProblem& corrected) const {
    constexpr int kDraws = 200;
    const EvaluationSettings how{.follower = {},
                                 .deviation_max_m = {},
                                 .soil_draws = kDraws,
                                 .seed = known_.search.seed,
                                 .threads = known_.search.threads,
                                 .stop = stop_on_interrupt()};
    const World before(known_, WorldUse::kVerdict, known_.search.threads);
    const World after(corrected, WorldUse::kVerdict, known_.search.threads);
    std::vector<VerdictChange> verdicts;
    ProgressLine line(settings_.quiet);
    for (const Candidate& candidate : plan_.candidates) {
      if (how.stop.stop_requested()) break;
      line.show(
          "judging the first plan's paths again",
          static_cast<double>(verdicts.size()) / static_cast<double>(plan_.candidates.size()));
      const GivenPath given = read_path(Folders::candidate(folders_.plan, candidate.rank), known_,
                                        known_.speed_max_mps);
      verdicts.push_back({.candidate = candidate.rank,
                          .before = evaluate(before, given.path, how),
                          .after = evaluate(after, given.path, how)});
    }
    return verdicts;
  }

  PlanningProblem known_;
  const PlanResult& plan_;
  const LoopSettings& settings_;
  Folders folders_;
  HiddenPatch hidden_;
};

}  // namespace

ExitStatus close_the_loop(const PlanningProblem& known, const PlanResult& plan,
                          const LoopSettings& settings) {
  return Loop(known, plan, settings).run();
}

void require_loop_fits(const ResultFolder& plan) {
  const Folders folders(plan);
  std::vector<std::string> names = drive_result_names("drive.html");
  for (const std::string& name : drive_diagnosis_file_names("diagnosis.html")) {
    names.push_back(name);
  }
  for (const std::string& name : loop_file_names()) names.push_back(name);
  names.emplace_back("truth.yaml");
  require_results_fit(folders.drive, names);
  require_results_fit(folders.second_drive, drive_result_names("report.html"));
  require_results_fit(corrected_folder(folders.drive), corrected_file_names());
}

}  // namespace regoplan
