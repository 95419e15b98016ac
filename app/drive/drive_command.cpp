#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/command/command.h"
#include "app/command/kept_page_notice.h"
#include "app/command/plan_options.h"
#include "app/command/progress_line.h"
#include "app/drive/drive_run.h"
#include "app/drive/follower_pipe.h"
#include "app/evaluate/path_files.h"
#include "app/io/interrupt.h"
#include "app/io/quantity_text.h"
#include "app/settings/sensor_settings.h"
#include "app/settings/settings_node.h"
#include "app/settings/truth_settings.h"
#include "planner/evaluation/evaluation.h"
#include "planner/evaluation/manoeuvres.h"
#include "planner/problem/changed_problem.h"

namespace regoplan {
namespace {

struct Options {
  std::string scenario, path;
  ScenarioOverrides overrides;
  ResultFolder folder;
  std::optional<std::string> follower, follower_fds, truth_file, sensors;
  std::optional<double> deviation_max_m;
  bool json = false, quiet = false;
};

bool leads_to_the_goal(const ReferencePath& path, const Goal& goal) {
  const CurvePlace end = path.end();
  return std::hypot(end.x_m - goal.x_m, end.y_m - goal.y_m) <= goal.radius_m;
}

/// A grade, or a file that there is.
SensorSuite sensors_named(const std::string& name) {
  const std::string file = sensors_file(name);
  if (!std::filesystem::exists(file)) {
    throw InputError(fmt::format("--sensors: {}: no such file (grades: A | B)", name));
  }
  return read_sensors(file);
}

DriveSettings settings_of(const Options& options, const PlanningProblem& problem,
                          const std::shared_ptr<FollowerPipe>& pipe) {
  DriveSettings settings{
      .follower = {.kind = follower_named(options.follower)},
      .deviation_max_m = options.deviation_max_m.value_or(default_deviation_max_m(problem.vehicle)),
      .seed = problem.search.seed,
      .stop = stop_on_interrupt()};
  if (pipe) {
    settings.follower.kind = FollowerKind::kOwn;
    settings.follower.own = [pipe](const FollowerView& view) { return (*pipe)(view); };
  }
  if (options.sensors) settings.sensors = sensors_named(*options.sensors);
  return settings;
}

/// What a truth makes of a vehicle and its soils may be no vehicle: an error of its file.
TrueWorld true_world(const PlanningProblem& problem, DriveRecord& record) {
  if (record.truth.empty()) return {problem, {}};
  const DriveTruth truth = parse_truth(record.truth_text, record.truth, problem);
  record.zones = truth.zones;
  try {
    return {problem, truth};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", record.truth, error.what()));
  }
}

std::string summary(const DriveRecord& record, double computed_in_s) {
  const DriveResult& r = record.result;
  return drive_summary(record) +
         fmt::format("{:.1f} m in {:.1f} s, {}; computed in {:.2f} s, {:.0f} times as fast\n",
                     r.length_m, r.duration_s, energy_text(r.energy_j), computed_in_s,
                     r.duration_s / computed_in_s);
}

ExitStatus run(const Options& options) {
  const std::shared_ptr<FollowerPipe> pipe =
      options.follower_fds
          ? std::make_shared<FollowerPipe>(*options.follower_fds, stop_on_interrupt())
          : nullptr;
  require_writable_folder(options.folder);
  const Scenario scenario = read_scenario(options.scenario, options.overrides);
  const GivenPath given = read_path(options.path, scenario.problem, scenario.problem.speed_max_mps);
  const PlanningProblem problem =
      with_speed_max(scenario.problem, kSpeedTolerance * scenario.problem.speed_max_mps);
  const std::string truth_text = options.truth_file ? settings_text(*options.truth_file) : "";
  DriveRecord record{.scenario = options.scenario,
                     .path = options.path,
                     .truth = options.truth_file.value_or(""),
                     .truth_text = truth_text,
                     .sensors = options.sensors.value_or(""),
                     .ends_in_goal = leads_to_the_goal(given.path, problem.goal),
                     .settings = settings_of(options, problem, pipe)};
  const TrueWorld world = true_world(problem, record);
  require_results_fit(options.folder, drive_result_names(record.page));
  notify_of_kept_page(options.folder, "drive", options.quiet);
  for (const std::string& notice : scenario.notices) notify(notice, options.quiet);
  for (const std::string& notice : given.notices) notify(notice, options.quiet);
  if (!record.ends_in_goal) {
    notify("the path does not lead to the goal: its own end counts", options.quiet);
  }

  const World planned(problem, WorldUse::kVerdict, 1);
  const auto begun = std::chrono::steady_clock::now();
  {
    ProgressLine line(options.quiet);
    record.result = drive(planned, world, given.path, record.ends_in_goal, record.settings,
                          [&](double share) { line.show({.stage = "driving", .share = share}); });
  }
  const double computed_in_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  write_drive(record, problem, given.path, world, options.folder);
  if (options.json) {
    fmt::print("{}", drive_json(record, problem));
  } else if (!options.quiet) {
    fmt::print("{}report: {}\n", summary(record, computed_in_s),
               (options.folder.path / record.page).string());
  }
  if (record.result.interrupted) return kInterrupted;
  return record.result.reached && record.result.within_limits() ? kYes : kNo;
}

}  // namespace

Command add_drive_command(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* parser = program.add_subcommand(
      "drive",
      "Follow a path in closed loop, and record it as a rover would.\n"
      "Writes drive.csv, drive.json, truth.json and report.html; exit 0: reached within all "
      "limits.");
  parser->add_option("SCENARIO.yaml", options->scenario, "map, vehicle, limits, as planned")
      ->required();
  parser
      ->add_option("PATH.csv", options->path,
                   "a candidate-K.csv of plan, or points x_m, y_m, optional speed_mps")
      ->required();
  parser->add_option("--out", options->folder.path, "folder for the results")
      ->type_name("DIR")
      ->required();
  const std::vector<std::string_view> followers = follower_names();
  parser
      ->add_option("--follower", options->follower,
                   "compensated (default): what the trims of the planned soils need is commanded; "
                   "pursuit: nothing is known of the ground")
      ->check(one_of({followers.begin(), followers.end()}));
  parser
      ->add_option("--follower-fds", options->follower_fds,
                   "a follower of your own in another process, over two open file descriptors: "
                   "lines of JSON, docs/drive.md")
      ->type_name("OUT,IN")
      ->excludes("--follower");
  parser
      ->add_option("--truth", options->truth_file,
                   "how the world driven in differs from the one planned for")
      ->type_name("FILE.yaml");
  parser
      ->add_option("--sensors", options->sensors,
                   "grade A or B, or a file; without: exact, and seen by the follower")
      ->type_name("A|B|FILE.yaml");
  add_seed_option(*parser, options->overrides);
  parser
      ->add_option("--model", options->overrides.model_file,
                   "wheel model that was planned with, as in plan")
      ->type_name("FILE.yaml");
  parser
      ->add_option("--deviation-max-m", options->deviation_max_m,
                   "how far the vehicle may stray (default: half of its body's width)")
      ->type_name("M")
      ->check(in_range(kAbove0));
  add_force_flag(*parser, options->folder);
  add_network_flag(*parser);
  add_output_flags(*parser, options->json, options->quiet);
  return {parser, [options] { return run(*options); }};
}

}  // namespace regoplan
