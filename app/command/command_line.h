#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "app/command/command.h"

namespace regoplan {

/// Makes a parser the program: its name, its commands, what its help says.
std::vector<Command> add_commands(CLI::App& program);

/// The program: reads the command line, runs the command, returns the exit status. Whatever goes
/// wrong is one line on standard error.
int run_command_line(int argc, const char* const* argv);

}  // namespace regoplan
