#include "app/command/command_line.h"

#include "app/command/help_examples.h"
#include "app/command/program_run.h"

namespace regoplan {

std::vector<Command> add_commands(CLI::App& program) {
  program.name("regoplan");
  program.description(
      "Plans for wheeled vehicles on loose soil: which paths the ground can carry, and why.");
  program.require_subcommand(1);
  std::vector<Command> commands{
      add_demo_command(program),  add_plan_command(program),       add_evaluate_command(program),
      add_drive_command(program), add_benchmark_command(program),  add_diagnose_command(program),
      add_wheel_command(program), add_mechanisms_command(program), add_vehicle_command(program),
      add_soil_command(program),  add_scenario_command(program)};
  CLI::App* map = program.add_subcommand("map", "Make, check and describe maps");
  map->require_subcommand(1);
  commands.push_back(add_map_make_command(*map));
  commands.push_back(add_map_import_command(*map));
  commands.push_back(add_map_info_command(*map));
  commands.push_back(add_export_command(program));
  commands.push_back(add_compare_command(program));
  commands.push_back(add_completion_command(program));
  add_help_examples(program);
  program.footer(
      "`regoplan COMMAND --help` lists the options of a command, with examples.\n"
      "`./regoplan test` builds and runs the tests.\n" +
      program.get_footer());
  return commands;
}

int run_command_line(int argc, const char* const* argv) {
  return run_program(argc, argv, add_commands);
}

}  // namespace regoplan
