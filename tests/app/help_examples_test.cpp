// The help of each command ends with two examples, which the command line takes as they stand.
#include "app/command/help_examples.h"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "app/command/command_line.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

/// The words of an example, without the shell's redirection and the program's name.
std::vector<std::string> arguments_of(std::string_view example) {
  std::istringstream stream{std::string(example.substr(0, example.find(" > ")))};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  EXPECT_EQ(words.front(), "regoplan");
  words.erase(words.begin());
  return words;
}

TEST(HelpExamples, EndTheHelpOfEachCommand) {
  CLI::App program;
  const std::vector<Command> commands = add_commands(program);
  for (const CLI::App* command : commands_of(program)) {
    const std::string help = command->help();
    static const std::regex ends(R"(Examples:\n  regoplan [^\n]+\n  regoplan [^\n]+\s*$)");
    EXPECT_TRUE(std::regex_search(help, ends)) << help;
  }
}

TEST(HelpTexts, SayOfEveryOptionWhatItIsBeforeWhatItIsOf) {
  CLI::App program;
  const std::vector<Command> commands = add_commands(program);
  for (const CLI::App* command : commands_of(program)) {
    for (const CLI::Option* option : command->get_options()) {
      const std::string said = option->get_description();
      EXPECT_FALSE(said.empty() || said.starts_with("of ") || said.starts_with("default"))
          << name_of(*command) << " " << option->get_name() << ": " << said;
    }
  }
}

TEST(HelpExamples, AreTakenAsTheyStand) {
  CLI::App names;
  const std::vector<Command> all = add_commands(names);
  int tried = 0;
  for (const CLI::App* command : commands_of(names)) {
    const std::string name = name_of(*command);
    const HelpExamples* examples = help_examples(name);
    ASSERT_NE(examples, nullptr) << name;
    for (const std::string_view line : examples->lines) {
      CLI::App program;
      const std::vector<Command> commands = add_commands(program);
      std::vector<std::string> arguments = arguments_of(line);
      std::ranges::reverse(arguments);  // as CLI11 takes a vector
      EXPECT_NO_THROW(program.parse(arguments)) << line;
      EXPECT_NE(line.find(" " + name), std::string_view::npos) << line;
      ++tried;
    }
  }
  EXPECT_GE(tried, 20);
}

TEST(Completion, OffersCommandsAndOptionsInBash) {
  const ScratchFolder folder;
  const ProgramRun script = run_program(folder, "completion bash");
  ASSERT_EQ(script.status, 0) << script.errors;
  folder.write("script", script.output);
  const auto offered = [&](const std::string& words, int at) {
    const std::string command = "bash -c '. \"" + folder.path("script") + "\"; COMP_WORDS=(" +
                                words + "); COMP_CWORD=" + std::to_string(at) +
                                "; _regoplan; echo ${COMPREPLY[@]}' > '" + folder.path("offered") +
                                "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return folder.read("offered");
  };
  EXPECT_EQ(offered("regoplan ev", 1), "evaluate\n");
  EXPECT_EQ(offered("regoplan map i", 2), "import info\n");
  EXPECT_EQ(offered("regoplan plan s.yaml --cand", 3), "--candidates\n");
  EXPECT_EQ(offered("regoplan map import --elev", 3), "--elevation\n");
}

TEST(Completion, IsAFunctionOfZsh) {
  const ScratchFolder folder;
  const ProgramRun script = run_program(folder, "completion zsh");
  EXPECT_EQ(script.output.find("#compdef regoplan\n"), 0U);
  EXPECT_NE(script.output.find("\"map import \"*) compadd -- "), std::string::npos);
  if (std::system("zsh --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "zsh is not installed";
  folder.write("script", script.output);
  EXPECT_EQ(std::system(("zsh -n '" + folder.path("script") + "'").c_str()), 0);
}

}  // namespace
}  // namespace regoplan
