#pragma once

#include "app/settings/settings_node.h"
#include "maps/drawn_terrain.h"

namespace regoplan {

/// Reads a terrain that a scenario states itself, feature by feature (`map.terrain`):
///
///     width_m: 200
///     height_m: 200
///     cell_m: 0.5                       # optional, as all that follows
///     slope_east_deg: 10                # rise toward +x
///     slope_north_deg: 0
///     roughness_m: 0.05
///     seed: 1
///     soil: 1                           # class code outside every zone
///     craters: [{x_m: 100, y_m: 100, diameter_m: 60, depth_m: 9, rim_height_m: 2}]
///     dunes: {wavelength_m: 25, height_m: 1.5, wind_deg: 0}
///     zones: [{code: 2, west_m: 80, east_m: 120, south_m: 0, north_m: 200}]
///     rocks: [{x_m: 50, y_m: 60, radius_m: 2, height_m: 1.5}]
///     rock_rows: [{from: {x_m: 100, y_m: 0}, to: {x_m: 100, y_m: 90}, spacing_m: 3,
///                  radius_m: 1.6, height_m: 2}]
DrawnTerrain read_terrain(const SettingsNode& node);

}  // namespace regoplan
