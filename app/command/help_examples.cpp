#include "app/command/help_examples.h"

#include <fmt/format.h>

#include <algorithm>

namespace regoplan {
namespace {

constexpr auto kExamples = std::to_array<HelpExamples>(
    {{"demo", {"regoplan demo", "regoplan demo --time 60 --out my-demo"}},
     {"plan",
      {"regoplan plan scenario.yaml --out result",
       "regoplan plan --again result/plan.json --out repeated"}},
     {"evaluate",
      {"regoplan evaluate scenario.yaml path.csv --out result",
       "regoplan evaluate scenario.yaml result/candidate-1.csv result/candidate-2.csv --out "
       "judged"}},
     {"drive",
      {"regoplan drive scenario.yaml result/candidate-1.csv --out driven",
       "regoplan drive scenario.yaml path.csv --follower compensated --sensors B --truth "
       "truth.yaml --out driven"}},
     {"benchmark",
      {"regoplan benchmark suite.yaml --out part-1 --shard 1/4",
       "regoplan benchmark merge part-1 part-2 --out whole"}},
     {"benchmark merge",
      {"regoplan benchmark merge part-1 part-2 --out whole",
       "regoplan benchmark merge part-1 part-2 part-3 --out whole --quiet"}},
     {"diagnose",
      {"regoplan diagnose recording.csv --setup setup.yaml --out result",
       "regoplan diagnose driven/drive.csv --scenario scenario.yaml --out result"}},
     {"wheel",
      {"regoplan wheel conditions.csv --model model.yaml --out forces.csv",
       "regoplan wheel --figures figures"}},
     {"mechanisms", {"regoplan mechanisms slip_sinkage", "regoplan mechanisms --json"}},
     {"map", {"regoplan map make --out my-map", "regoplan map info my-map/scenario.yaml"}},
     {"map make",
      {"regoplan map make --out my-map", "regoplan map make --width-m 300 --seed 3 --out my-map"}},
     {"map import",
      {"regoplan map import --elevation dem.tif --soils soils.yaml --gravity-mps2 1.62 --vehicle "
       "lrv "
       "--out my-map",
       "regoplan map import --elevation points.csv --soils soils.yaml --gravity-mps2 9.81 --out "
       "my-map"}},
     {"map info", {"regoplan map info my-map/scenario.yaml", "regoplan map info dem.tif --json"}},
     {"compare", {"regoplan compare before after", "regoplan compare before after --out compared"}},
     {"export",
      {"regoplan export result --nav2 nav2", "regoplan export result --nav2 nav2 --qgis qgis"}},
     {"vehicle", {"regoplan vehicle lrv > vehicle.yaml", "regoplan vehicle curiosity"}},
     {"soil", {"regoplan soil firm_regolith > soils.yaml", "regoplan soil soft_patch"}},
     {"scenario", {"regoplan scenario", "regoplan scenario > scenario.yaml"}},
     {"completion",
      {"regoplan completion bash > ~/.local/share/bash-completion/completions/regoplan",
       "regoplan completion zsh > ~/.zfunc/_regoplan"}}});

}  // namespace

std::vector<CLI::App*> commands_of(CLI::App& program) {
  std::vector<CLI::App*> commands;
  for (CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command);
    for (CLI::App* its : commands_of(*command)) commands.push_back(its);
  }
  return commands;
}

std::string name_of(const CLI::App& command) {
  const CLI::App* house = command.get_parent();
  return house == nullptr || house->get_parent() == nullptr
             ? command.get_name()
             : house->get_name() + " " + command.get_name();
}

const HelpExamples* help_examples(std::string_view command) {
  const auto found = std::ranges::find(kExamples, command, &HelpExamples::command);
  return found == kExamples.end() ? nullptr : &*found;
}

void add_help_examples(CLI::App& program) {
  for (CLI::App* command : commands_of(program)) {
    if (const HelpExamples* examples = help_examples(name_of(*command))) {
      command->footer(fmt::format("Examples:\n  {}\n  {}", examples->lines[0], examples->lines[1]));
    }
  }
}

}  // namespace regoplan
