#include "planner/chart/doubtful_soils.h"

#include <algorithm>

#include "maps/ground_finder.h"
#include "planner/chart/feasibility_chart.h"
#include "planner/soils/soil_uncertainty.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

/// The median slope of each soil's ground where it is known and no steeper than allowed, on a grid
/// of places over the map; 0 of a soil that lies at none of them.
std::vector<double> median_slopes_rad(const PlanningProblem& problem) {
  constexpr int kPlacesASide = 100;
  const GroundFinder ground(problem.map, problem.vehicle);
  const GridFrame& frame = problem.map.elevation().frame;
  std::vector<std::vector<double>> slopes_rad(problem.map.soils().size());
  for (int i = 0; i < kPlacesASide * kPlacesASide; ++i) {
    const int column = i % kPlacesASide, row = i / kPlacesASide;
    const double east = (column + 0.5) / kPlacesASide, south = (row + 0.5) / kPlacesASide;
    const double x_m = frame.west_m + east * frame.columns * frame.cell_width_m;
    const double y_m = frame.north_m - south * frame.rows * frame.cell_height_m;
    const std::optional<int> soil = problem.map.soil_index(x_m, y_m);
    if (!soil) continue;
    const GroundPatch patch = ground.at(x_m, y_m, 0);
    if (!patch.known || patch.tilt_rad() > problem.limits.slope_max_rad) continue;
    slopes_rad[static_cast<std::size_t>(*soil)].push_back(patch.tilt_rad());
  }
  std::vector<double> medians;
  for (std::vector<double>& of_soil : slopes_rad) {
    const auto middle = of_soil.begin() + static_cast<std::ptrdiff_t>(of_soil.size() / 2);
    std::nth_element(of_soil.begin(), middle, of_soil.end());
    medians.push_back(of_soil.empty() ? 0 : *middle);
  }
  return medians;
}

}  // namespace

std::vector<std::string> doubtful_soils(const PlanningProblem& problem) {
  constexpr std::size_t kDraws = 20;
  constexpr std::ptrdiff_t kMostBroken = kDraws / 20;
  const std::vector<MapSoil>& soils = problem.map.soils();
  std::vector<std::size_t> uncertain;
  for (std::size_t i = 0; i < soils.size(); ++i) {
    if (is_uncertain(soils[i])) uncertain.push_back(i);
  }
  if (uncertain.empty()) return {};
  std::vector<SoilDraw> draws;
  for (std::size_t k = 0; k < kDraws; ++k) {
    draws.push_back(soil_draw(problem, problem.search.seed, static_cast<int>(k)));
  }
  const std::vector<double> slopes_rad = median_slopes_rad(problem);
  const ChartSettings at_means = chart_settings(problem);
  std::vector<ChartSettings> at_draws(kDraws, at_means);
  for (std::size_t k = 0; k < kDraws; ++k) {
    for (const std::size_t i : uncertain) at_draws[k].soils[i].soil.mean = draws[k][i];
  }
  std::vector<double> margins(kDraws * uncertain.size());
  parallel_for(margins.size(), problem.search.threads, [&](std::size_t m) {
    const std::size_t soil = uncertain[m / kDraws];
    margins[m] = straight_on_margin(at_draws[m % kDraws], soil, slopes_rad[soil]);
  });
  std::vector<std::string> doubtful;
  for (std::size_t u = 0; u < uncertain.size(); ++u) {
    const std::size_t i = uncertain[u];
    const auto first = margins.begin() + static_cast<std::ptrdiff_t>(u * kDraws);
    const auto broken = std::count_if(
        first, first + kDraws, [&](double margin) { return margin < problem.limits.margin_min; });
    if (broken > kMostBroken &&
        straight_on_margin(at_means, i, slopes_rad[i]) >= problem.limits.margin_min) {
      doubtful.push_back(soils[i].name);
    }
  }
  return doubtful;
}

}  // namespace regoplan
