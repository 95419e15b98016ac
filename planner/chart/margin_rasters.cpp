#include "planner/chart/margin_rasters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/ground_finder.h"
#include "planner/chart/feasibility_chart.h"
#include "planner/soils/soil_uncertainty.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

constexpr int kSideMax = 1024;
constexpr double kSpeedShares[] = {0.25, 0.5, 0.75, 1};
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

ChartSettings raster_settings(const PlanningProblem& problem) {
  ChartSettings settings = chart_settings(problem);
  for (const double share : kSpeedShares) {
    settings.speeds_mps.push_back(share * problem.speed_max_mps);
  }
  constexpr double kStep_rad = 5 * kDegree;
  for (int i = 0; i * kStep_rad < problem.limits.slope_max_rad; ++i) {
    settings.slopes_rad.push_back(i * kStep_rad);
  }
  settings.slopes_rad.push_back(problem.limits.slope_max_rad);
  return settings;
}

/// A function of the slope, linear between its nodes; beyond the last that of the last.
struct OverSlope {
  std::vector<double> slopes_rad, values;

  double at(double slope_rad) const {
    const auto next = std::ranges::upper_bound(slopes_rad, slope_rad);
    if (next == slopes_rad.begin()) return values.front();
    if (next == slopes_rad.end()) return values.back();
    const auto k = static_cast<std::size_t>(next - slopes_rad.begin());
    const double share = (slope_rad - slopes_rad[k - 1]) / (slopes_rad[k] - slopes_rad[k - 1]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
  }
};

std::vector<OverSlope> margins_of(const FeasibilityChart& chart, std::size_t soils) {
  std::vector<OverSlope> margins(soils);
  for (const SideSlope& at : chart.side_slopes) {
    OverSlope& margin = margins[static_cast<std::size_t>(at.soil)];
    margin.slopes_rad.push_back(at.slope_rad);
    margin.values.push_back(at.any_heading);
  }
  return margins;
}

std::vector<OverSlope> supplies_of(const FeasibilityChart& chart, std::size_t soils,
                                   double speed_mps) {
  std::vector<OverSlope> supplies(soils);
  for (const SafeCurvature& at : chart.curvatures) {
    if (at.speed_mps != speed_mps) continue;
    OverSlope& supply = supplies[static_cast<std::size_t>(at.soil)];
    supply.slopes_rad.push_back(at.slope_rad);
    supply.values.push_back(at.supply_n);
  }
  return supplies;
}

/// The grid of the rasters: that of the elevation, with larger cells where it has many.
GridFrame raster_frame(const TerrainMap& map) {
  GridFrame frame = map.elevation().frame;
  const int factor = (std::max(frame.columns, frame.rows) + kSideMax - 1) / kSideMax;
  frame.columns = (frame.columns + factor - 1) / factor;
  frame.rows = (frame.rows + factor - 1) / factor;
  frame.cell_width_m *= factor;
  frame.cell_height_m *= factor;
  return frame;
}

/// The ground of a cell.
struct Cell {
  std::size_t soil = 0;
  double slope_rad = kNone;  ///< NaN: where none of this is known
};

std::vector<Cell> cells_of(const PlanningProblem& problem, const GridFrame& frame) {
  const GroundFinder ground(problem.map, problem.vehicle);
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows));
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const double x_m = frame.west_m + (column + 0.5) * frame.cell_width_m;
      const double y_m = frame.north_m - (row + 0.5) * frame.cell_height_m;
      const std::optional<int> soil = problem.map.soil_index(x_m, y_m);
      const GroundPatch patch = soil ? ground.at(x_m, y_m, 0) : GroundPatch{};
      const double tilt = patch.tilt_rad();
      if (!patch.known || tilt > steepest_held_rad(problem.limits)) {
        cells.push_back({});
      } else {
        cells.push_back({.soil = static_cast<std::size_t>(*soil),
                         .slope_rad = std::min(tilt, problem.limits.slope_max_rad)});
      }
    }
  }
  return cells;
}

std::vector<float> raster_of(const std::vector<Cell>& cells, const std::vector<OverSlope>& soils) {
  std::vector<float> values;
  values.reserve(cells.size());
  for (const Cell& cell : cells) {
    values.push_back(static_cast<float>(
        std::isnan(cell.slope_rad) ? kNone : soils[cell.soil].at(cell.slope_rad)));
  }
  return values;
}

}  // namespace

TerrainRasters terrain_rasters(const PlanningProblem& problem) {
  const ChartSettings settings = raster_settings(problem);
  const FeasibilityChart chart = feasibility_chart(settings);
  TerrainRasters rasters{.frame = raster_frame(problem.map),
                         .margin = {},
                         .probability = {},
                         .speeds_mps = settings.speeds_mps,
                         .supply_n = {}};
  const std::vector<Cell> cells = cells_of(problem, rasters.frame);
  const std::size_t soils = settings.soils.size();
  rasters.margin = raster_of(cells, margins_of(chart, soils));
  for (const double speed_mps : settings.speeds_mps) {
    rasters.supply_n.push_back(raster_of(cells, supplies_of(chart, soils, speed_mps)));
  }
  return rasters;
}

std::vector<float> straight_on_probability(const PlanningProblem& problem) {
  const std::size_t soils = problem.map.soils().size();
  constexpr std::size_t kDraws = 20;
  const std::size_t count = has_uncertain_soil(problem) ? kDraws : 1;
  std::vector<ChartSettings> draws(count, raster_settings(problem));
  for (std::size_t k = 0; k < count; ++k) {
    const SoilDraw draw = soil_draw(problem, problem.search.seed, static_cast<int>(k));
    for (std::size_t soil = 0; soil < soils; ++soil) draws[k].soils[soil].soil.mean = draw[soil];
  }
  std::vector<std::optional<double>> limits_rad(count * soils);
  parallel_for(limits_rad.size(), problem.search.threads, [&](std::size_t i) {
    limits_rad[i] = straight_on_limit_rad(draws[i / soils], i % soils);
  });
  std::vector<float> probability;
  for (const Cell& cell : cells_of(problem, raster_frame(problem.map))) {
    if (std::isnan(cell.slope_rad)) {
      probability.push_back(static_cast<float>(kNone));
      continue;
    }
    int bears = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::optional<double>& limit_rad = limits_rad[k * soils + cell.soil];
      bears += limit_rad && cell.slope_rad <= *limit_rad;
    }
    probability.push_back(static_cast<float>(bears) / static_cast<float>(count));
  }
  return probability;
}

}  // namespace regoplan
