#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "app/command/command.h"

namespace regoplan {

/// Runs a program: `set_up` names it and adds its commands, the command line says which of them
/// runs. Whatever goes wrong is one line on standard error. \returns the exit status
int run_program(int argc, const char* const* argv,
                const std::function<std::vector<Command>(CLI::App&)>& set_up);

}  // namespace regoplan
