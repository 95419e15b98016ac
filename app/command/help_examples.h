#pragma once

#include <array>
#include <string_view>

#include "app/command/command.h"

namespace regoplan {

/// Two uses of a command, as they are typed, with which its help ends.
struct HelpExamples {
  std::string_view command;  ///< `map make`
  std::array<std::string_view, 2> lines;
};

/// \returns nothing of a command that has none
const HelpExamples* help_examples(std::string_view command);

/// Ends the help of each command with its examples. \param program that they belong to
void add_help_examples(const CLI::App& program, const std::vector<Command>& commands);

}  // namespace regoplan
