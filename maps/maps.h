#pragma once

/// Terrain: elevation, soils, rocks, from files or made.
#include "maps/ground_finder.h"
#include "maps/raster_files.h"
#include "maps/synthetic_terrain.h"
#include "maps/terrain_map.h"
#include "terramech/terramech.h"
