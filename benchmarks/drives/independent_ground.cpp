#include "benchmarks/drives/independent_ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "terramech/basics/input_error.h"

namespace regoplan::drives {
namespace {

/// Whether a ray to the east crosses the polygon's border an odd number of times.
bool holds(const std::vector<PathPoint>& corners, double x_m, double y_m) {
  int crossings = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PathPoint &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a.y_m <= y_m) == (b.y_m <= y_m)) continue;
    const double x_there = a.x_m + (y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m);
    if (x_there > x_m) ++crossings;
  }
  return crossings % 2 == 1;
}

void require_simulated(const DriveTruth& truth) {
  const bool radii =
      std::ranges::any_of(truth.wheels, [](const WheelFault& f) { return f.radius_factor != 1; });
  if (!truth.mechanisms.empty() || truth.zone_raster || truth.rut_stiffness || radii ||
      truth.soil_east_m != 0 || truth.soil_north_m != 0) {
    throw InputError(
        "the independent simulator knows no mechanisms, zone rasters, ruts, soil borders and wheel "
        "radii of a truth");
  }
}

}  // namespace

UnmappedRoughness::UnmappedRoughness(double height_std_m, std::uint64_t seed) {
  constexpr int kWaves = 60;
  constexpr double kShortest_m = 6, kLongest_m = 20;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < kWaves; ++i) {
    const double length_m = kShortest_m * std::pow(kLongest_m / kShortest_m, share(random));
    const double k = 2 * std::numbers::pi / length_m;
    const double towards = 2 * std::numbers::pi * share(random);
    waves_.push_back({.kx_1pm = k * std::cos(towards),
                      .ky_1pm = k * std::sin(towards),
                      .phase_rad = 2 * std::numbers::pi * share(random)});
  }
  height_m_ = height_std_m * std::sqrt(2.0 / kWaves);
}

void UnmappedRoughness::add_to(GroundPatch& patch, double x_m, double y_m, double yaw_rad) const {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  for (const Wave& wave : waves_) {
    const double at = wave.kx_1pm * x_m + wave.ky_1pm * y_m + wave.phase_rad;
    const double forward = c * wave.kx_1pm + s * wave.ky_1pm;
    const double left = c * wave.ky_1pm - s * wave.kx_1pm;
    patch.slope_forward += height_m_ * forward * std::cos(at);
    patch.slope_left += height_m_ * left * std::cos(at);
    patch.curvature_1pm -= height_m_ * forward * forward * std::sin(at);
  }
}

IndependentGround::IndependentGround(const PlanningProblem& planned, const DriveTruth& truth,
                                     double roughness_m, std::uint64_t seed)
    : planned_(planned),
      truth_(truth),
      finder_(planned.map, planned.vehicle),
      roughness_(roughness_m, seed) {
  require_simulated(truth);
}

std::vector<Soil> IndependentGround::soils() const {
  std::vector<Soil> soils = truth_.soils;
  if (soils.empty()) {
    for (const MapSoil& soil : planned_.map.soils()) soils.push_back(soil.soil.mean);
  }
  for (const SoilZone& zone : truth_.zones) soils.push_back(zone.soil);
  return soils;
}

GroundPatch IndependentGround::operator()(double x_m, double y_m, double yaw_rad) const {
  GroundPatch patch = finder_.at(x_m - truth_.map_east_m, y_m - truth_.map_north_m, yaw_rad);
  if (!patch.known) return patch;
  roughness_.add_to(patch, x_m, y_m, yaw_rad);
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const std::vector<WheelMount>& wheels = planned_.vehicle.wheels;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const double x = x_m + c * wheels[i].x_m - s * wheels[i].y_m;
    const double y = y_m + s * wheels[i].x_m + c * wheels[i].y_m;
    for (std::size_t zone = truth_.zones.size(); zone-- > 0;) {
      if (!holds(truth_.zones[zone].corners, x, y)) continue;
      patch.soil.at(i) = static_cast<std::int16_t>(planned_.map.soils().size() + zone);
    }
  }
  return patch;
}

}  // namespace regoplan::drives
