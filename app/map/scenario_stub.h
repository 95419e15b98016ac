#pragma once

#include <optional>
#include <string>

#include "app/io/staged_files.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// What the scenario beside a map says, for a person to go on from.
struct ScenarioStub {
  std::string vehicle;  ///< a preset or a vehicle file
  double gravity_mps2 = 0;
};

/// \throws SettingsError where it cannot be read
Vehicle stub_vehicle(const ScenarioStub& stub);

/// What stands beside a map.
struct StubFiles {
  RenderedFile scenario;
  std::optional<RenderedFile> vehicle;  ///< a copy of the vehicle file, where it is none of ours
};

/// A scenario with start and goal near one tenth and nine tenths of the map's diagonal, where the
/// vehicle can stand by the planner's own verdict: on known ground that may be driven, clear of
/// rocks and ground, within its limits at rest. Places with room around them come first.
/// \throws InputError where the vehicle cannot be read, or can stand nowhere on the map
StubFiles stub_files(const TerrainMap& map, const ScenarioStub& stub);

}  // namespace regoplan
