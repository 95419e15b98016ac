#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maps/terrain_map.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// What a feasibility chart is drawn for.
struct ChartSettings {
  Vehicle vehicle;
  std::vector<MapSoil> soils;  ///< their means count
  WheelVariant wheel_variant = WheelVariant::kIshigami2007;
  std::vector<Mechanism> mechanisms = {};                   ///< of the wheel model, on every soil
  std::optional<GenericCorrection> generic = std::nullopt;  ///< likewise
  double gravity_mps2 = 9.80665;
  Limits limits;
  std::vector<double> speeds_mps;
  std::vector<double> slopes_rad;  ///< of the ground across the path at which curvatures are sought
  double slope_max_rad = 0;        ///< side slopes from 0 to here, in steps of a degree
  int threads = 2;
};

/// Vehicle, soils, wheel model, gravity and limits of a problem; no speeds and no slopes.
ChartSettings chart_settings(const PlanningProblem& problem);

/// The largest path curvature that is safe at a speed, on the ground that rises to one side: safe
/// to both sides, as are all smaller ones.
struct SafeCurvature {
  int soil = 0;  ///< index in the settings' soils
  double slope_rad = 0;
  double speed_mps = 0;
  double curvature_1pm = 0;  ///< 0 where not even straight on is safe
  std::string limit;         ///< what forbids more: a reason of `Rejection`, or steering
  /// The lateral supply in that turn to either side, the smaller end; 0 where there is none.
  double supply_n = 0;
};

/// Margins of driving straight across a slope; what is missing counts as in `PathMargins`.
struct SideSlope {
  int soil = 0;
  double slope_rad = 0;
  double cornering = 0, tip_over = 0, traction = 0;
  double any_heading = 0;  ///< the smallest of the three over all directions of driving straight on
};

struct FeasibilityChart {
  std::vector<SafeCurvature> curvatures;  ///< by soil, slope, speed
  std::vector<SideSlope> side_slopes;     ///< by soil, slope
};

/// Steady driving on planes, by the direct wheel model at its fast accuracy. Curvatures are found
/// to within 1 % from below.
FeasibilityChart feasibility_chart(const ChartSettings& settings);

/// The steepest side slope, in whole degrees, up to which the smallest margin and the slope itself
/// are allowed; NaN where not even level ground is.
std::vector<double> side_slope_limits_rad(const FeasibilityChart& chart,
                                          const ChartSettings& settings);

/// The smallest stability margin of driving slowly straight on over a slope, whatever the heading;
/// -1 where no trim does.
double straight_on_margin(const ChartSettings& settings, std::size_t soil, double slope_rad);

/// The steepest slope, in whole degrees up to `slope_max_rad`, on which driving straight on keeps
/// the least margin in every direction; nothing where not even level ground does. Sought by
/// bisection: what is steeper is taken to be worse.
std::optional<double> straight_on_limit_rad(const ChartSettings& settings, std::size_t soil);

}  // namespace regoplan
