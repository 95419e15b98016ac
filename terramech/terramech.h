#pragma once

/// Wheel, soil, vehicle and stability margins: what `find_package(regoplan COMPONENTS terramech)`
/// gives. Semantic versioning counts for what stands here.
#include "terramech/force_table.h"
#include "terramech/input_error.h"
#include "terramech/margin_judge.h"
#include "terramech/mechanism.h"
#include "terramech/soil.h"
#include "terramech/supply.h"
#include "terramech/vehicle.h"
#include "terramech/vehicle_dynamics.h"
#include "terramech/wheel_model.h"
