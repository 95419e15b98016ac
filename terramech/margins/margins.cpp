#include "terramech/margins/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace regoplan {
namespace {

double cross(const WheelMount& o, const WheelMount& a, const WheelMount& b) {
  return (a.x_m - o.x_m) * (b.y_m - o.y_m) - (a.y_m - o.y_m) * (b.x_m - o.x_m);
}

/// Convex hull of the wheels, counter-clockwise, by the monotone chain.
std::vector<WheelMount> hull(std::vector<WheelMount> wheels) {
  std::sort(wheels.begin(), wheels.end(), [](const WheelMount& a, const WheelMount& b) {
    return a.x_m < b.x_m || (a.x_m == b.x_m && a.y_m < b.y_m);
  });
  std::vector<WheelMount> chain;
  const auto add_half = [&](auto first, auto last) {
    const std::size_t base = chain.size();
    for (auto wheel = first; wheel != last; ++wheel) {
      while (chain.size() >= base + 2 &&
             cross(chain[chain.size() - 2], chain.back(), *wheel) <= 0) {
        chain.pop_back();
      }
      chain.push_back(*wheel);
    }
    chain.pop_back();
  };
  add_half(wheels.begin(), wheels.end());
  add_half(wheels.rbegin(), wheels.rend());
  return chain;
}

}  // namespace

double cornering_demand_n(double mass_kg, double speed_mps, double curvature_1pm,
                          double gravity_left_mps2) {
  return mass_kg * (speed_mps * speed_mps * curvature_1pm - gravity_left_mps2);
}

double cornering_margin(double demand_n, double supply_right_n, double supply_left_n,
                        double weight_n) {
  return std::min(supply_left_n - demand_n, demand_n - supply_right_n) / weight_n;
}

SupportPolygon::SupportPolygon(const Vehicle& vehicle) : cg_height_m_(vehicle.cg_height_m) {
  const std::vector<WheelMount> corners = hull(vehicle.wheels);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const WheelMount& from = corners[i];
    const WheelMount& to = corners[(i + 1) % corners.size()];
    const double length = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    const double nx = (to.y_m - from.y_m) / length, ny = -(to.x_m - from.x_m) / length;
    edges_.push_back({.distance_m = nx * from.x_m + ny * from.y_m, .normal_x = nx, .normal_y = ny});
  }
}

double SupportPolygon::tip_over_margin(const GroundReaction& reaction) const {
  if (!(reaction.normal_n > 0)) return -1;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges_) {
    const double outward = -(reaction.forward_n * edge.normal_x + reaction.left_n * edge.normal_y);
    smallest =
        std::min(smallest, 1 - outward * cg_height_m_ / (reaction.normal_n * edge.distance_m));
  }
  return smallest;
}

}  // namespace regoplan
