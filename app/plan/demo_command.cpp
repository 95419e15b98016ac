#include <memory>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/io/staged_files.h"
#include "app/plan/demo_scenario.h"
#include "app/plan/plan_run.h"

namespace regoplan {

Command add_demo_command(CLI::App& program) {
  struct Options {
    ScenarioOverrides overrides;
    PlanOutput output{.folder = {.path = "regoplan-report"}};
  };
  const auto options = std::make_shared<Options>();
  CLI::App* parser = program.add_subcommand(
      "demo",
      "Plan on the built-in map: an LRV-class vehicle at up to 3 m/s among lunar craters.\n"
      "Writes what plan writes.");
  parser->add_option("--out", options->output.folder.path, "folder for the results")
      ->type_name("DIR")
      ->default_str("regoplan-report");
  add_search_options(*parser, options->overrides);
  add_force_flag(*parser, options->output.folder);
  add_output_flags(*parser, options->output.json, options->output.quiet);
  return {parser, [options] {
            require_writable_folder(options->output.folder.path);
            return run_plan({.problem = demo_problem(options->overrides), .notices = {}},
                            options->output);
          }};
}

}  // namespace regoplan
