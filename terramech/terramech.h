#pragma once

/// Wheel, soil, vehicle and stability margins: what `find_package(regoplan COMPONENTS terramech)`
/// gives. Semantic versioning counts for what stands here.
#include "terramech/basics/input_error.h"
#include "terramech/force_table/force_table.h"
#include "terramech/margins/margin_judge.h"
#include "terramech/margins/supply.h"
#include "terramech/mechanisms/mechanism.h"
#include "terramech/parameters/soil.h"
#include "terramech/parameters/vehicle.h"
#include "terramech/vehicle/vehicle_dynamics.h"
#include "terramech/wheel/wheel_model.h"
