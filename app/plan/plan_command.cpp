#include <memory>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/plan/plan_run.h"

namespace regoplan {

Command add_plan_command(CLI::App& program) {
  struct Options {
    std::string scenario;
    ScenarioOverrides overrides;
    PlanOutput output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* parser =
      program.add_subcommand("plan",
                             "Find, verify and rank paths.\n"
                             "Writes plan.json, candidate-K.csv, candidate-K.geojson, report.html, "
                             "and, unless infeasible, margin.tif and supply.tif.");
  parser->add_option("SCENARIO.yaml", options->scenario, "map, vehicle, start, goal, limits")
      ->required();
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
  return {parser, [options] {
            return run_plan(read_scenario(options->scenario, options->overrides), options->output);
          }};
}

}  // namespace regoplan
