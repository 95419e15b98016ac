#pragma once

#include <string>

#include "planner/evaluation/evaluation.h"

namespace regoplan {

/// A turn on the spot, about the point (turn_centre_x_m, 0) of the vehicle.
struct SpotTurn {
  std::string name;
  double centre_x_m = 0;  ///< what it turns about, on the map
  double centre_y_m = 0;
  double heading_rad = 0;  ///< at the start
  double angle_rad = 0;    ///< to turn through, left positive, not 0
  double rate_rad_s = 0;   ///< above 0
};

/// The time step of the turn when it is driven.
double turning_step_s(double rate_rad_s, const Vehicle& vehicle);

/// Judges a turn twice, as `evaluate` judges a path: as steady turns on the spot at headings at
/// most 5 deg apart, and by turning, from rest to rest. The way along it is that of the outermost
/// wheel, the deviation how far the point that it turns about moves. \pre `can_turn_on_the_spot` of
/// the vehicle \throws ValueError as `validate(settings)`
PathEvaluation evaluate(const World& verdict, const SpotTurn& turn,
                        const EvaluationSettings& settings);

}  // namespace regoplan
