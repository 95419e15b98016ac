#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numbers>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/evaluate/chart_files.h"
#include "app/evaluate/evaluation_run.h"
#include "app/settings/soil_settings.h"
#include "app/settings/vehicle_settings.h"
#include "planner/following/follower.h"
#include "terramech/parameters/gravity_range.h"

namespace regoplan {
namespace {

struct Options {
  std::optional<std::string> scenario;
  ScenarioOverrides overrides;
  EvaluationRequest request;

  std::optional<std::filesystem::path> chart_folder;
  std::optional<std::string> vehicle;
  std::optional<std::string> soils_file;
  std::optional<double> gravity_mps2;
  std::vector<double> slopes_deg{0, 10, 20};
  std::optional<double> chart_speed_mps;
};

/// `--vehicle` names a preset or a vehicle file.
Vehicle vehicle_of_option(const std::string& name) {
  const std::vector<std::string> presets = preset_vehicle_names();
  if (std::ranges::find(presets, name) != presets.end()) return preset_vehicle(name);
  if (!std::filesystem::exists(name)) {
    throw InputError(fmt::format(
        "--vehicle: {} is not valid (allowed: {}, or a vehicle file; there is no such file)",
        name.empty() ? "\"\"" : name, fmt::join(presets, " | ")));
  }
  return read_vehicle(read_settings(name));
}

/// `--soils` names a soils file, or a mapping with `soils` in it.
std::vector<MapSoil> read_soils(const std::string& file, WheelVariant variant) {
  return read_soil_catalogue(read_settings(file), variant).soils;
}

/// Largest speed of a chart: the vehicle's own, or what is asked for below it.
double chart_speed_max_mps(const Options& options, const Vehicle& vehicle) {
  const double asked_mps = options.chart_speed_mps.value_or(vehicle.speed_max_mps);
  if (asked_mps > vehicle.speed_max_mps) {
    throw InputError(fmt::format(
        "--chart-speed-mps: {} is not valid (allowed: above 0 to {}, the largest of {})", asked_mps,
        vehicle.speed_max_mps, vehicle.name));
  }
  return asked_mps;
}

ChartSettings chart_settings(const Options& options) {
  ChartSettings settings;
  std::optional<Scenario> scenario;
  if (options.scenario) scenario = read_scenario(*options.scenario, options.overrides);
  if (!scenario && (!options.vehicle || !options.soils_file || !options.gravity_mps2)) {
    throw InputError("--chart needs a SCENARIO.yaml, or --vehicle, --soils and --gravity-mps2");
  }
  if (scenario) {
    const PlanningProblem& problem = scenario->problem;
    settings.vehicle = problem.vehicle;
    settings.soils = problem.map.soils();
    settings.wheel_variant = problem.wheel_variant;
    settings.mechanisms = problem.mechanisms;
    settings.generic = problem.generic;
    settings.gravity_mps2 = problem.gravity_mps2;
    settings.limits = problem.limits;
  }
  if (options.vehicle) {
    settings.vehicle = vehicle_of_option(*options.vehicle);
    settings.limits = default_limits(settings.vehicle);
  }
  if (options.soils_file) settings.soils = read_soils(*options.soils_file, settings.wheel_variant);
  if (options.gravity_mps2) settings.gravity_mps2 = *options.gravity_mps2;
  constexpr int kSpeeds = 19;
  const double fastest_mps = chart_speed_max_mps(options, settings.vehicle);
  for (int i = 0; i < kSpeeds; ++i) {
    settings.speeds_mps.push_back(fastest_mps * (1 + 9.0 * i / (kSpeeds - 1)) / 10);
  }
  for (const double slope : options.slopes_deg) {
    settings.slopes_rad.push_back(slope * std::numbers::pi / 180);
  }
  settings.slope_max_rad = 30 * std::numbers::pi / 180;
  settings.threads = overridden({}, options.overrides).threads;
  return settings;
}

ExitStatus draw_chart(const Options& options) {
  const ResultFolder folder{*options.chart_folder, options.request.folder.force, "--chart"};
  require_results_fit(folder, chart_file_names());
  const ChartSettings settings = chart_settings(options);
  const FeasibilityChart chart = feasibility_chart(settings);
  StagedFiles staged(folder);
  for (const RenderedFile& file : render_chart(settings, chart)) staged.write(file);
  staged.commit();
  if (!options.request.quiet) {
    fmt::print("chart: {}\n", (*options.chart_folder / "feasibility.svg").string());
  }
  return kYes;
}

/// What is said of paths and has no meaning for a chart; `--model` has none without a scenario.
void refuse_what_is_of_paths(const CLI::App& parser, const Options& options) {
  for (const char* option :
       {"--speed", "--deviation-max-m", "--follower", "--draws", "--seed", "--json"}) {
    if (parser.count(option) > 0) {
      throw InputError(fmt::format(
          "--chart takes no {}: it is a picture of vehicle and soils, of no path", option));
    }
  }
  if (!options.scenario && options.overrides.model_file) {
    throw InputError("--chart takes --model only with a SCENARIO.yaml");
  }
}

ExitStatus run(const CLI::App& parser, const Options& options) {
  if (options.chart_folder) {
    if (!options.request.path_files.empty() || options.request.manoeuvre_file) {
      throw InputError("--chart takes neither paths nor --manoeuvres");
    }
    if (!options.request.folder.path.empty()) {
      throw InputError("--chart takes no --out: it names the chart's folder itself");
    }
    refuse_what_is_of_paths(parser, options);
    return draw_chart(options);
  }
  if (!options.scenario) throw InputError("SCENARIO.yaml is required (regoplan evaluate --help)");
  if (options.request.folder.path.empty()) {
    throw InputError("--out is required (regoplan evaluate --help)");
  }
  if (options.request.path_files.empty() && !options.request.manoeuvre_file) {
    throw InputError("nothing to evaluate: give PATH.csv or --manoeuvres FILE.yaml");
  }
  return run_evaluation(read_scenario(*options.scenario, options.overrides), options.request);
}

/// What a chart is drawn of, with a scenario or without.
void add_chart_options(CLI::App& parser, Options& options) {
  CLI::Option* chart =
      parser
          .add_option("--chart", options.chart_folder,
                      "folder for a chart of the turns that are safe at a speed and slope, in "
                      "place of paths: of a scenario, or of --vehicle, --soils and --gravity-mps2")
          ->type_name("DIR");
  parser.add_option("--vehicle", options.vehicle, "vehicle of the chart: a preset or a file")
      ->type_name("NAME")
      ->needs(chart);
  parser.add_option("--soils", options.soils_file, "soils of the chart")
      ->type_name("FILE.yaml")
      ->needs(chart);
  parser.add_option("--gravity-mps2", options.gravity_mps2, "gravity of the chart")
      ->type_name("NUMBER")
      ->check(in_range(kGravity_mps2))
      ->needs(chart);
  parser
      .add_option("--chart-slopes-deg", options.slopes_deg,
                  "slopes of the chart: ground across the turn")
      ->type_name("DEG")
      ->check(in_range({.min = 0, .max = 45}))
      ->capture_default_str()
      ->needs(chart);
  parser
      .add_option(
          "--chart-speed-mps", options.chart_speed_mps,
          "largest speed of the chart, from a tenth of it on (default: the vehicle's largest)")
      ->type_name("MPS")
      ->check(in_range(kAbove0))
      ->needs(chart);
}

}  // namespace

Command add_evaluate_command(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  EvaluationRequest& request = options->request;
  CLI::App* parser = program.add_subcommand(
      "evaluate",
      "Judge given paths and manoeuvres, side by side.\n"
      "Writes evaluation.json and report.html; with --chart a chart of what is safe.");
  parser->add_option("SCENARIO.yaml", options->scenario, "map, vehicle, limits");
  parser->add_option("PATH.csv", request.path_files,
                     "points x_m, y_m, optional speed_mps (negative: all of it in reverse); or a "
                     "candidate-K.csv of plan");
  parser->add_option("--out", request.folder.path, "folder for the results")->type_name("DIR");
  parser
      ->add_option("--manoeuvres", request.manoeuvre_file,
                   "list of {kind: steady_turn | lane_change | slalom | slope_traverse | "
                   "braking_in_a_turn | point_turn, ...}")
      ->type_name("FILE.yaml");
  parser
      ->add_option(
          "--model", options->overrides.model_file,
          "wheel model: its variant and mechanisms everywhere, its soil numbers under soil_name")
      ->type_name("FILE.yaml");
  parser->add_option("--speed", request.speed_mps, "largest speed, in place of the scenario's")
      ->type_name("MPS")
      ->check(in_range(kAbove0));
  parser
      ->add_option("--deviation-max-m", request.deviation_max_m,
                   "how far the vehicle may stray (default: half of its body's width)")
      ->type_name("M")
      ->check(in_range(kAbove0));
  const std::vector<std::string_view> followers = follower_names();
  parser
      ->add_option("--follower", request.follower,
                   "what drives the path: compensated (default), which knows the soil, or pursuit")
      ->check(one_of({followers.begin(), followers.end()}));
  parser
      ->add_option("--draws", request.soil_draws,
                   "how many draws of the uncertain soil numbers each path is judged in")
      ->type_name("N")
      ->check(whole_in_range({.min = 2, .max = 1e6}))
      ->capture_default_str();
  add_seed_option(*parser, options->overrides);
  parser
      ->add_option("--threads", options->overrides.threads,
                   "how many threads compute (default: all cores); changes no result")
      ->type_name("N")
      ->check(whole_in_range({.min = 1, .max = kThreadsMax}));
  add_chart_options(*parser, *options);
  add_force_flag(*parser, request.folder);
  add_network_flag(*parser);
  add_output_flags(*parser, request.json, request.quiet);
  return {parser, [parser, options] { return run(*parser, *options); }};
}

}  // namespace regoplan
