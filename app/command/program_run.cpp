#include "app/command/program_run.h"

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

#include "app/io/interrupt.h"
#include "app/io/printable_text.h"
#include "terramech/basics/input_error.h"

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

/// How to ask for the options of the command that was called.
std::string help_call(const CLI::App& program) {
  std::string call = program.get_name();
  for (const CLI::App* app = &program; !app->get_subcommands().empty();) {
    app = app->get_subcommands().front();
    call += " " + app->get_name();
  }
  return call + " --help";
}

/// An empty name is a slip of the hand (an unset variable of a script), whatever would become of
/// it.
void refuse_empty_names(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    const bool names_folder = type == "DIR";
    const bool names_file = type.starts_with("FILE") || type.find('.') != std::string::npos;
    if (!names_folder && !names_file) continue;
    const std::vector<std::string>& given = option->results();
    if (std::ranges::none_of(given, &std::string::empty)) continue;
    throw InputError(fmt::format("{}: empty, names no {}", option->get_name(),
                                 names_folder ? "folder" : "file"));
  }
  for (const CLI::App* called : app.get_subcommands()) refuse_empty_names(*called);
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
    const std::string what = unknown ? fmt::format("unknown command {}", argv[1]) : bad.what();
    return fail(fmt::format("{} ({})", what, help_call(program)));
  } catch (const CLI::ParseError& bad) {
    return fail(fmt::format("{} ({})", bad.what(), help_call(program)));
  }
  refuse_empty_names(program);
  const auto command = std::ranges::find_if(
      commands, [](const Command& candidate) { return candidate.parser->parsed(); });
  return command->run();
}

}  // namespace

int run_program(int argc, const char* const* argv,
                const std::function<std::vector<Command>(CLI::App&)>& set_up) {
  prepare_process();
  try {
    CLI::App program;
    program.name(std::filesystem::path(argv[0]).filename());
    program.set_version_flag("--version", std::string("regoplan ") + REGOPLAN_VERSION);
    program.footer(
        "Exit status: 0 yes, 2 no (the result says why), 1 bad input, 130 or 143 interrupted.");
    const std::vector<Command> commands = set_up(program);
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
