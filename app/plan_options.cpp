#include "app/plan_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command.h"

namespace regoplan {

void add_search_options(CLI::App& parser, ScenarioOverrides& overrides) {
  parser
      .add_option("--planner", overrides.planner,
                  fmt::format("{}", fmt::join(planner_names(), ", ")))
      ->type_name("NAME")
      ->check(one_of(planner_names()));
  parser.add_option("--seed", overrides.seed, "of all that is drawn")
      ->type_name("N")
      ->check(in_range(kAtLeast0));
  CLI::Option* time = parser.add_option("--time", overrides.time_s, "seconds to search for")
                          ->type_name("S")
                          ->check(in_range(kAbove0));
  parser
      .add_option("--iterations", overrides.iterations,
                  "of each planner run, in place of a time: the result is then reproducible")
      ->type_name("N")
      ->check(in_range({.min = 1}))
      ->excludes(time);
  parser.add_option("--candidates", overrides.candidates, "how many paths to look for")
      ->type_name("N")
      ->check(in_range({.min = 1, .max = 100}));
  parser.add_flag("--improve,!--no-improve", overrides.improve,
                  "optimise the controls of what is found; default: yes");
  parser.add_option("--threads", overrides.threads, "default: all cores; changes no result")
      ->type_name("N")
      ->check(in_range({.min = 1, .max = kThreadsMax}));
}

void add_stub_options(CLI::App& parser, ScenarioStub& stub) {
  parser.add_option("--vehicle", stub.vehicle, "of scenario.yaml: a preset or a file")
      ->type_name("NAME")
      ->capture_default_str();
  parser.add_option("--gravity-mps2", stub.gravity_mps2, "of scenario.yaml")
      ->type_name("NUMBER")
      ->check(in_range(kAbove0))
      ->capture_default_str();
}

void add_output_flags(CLI::App& parser, bool& json, bool& quiet) {
  parser.add_flag("--json", json, "result as JSON on standard output");
  parser.add_flag("--quiet", quiet, "no notices, no progress, no summary");
}

}  // namespace regoplan
