#pragma once

#include <vector>

#include "drive_diagnosis/recording/drive_windows.h"
#include "drive_diagnosis/vehicle_effects.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Where a drive went through a zone: from where it begins to where it ends.
std::vector<MapPlace> zone_track(const SoilZoneFound& zone,
                                 const std::vector<DriveWindow>& windows);

/// The map as the drives tell it: soils with what is left of their spread, each zone as a soil
/// class of its own, and the map, or its soils alone, moved by an offset that was named.
/// A drive sees a zone only where it went: across the track it is taken to reach half its length
/// along the track to either side, and a window farther, as no border is told more finely.
/// \param windows that `effects` is of
TerrainMap corrected_map(const TerrainMap& map, const VehicleEffects& effects,
                         const std::vector<DriveWindow>& windows);

/// The vehicle with wheel radius, mass and centre of gravity as they were named, and with the mass
/// and wheel radius that nobody knew well as they were estimated. Where wheels cannot steer its
/// largest curvature any more, told from the centre of gravity that was found, it is what they can.
Vehicle corrected_vehicle(const Vehicle& vehicle, const VehicleEffects& effects);

}  // namespace regoplan
