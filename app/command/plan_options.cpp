#include "app/command/plan_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/command/command.h"
#include "maps/network_rasters.h"

namespace regoplan {

namespace {

/// A flag of a scenario's own has three answers: yes, no, and what the scenario says. CLI11 would
/// take the third for no.
void add_improve_flags(CLI::App& parser, ScenarioOverrides& overrides) {
  CLI::Option* improve = parser.add_flag_callback(
      "--improve", [&overrides] { overrides.improve = true; },
      fmt::format("optimise the controls of what is found; else as the scenario says, else {}",
                  Search{}.improve ? "yes" : "no"));
  parser
      .add_flag_callback(
          "--no-improve", [&overrides] { overrides.improve = false; },
          "leave the controls as they were found")
      ->excludes(improve);
}

template <class Value>
std::string else_as(std::string_view help, const Value& value) {
  return fmt::format("{}; else as the scenario says, else {}", help, value);
}

}  // namespace

void add_seed_option(CLI::App& parser, ScenarioOverrides& overrides) {
  parser.add_option("--seed", overrides.seed, else_as("seed of all random numbers", Search{}.seed))
      ->type_name("N")
      ->check(a_seed());
}

void add_search_options(CLI::App& parser, ScenarioOverrides& overrides) {
  const Search defaults;
  parser
      .add_option(
          "--planner", overrides.planner,
          else_as(fmt::format("one of {}", fmt::join(planner_names(), ", ")), defaults.planner))
      ->type_name("NAME")
      ->check(one_of(planner_names()));
  add_seed_option(parser, overrides);
  CLI::Option* time =
      parser
          .add_option("--time", overrides.time_s,
                      else_as("time for the whole answer, seconds", kSearchTimeDefault_s))
          ->type_name("S")
          ->check(in_range(kAbove0));
  parser
      .add_option(
          "--iterations", overrides.iterations,
          "iterations of each planner run, in place of a time: the result is then reproducible")
      ->type_name("N")
      ->check(whole_in_range({.min = 1, .max = kIterationsMax}))
      ->excludes(time);
  parser
      .add_option("--candidates", overrides.candidates,
                  else_as("how many paths to look for", defaults.candidates))
      ->type_name("N")
      ->check(whole_in_range({.min = 1, .max = 100}));
  add_improve_flags(parser, overrides);
  parser
      .add_option("--threads", overrides.threads,
                  "how many threads compute (default: all cores); changes no result")
      ->type_name("N")
      ->check(whole_in_range({.min = 1, .max = kThreadsMax}));
}

void add_network_flag(CLI::App& parser) {
  parser.add_flag_callback("--allow-network", allow_network_rasters,
                           "rasters may name network file systems and services of GDAL");
}

void add_force_flag(CLI::App& parser, ResultFolder& folder) {
  parser.add_flag("--force", folder.force, "replace files that others wrote or edited as well");
}

void add_output_flags(CLI::App& parser, bool& json, bool& quiet) {
  parser.add_flag("--json", json, "result as JSON on standard output");
  parser.add_flag("--quiet", quiet, "no notices, no progress, no summary");
}

}  // namespace regoplan
