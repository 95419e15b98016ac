#pragma once

#include <array>
#include <cstddef>

#include "maps/terrain_map.h"

namespace regoplan {

/// Deviations of the numbers of a soil, in the order of `soil_parameters()`, each in standard
/// deviations of its own.
inline constexpr std::size_t kSoilNumbers = 14;
using SoilNumbers = std::array<double, kSoilNumbers>;

/// How far the numbers of a map's soil are known: their standard deviations; of a soil that has
/// none at all, strength by a tenth and bearing moduli by a quarter.
SoilNumbers told_spread(const UncertainSoil& soil);

/// How far the numbers of a soil vary, another's in its place as well: as told, and strength and
/// bearing moduli that have no standard deviation by a tenth and by a quarter. Without them no
/// other soil could be told from this one.
SoilNumbers soil_spread(const UncertainSoil& soil);

/// The soil with its numbers so many deviations off. Numbers that are positive stay so: they are
/// multiplied.
Soil deviating(const UncertainSoil& soil, const SoilNumbers& deviations);

/// The deviations of a soil by which `deviating` gives another.
SoilNumbers deviations_between(const UncertainSoil& soil, const Soil& other);

/// So many standard deviations less of friction, cohesion and bearing moduli.
SoilNumbers weaker_by(double deviations);
/// Deviations that multiply kc and kphi of a soil by exp(`log_factor`).
SoilNumbers bearing_by(const UncertainSoil& soil, double log_factor);
Soil weaker(const UncertainSoil& soil, double deviations);

}  // namespace regoplan
