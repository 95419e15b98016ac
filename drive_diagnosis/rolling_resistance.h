#pragma once

#include <vector>

#include "drive_diagnosis/instruments/mounting.h"
#include "terramech/parameters/soil.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// What a vehicle's wheel under an even share of the weight takes to roll straight ahead without
/// pull: torque over radius, as a share of its load.
double rolling_resistance(const Vehicle& vehicle, double gravity_mps2, const Soil& soil);

/// By how much more it takes on `there` than on `said`; the deviation is half of what two thirds of
/// the draws spread over: on the weakest a wheel may not turn itself forward at all.
/// \param draws soils that may lie there as well
DriveEstimate added_resistance(const Vehicle& vehicle, double gravity_mps2, const Soil& said,
                               const Soil& there, const std::vector<Soil>& draws);

}  // namespace regoplan
