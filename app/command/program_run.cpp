#include "app/command/program_run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>

#include "app/io/interrupt.h"
#include "app/io/printable_text.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/nearest_name.h"
#include "terramech/tables/number_text.h"

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

/// What a name that is given stands for, as the help writes it: `SETUP.yaml`, `DIR`, `FILE`.
std::string placeholder(const CLI::Option& option) {
  return option.get_positional() ? option.get_name() : option.get_type_name();
}

/// In words, with the file of the folder that somebody may have meant.
std::string folder_for_file(const std::string& folder, std::string wanted) {
  std::string own_name = wanted;
  std::ranges::transform(own_name, own_name.begin(),
                         [](unsigned char c) { return std::tolower(c); });
  if (std::filesystem::exists(std::filesystem::path(folder) / own_name)) {
    wanted = (std::filesystem::path(folder) / own_name).string();
  }
  return fmt::format("{} is a folder (allowed: a file, such as {})", folder, wanted);
}

/// An empty name is a slip of the hand (an unset variable of a script), and so is a folder where a
/// file is wanted, whatever would become of it. A raster (`FILE`) may be a folder to GDAL, and a
/// word beside which a file may be named (`A|B|FILE.yaml`) means itself.
void refuse_slips_of_names(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string wanted = placeholder(*option);
    const bool names_folder = wanted == "DIR";
    const bool names_plain_file = wanted.find('.') != std::string::npos;
    if (!names_folder && !names_plain_file && wanted != "FILE") continue;
    for (const std::string& given : option->results()) {
      if (given.empty()) {
        throw InputError(fmt::format("{}: empty, names no {}", option->get_name(),
                                     names_folder ? "folder" : "file"));
      }
      std::error_code none;
      if (names_plain_file && wanted.find('|') == std::string::npos &&
          std::filesystem::is_directory(given, none)) {
        throw InputError(option->get_name() + ": " + folder_for_file(given, wanted));
      }
    }
  }
  for (const CLI::App* called : app.get_subcommands()) refuse_slips_of_names(*called);
}

/// The command that was called, or the house of commands that none was called of.
const CLI::App& called_last(const CLI::App& program) {
  const CLI::App* app = &program;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return *app;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(each->get_name());
  }
  return names;
}

/// Without their dashes, which all share.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  return names;
}

/// A name that nothing has, with the one that may be meant and where all are listed.
std::string unknown(std::string_view what, const std::string& written, const std::string& meant,
                    const CLI::App& program) {
  const std::string hint = meant.empty() ? "" : fmt::format("did you mean {}? ", meant);
  return fmt::format("unknown {} {} ({}{})", what, written, hint, help_call(program));
}

/// What of the command line nothing has a use for: an option that there is none of, which may have
/// taken what follows it for something else and so be the reason why something seems to be missing,
/// or a command. Nothing where there is neither.
std::optional<std::string> unknown_name(const CLI::App& program) {
  const CLI::App& called = called_last(program);
  const std::vector<std::string> left = program.remaining(true);
  if (called.get_require_subcommand_min() > 0 && !left.empty() && !left.front().starts_with('-')) {
    const auto meant = nearest_name(left.front(), command_names(called));
    return unknown("command", left.front(), meant.value_or(""), program);
  }
  for (const std::string& text : left) {
    if (!text.starts_with('-') || parse_number(text)) continue;
    const std::string written = text.substr(0, text.find('='));
    const std::size_t dashes = std::min(written.find_first_not_of('-'), written.size());
    const auto meant = nearest_name(written.substr(dashes), option_names(called));
    return unknown("option", written, meant ? "--" + *meant : "", program);
  }
  return {};
}

int run(CLI::App& program, const std::vector<Command>& commands, int argc,
        const char* const* argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ValidationError& bad) {
    return fail(bad.what());
  } catch (const CLI::ParseError& bad) {
    const bool misses_or_exceeds = dynamic_cast<const CLI::RequiredError*>(&bad) != nullptr ||
                                   dynamic_cast<const CLI::ExtrasError*>(&bad) != nullptr;
    const auto named = misses_or_exceeds ? unknown_name(program) : std::nullopt;
    return fail(named ? *named : fmt::format("{} ({})", bad.what(), help_call(program)));
  }
  refuse_slips_of_names(program);
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
