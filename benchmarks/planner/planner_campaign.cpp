// What the planner reaches over many seeds and maps. Each campaign writes a CSV file, a row a run,
// goes on where it was stopped, and ends by printing its summary:
//   planner_campaign first_path   --out DIR [--seeds N] [--verified N] [--scenario NAME]...
//   planner_campaign cost         --out DIR [--seeds N] [--time S] [--planner NAME]...
//   planner_campaign certificates --out DIR [--seeds N]
//   planner_campaign coverage     --out DIR [--seeds N] [--scenario NAME]...
//   planner_campaign large_map    --out DIR --map SCENARIO.yaml [--seeds N]
#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <string>

#include "benchmarks/planner/campaigns.h"

int main(int argc, char** argv) {
  using namespace regoplan;
  CLI::App app("What the planner reaches over many seeds and maps.");
  app.require_subcommand(1);
  CampaignSettings settings;
  const std::map<std::string, void (*)(const CampaignSettings&)> campaigns{
      {"first_path", first_path_campaign},
      {"cost", cost_campaign},
      {"certificates", certificates_campaign},
      {"coverage", coverage_campaign},
      {"large_map", large_map_campaign}};
  for (const auto& [name, campaign] : campaigns) {
    CLI::App* parser = app.add_subcommand(name, "");
    parser->add_option("--out", settings.out, "folder for NAME.csv")->required();
    parser->add_option("--scenarios", settings.scenarios, "folder of scenarios");
    parser->add_option("--scenario", settings.names, "only these, by name");
    parser->add_option("--planner", settings.planners, "of the cost campaign");
    parser->add_option("--seeds", settings.seeds, "how many, of each; of maps for certificates");
    parser->add_option("--verified", settings.verified, "seeds of first_path to verify too");
    parser->add_option("--time", settings.time_s, "seconds of each run");
    parser->add_option("--map", settings.map, "scenario of the large map")
        ->required(name == "large_map");
    parser->callback([&settings, run = campaign] {
      std::filesystem::create_directories(settings.out);
      run(settings);
    });
  }
  CLI11_PARSE(app, argc, argv);
  return 0;
}
