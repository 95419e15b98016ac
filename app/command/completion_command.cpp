#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <memory>

#include "app/command/command.h"

namespace regoplan {
namespace {

/// What may follow each command, `map make`, the program itself being the empty one: its commands
/// and its options.
using Words = std::map<std::string, std::vector<std::string>>;

void collect(const CLI::App& parser, const std::string& name, Words& words) {
  std::vector<std::string>& here = words[name];
  for (const CLI::App* command : parser.get_subcommands(nullptr)) {
    here.push_back(command->get_name());
    collect(*command, name.empty() ? command->get_name() : name + " " + command->get_name(), words);
  }
  for (const CLI::Option* option : parser.get_options()) {
    for (const std::string& lone : option->get_lnames()) here.push_back("--" + lone);
  }
}

/// A `case` over the words typed so far; the first two of them name the command.
std::string cases(const Words& words, const std::string& offer) {
  std::string text;
  // The longest names first: `map make` before `map`.
  for (auto entry = words.rbegin(); entry != words.rend(); ++entry) {
    const auto& [name, following] = *entry;
    text += fmt::format("    \"{}\"*) {} ;;\n", name.empty() ? "" : name + " ",
                        fmt::format(fmt::runtime(offer), fmt::join(following, " ")));
  }
  return text;
}

std::string bash_script(const Words& words) {
  return "# bash completion of regoplan\n_regoplan() {\n"
         "  local typed=\"${COMP_WORDS[*]:1:COMP_CWORD-1} \" offered=\n"
         "  case \"${typed# }\" in\n" +
         cases(words, "offered=\"{}\"") +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$offered\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n}\n"
         "complete -o default -F _regoplan regoplan\n";
}

std::string zsh_script(const Words& words) {
  return "#compdef regoplan\nlocal typed=\"${words[2,CURRENT-1]} \"\ncase \"${typed# }\" in\n" +
         cases(words, "compadd -- {}") + "esac\n_files\n";
}

}  // namespace

Command add_completion_command(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* parser =
      program.add_subcommand("completion", "Print a script that completes commands and options.");
  parser->add_option("SHELL", *shell, "bash, zsh")->required()->check(one_of({"bash", "zsh"}));
  return {parser, [&program, shell] {
            Words words;
            collect(program, "", words);
            fmt::print("{}", *shell == "bash" ? bash_script(words) : zsh_script(words));
            return kYes;
          }};
}

}  // namespace regoplan
