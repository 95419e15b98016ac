#pragma once

#include <vector>

#include "terramech/margins/supply.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Lateral force that the wheels must give, m (v^2 k - g_left), newtons, left positive.
/// \param curvature_1pm commanded path curvature \param gravity_left_mps2 component of gravity
/// along the path's left
double cornering_demand_n(double mass_kg, double speed_mps, double curvature_1pm,
                          double gravity_left_mps2);

/// min(A+ - D, D - A-)/(m g): below 0 the cornering force falls below the demand.
double cornering_margin(double demand_n, double supply_right_n, double supply_left_n,
                        double weight_n);

/// Support polygon of a vehicle: for each edge its distance from the centre of gravity's foot and
/// its outward normal.
class SupportPolygon {
 public:
  explicit SupportPolygon(const Vehicle& vehicle);

  /// The smallest over the edges of 1 - (f . n) h_cg / (f_down d), with f = g - a at the centre of
  /// gravity; -1 where f_down <= 0. Told by what the ground carries: f = -reaction / m.
  double tip_over_margin(const GroundReaction& reaction) const;

 private:
  struct Edge {
    double distance_m = 0;
    double normal_x = 0, normal_y = 0;
  };
  std::vector<Edge> edges_;
  double cg_height_m_;
};

}  // namespace regoplan
