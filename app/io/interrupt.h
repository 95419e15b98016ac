#pragma once

#include <stop_token>

namespace regoplan {

/// From now on Ctrl-C and SIGTERM end the process at once, with a word and their status: there is
/// nothing yet to save.
void end_on_interrupt();

/// From now on the first Ctrl-C (or SIGTERM) only asks to stop; another, more than .3 s later, ends
/// the process.
/// \returns what then says so
std::stop_token stop_on_interrupt();

/// What a process ends with that was asked to stop: 130 after Ctrl-C, 143 after SIGTERM.
int interrupted_status();

}  // namespace regoplan
