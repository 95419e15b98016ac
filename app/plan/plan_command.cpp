#include <memory>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/plan/plan_run.h"

namespace regoplan {
namespace {

struct PlanOptions {
  std::string scenario;
  std::string again;
  ScenarioOverrides overrides;
  PlanOutput output;
};

/// What an earlier plan was made with, and what the command line says in its place.
ScenarioOverrides merged(ScenarioOverrides earlier, const ScenarioOverrides& now) {
  if (now.model_file) earlier.model_file = now.model_file;
  if (now.planner) earlier.planner = now.planner;
  if (now.seed) earlier.seed = now.seed;
  if (now.candidates) earlier.candidates = now.candidates;
  if (now.improve) earlier.improve = now.improve;
  if (now.time_s || now.iterations) {
    earlier.time_s = now.time_s;
    earlier.iterations = now.iterations;
  }
  earlier.threads = now.threads;
  return earlier;
}

ExitStatus run_command(const PlanOptions& options) {
  if (options.scenario.empty() == options.again.empty()) {
    throw InputError("plan: one of SCENARIO.yaml and --again PLAN.json is needed");
  }
  if (options.again.empty()) {
    return run_plan(read_scenario(options.scenario, options.overrides), options.output).status;
  }
  PlanOutput output = options.output;
  output.again = read_earlier_plan(options.again);
  return run_plan(read_scenario(output.again->scenario,
                                merged(output.again->overrides, options.overrides)),
                  output)
      .status;
}

}  // namespace

Command add_plan_command(CLI::App& program) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* parser =
      program.add_subcommand("plan",
                             "Find, verify and rank paths.\n"
                             "Writes plan.json, candidate-K.csv, candidate-K.geojson, report.html, "
                             "and, with paths, margin.tif, supply.tif and probability.tif.");
  parser->add_option("SCENARIO.yaml", options->scenario, "map, vehicle, start, goal, limits");
  parser
      ->add_option("--again", options->again,
                   "in its place: repeat a plan, and say which of its inputs have changed")
      ->type_name("PLAN.json");
  parser->add_option("--out", options->output.folder.path, "folder for the results")
      ->type_name("DIR")
      ->required();
  parser
      ->add_option(
          "--model", options->overrides.model_file,
          "wheel model: its variant and mechanisms everywhere, its soil numbers under soil_name")
      ->type_name("FILE.yaml");
  add_search_options(*parser, options->overrides);
  add_force_flag(*parser, options->output.folder);
  add_network_flag(*parser);
  add_output_flags(*parser, options->output.json, options->output.quiet);
  return {parser, [options] { return run_command(*options); }};
}

}  // namespace regoplan
