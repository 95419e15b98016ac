#pragma once

#include <CLI/CLI.hpp>

#include "app/map/scenario_stub.h"

namespace regoplan {

/// `--vehicle` and `--gravity-mps2` of the scenario that is written beside a map.
/// \param stub must outlive the parsing
void add_stub_options(CLI::App& parser, ScenarioStub& stub);

}  // namespace regoplan
