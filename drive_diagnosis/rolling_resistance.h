#pragma once

#include <cstdint>

#include "drive_diagnosis/mounting.h"
#include "terramech/parameters/soil.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// What a vehicle's wheel under an even share of the weight takes to roll straight ahead without
/// pull: torque over radius, as a share of its load.
double rolling_resistance(const Vehicle& vehicle, double gravity_mps2, const Soil& soil);

/// By how much more it takes on `there` than on `said`; the deviation is that of `there`, from 60
/// draws.
DriveEstimate added_resistance(const Vehicle& vehicle, double gravity_mps2, const Soil& said,
                               const UncertainSoil& there, std::uint64_t seed);

}  // namespace regoplan
