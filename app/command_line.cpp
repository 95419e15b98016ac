#include "app/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <vector>

#include "app/command.h"

namespace regoplan {
namespace {

int fail(std::string message) {
  std::ranges::replace(message, '\n', ' ');
  fmt::print(stderr, "regoplan: {}\n", message);
  return kFailure;
}

int run(CLI::App& program, const std::vector<Command>& commands, int argc,
        const char* const* argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ValidationError& bad) {
    return fail(bad.what());
  } catch (const CLI::RequiredError& bad) {
    const bool unknown = argc > 1 && argv[1][0] != '-' && program.get_subcommands().empty();
    return fail(unknown ? fmt::format("unknown command {} (regoplan --help)", argv[1])
                        : fmt::format("{} (regoplan --help)", bad.what()));
  } catch (const CLI::ParseError& bad) {
    return fail(fmt::format("{} (regoplan --help)", bad.what()));
  }
  const auto command = std::ranges::find_if(
      commands, [](const Command& candidate) { return candidate.parser->parsed(); });
  return command->run();
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  try {
    CLI::App program(
        "Plans for wheeled vehicles on loose soil: which paths the ground can carry, and why.",
        "regoplan");
    program.set_version_flag("--version", std::string("regoplan ") + REGOPLAN_VERSION);
    program.require_subcommand(1);
    program.footer("Exit status: 0 yes, 2 no (the result says why), 1 bad input, 130 interrupted.");

    std::vector<Command> commands{add_demo_command(program),     add_plan_command(program),
                                  add_evaluate_command(program), add_benchmark_command(program),
                                  add_diagnose_command(program), add_wheel_command(program)};
    CLI::App* map = program.add_subcommand("map", "Make, check and describe maps");
    map->require_subcommand(1);
    commands.push_back(add_map_make_command(*map));
    commands.push_back(add_map_import_command(*map));
    commands.push_back(add_map_info_command(*map));
    program.footer("`./regoplan test` builds and runs the tests.\n" + program.get_footer());
    return run(program, commands, argc, argv);
  } catch (const std::exception& bad) {
    return fail(bad.what());
  }
}

}  // namespace regoplan
