#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "app/command/command.h"

namespace regoplan {

/// Two uses of a command, as they are typed, with which its help ends.
struct HelpExamples {
  std::string_view command;  ///< `map make`
  std::array<std::string_view, 2> lines;
};

/// The commands of a program, and theirs: `map` and `map make`.
std::vector<CLI::App*> commands_of(CLI::App& program);

/// `map make` of the command `make` of the command `map`.
std::string name_of(const CLI::App& command);

/// \returns nothing of a command that has none
const HelpExamples* help_examples(std::string_view command);

/// Ends the help of each command of the program, and of each that one has, with its examples.
void add_help_examples(CLI::App& program);

}  // namespace regoplan
