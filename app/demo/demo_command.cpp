#include <memory>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/demo/closed_loop.h"
#include "app/demo/demo_scenario.h"
#include "app/io/staged_files.h"
#include "app/plan/plan_run.h"

namespace regoplan {

Command add_demo_command(CLI::App& program) {
  struct Options {
    ScenarioOverrides overrides;
    PlanOutput output{.folder = {.path = "regoplan-report"}};
    bool no_drive = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* parser = program.add_subcommand(
      "demo",
      "Plan on the built-in map: an LRV-class vehicle at up to 3 m/s among lunar craters. Then "
      "drive "
      "the best path over ground that hides a weak patch, diagnose the drive, and plan again.\n"
      "Writes what plan writes, and drive/ beside it.");
  parser->add_option("--out", options->output.folder.path, "folder for the results")
      ->type_name("DIR")
      ->default_str("regoplan-report");
  parser->add_flag("--no-drive", options->no_drive, "plan only");
  add_search_options(*parser, options->overrides);
  add_force_flag(*parser, options->output.folder);
  add_output_flags(*parser, options->output.json, options->output.quiet);
  return {parser, [options] {
            const ResultFolder& folder = options->output.folder;
            require_writable_folder(folder);
            if (!options->no_drive) require_loop_fits(folder);
            const Scenario scenario{.problem = demo_problem(options->overrides), .notices = {}};
            const PlanRun planned = run_plan(scenario, options->output);
            if (options->no_drive || planned.status != kYes) return planned.status;
            const bool quiet = options->output.quiet || options->output.json;
            const ExitStatus looped =
                close_the_loop(scenario.problem, planned.result,
                               {.plan = folder, .overrides = options->overrides, .quiet = quiet});
            return looped == kInterrupted ? kInterrupted : planned.status;
          }};
}

}  // namespace regoplan
