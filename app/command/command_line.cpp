#include "app/command/command_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <vector>

#include "app/command/command.h"
#include "app/io/interrupt.h"
#include "app/io/printable_text.h"

namespace regoplan {
namespace {

int fail(std::string_view message) {
  print_line(message);
  return kFailure;
}

/// What the system does on its own to a process is turned into what can be said.
void prepare_process() {
  // A file beyond the allowed size is then an error of writing.
  std::signal(SIGXFSZ, SIG_IGN);
  // Else the first file that is opened would take the place of standard output.
  for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; ++standard) {
    if (fcntl(standard, F_GETFD) == -1) {
      [[maybe_unused]] const int opened =
          open(standard == STDOUT_FILENO ? "/dev/full" : "/dev/null", O_RDWR);
    }
  }
  end_on_interrupt();
}

/// Everything that was printed has reached standard output only now.
int finish(int status) {
  std::cout.flush();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
    return fail("standard output: cannot be written (disk full?)");
  }
  if (status != kInterrupted) return status;
  print_line("interrupted");
  return interrupted_status();
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
  prepare_process();
  try {
    CLI::App program(
        "Plans for wheeled vehicles on loose soil: which paths the ground can carry, and why.",
        "regoplan");
    program.set_version_flag("--version", std::string("regoplan ") + REGOPLAN_VERSION);
    program.require_subcommand(1);
    program.footer(
        "Exit status: 0 yes, 2 no (the result says why), 1 bad input, 130 or 143 interrupted.");

    std::vector<Command> commands{add_demo_command(program),      add_plan_command(program),
                                  add_evaluate_command(program),  add_benchmark_command(program),
                                  add_diagnose_command(program),  add_wheel_command(program),
                                  add_mechanisms_command(program)};
    CLI::App* map = program.add_subcommand("map", "Make, check and describe maps");
    map->require_subcommand(1);
    commands.push_back(add_map_make_command(*map));
    commands.push_back(add_map_import_command(*map));
    commands.push_back(add_map_info_command(*map));
    program.footer("`./regoplan test` builds and runs the tests.\n" + program.get_footer());
    return finish(run(program, commands, argc, argv));
  } catch (const std::filesystem::filesystem_error& bad) {
    return fail(fmt::format("{}: {}", bad.path1().string(), bad.code().message()));
  } catch (const std::bad_alloc&) {
    return fail(
        "the memory does not suffice; remedy for a large map: cut out the part needed with "
        "gdal_translate -projwin");
  } catch (const std::exception& bad) {
    return std::ferror(stdout) != 0 ? finish(kFailure) : fail(bad.what());
  }
}

}  // namespace regoplan
