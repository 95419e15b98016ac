#pragma once

#include <cstdint>
#include <vector>

#include "driving/drive_truth.h"
#include "maps/ground_finder.h"
#include "planner/problem/planning_problem.h"

namespace regoplan::drives {

/// Ground that the map does not show: waves of all directions, 6 to 20 m long, whose heights add up
/// to a given standard deviation.
class UnmappedRoughness {
 public:
  UnmappedRoughness(double height_std_m, std::uint64_t seed);

  /// Adds slopes and curvature of a place to a patch.
  void add_to(GroundPatch& patch, double x_m, double y_m, double yaw_rad) const;

 private:
  struct Wave {
    double kx_1pm = 0, ky_1pm = 0, phase_rad = 0;
  };
  std::vector<Wave> waves_;
  double height_m_ = 0;  ///< of each
};

/// The ground that a truth conceals under a planned map: its soils, zones, and place.
class IndependentGround {
 public:
  /// \param planned must outlive it \throws InputError for a truth with what is not simulated here:
  /// mechanisms, zone rasters, ruts, borders moved alone, radii
  IndependentGround(const PlanningProblem& planned, const DriveTruth& truth, double roughness_m,
                    std::uint64_t seed);

  /// Of the known vehicle at a place. Soils count as in `soils()`.
  GroundPatch operator()(double x_m, double y_m, double yaw_rad) const;

  /// Those of the map, then those of the zones.
  std::vector<Soil> soils() const;

 private:
  const PlanningProblem& planned_;
  DriveTruth truth_;
  GroundFinder finder_;
  UnmappedRoughness roughness_;
};

}  // namespace regoplan::drives
