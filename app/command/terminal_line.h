#pragma once

namespace regoplan {

/// Sent to a terminal, empties the line that progress is told on.
inline constexpr const char* kWipeLine = "\r\033[K";

}  // namespace regoplan
