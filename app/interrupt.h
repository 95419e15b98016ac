#pragma once

#include <stop_token>

namespace regoplan {

/// From now on the first Ctrl-C (or SIGTERM) only asks to stop; a second one ends the process.
/// \returns what then says so
std::stop_token stop_on_interrupt();

}  // namespace regoplan
