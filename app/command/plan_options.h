#pragma once

#include <CLI/CLI.hpp>

#include "app/io/staged_files.h"
#include "app/settings/scenario_settings.h"

namespace regoplan {

/// The options that take the place of a scenario's `planner`. `overrides` must outlive the parsing.
void add_search_options(CLI::App& parser, ScenarioOverrides& overrides);

/// `--seed`, of the same.
void add_seed_option(CLI::App& parser, ScenarioOverrides& overrides);

/// `--allow-network`: rasters may be read over a network.
void add_network_flag(CLI::App& parser);

/// `--force`: files that others wrote or edited are replaced.
void add_force_flag(CLI::App& parser, ResultFolder& folder);

/// `--json` and `--quiet`.
void add_output_flags(CLI::App& parser, bool& json, bool& quiet);

}  // namespace regoplan
