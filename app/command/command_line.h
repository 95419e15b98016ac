#pragma once

namespace regoplan {

/// The program: reads the command line, runs the command, returns the exit status. Whatever goes
/// wrong is one line on standard error.
int run_command_line(int argc, const char* const* argv);

}  // namespace regoplan
