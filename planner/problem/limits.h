#pragma once

#include <span>
#include <string_view>

#include "terramech/basics/value_range.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Hard limits that every accepted state keeps.
struct Limits {
  double margin_min = 0.05;  ///< smallest stability margin (cornering, tip-over, traction)
  double slip_max = 0.6;
  double slip_angle_max_rad = 0;
  double slope_max_rad = 0;
  double sinkage_max_m = 0;
  /// The chance constraint: candidates whose margin holds with less probability over the soils'
  /// uncertainty are no answer. Held against the lower end of the draws' 95 % interval; 0: none.
  double probability_min = 0;

  bool operator==(const Limits&) const = default;
};

/// The limits that a vehicle brings where a scenario gives none.
Limits default_limits(const Vehicle& vehicle);

/// The steepest ground that counts as held. Rasters hold heights in single precision: a plane of
/// just the slope that is allowed comes out steeper by less than this share.
double steepest_held_rad(const Limits& limits);

/// A limit as it stands in files and messages. What reads, checks, sweeps or writes limits goes
/// over `limit_keys()`: a new limit is added there, and where states are judged.
struct LimitKey {
  std::string_view key;  ///< as in a scenario's `limits`, its unit at its end
  double Limits::*value;
  double si_per_shown = 1;  ///< radians in a degree, for angles
  ValueRange shown_range = {};

  double shown(const Limits& limits) const { return limits.*value / si_per_shown; }
};
std::span<const LimitKey> limit_keys();

/// \throws ValueError for a limit outside its range
void validate(const Limits& limits);

}  // namespace regoplan
