#pragma once

#include <string>
#include <string_view>

namespace regoplan {

/// `text` as one line that a terminal shows and obeys nothing of: line breaks become spaces, other
/// control characters, marks that turn the direction of writing and bytes that are no UTF-8 are
/// written as `\x1b`. What is longer than a person reads loses its middle.
std::string printable(std::string_view text);

/// `text` as far as a message quotes it: its first 40 bytes, in whole characters.
std::string quotable(std::string_view text);

}  // namespace regoplan
