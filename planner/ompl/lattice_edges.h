#pragma once

#include <cstdint>
#include <vector>

#include "planner/ompl/drive.h"

namespace regoplan {

/// How finely a lattice looks.
struct LatticeResolution {
  double cell_m = 0;    ///< of the places that count as one
  int headings = 0;     ///< that a turn is divided into
  int speeds = 0;       ///< that the speeds up to the largest are divided into
  double travel_m = 0;  ///< of a drive
  int curvatures = 0;   ///< to either side
  bool reverse = false;
  double speed_max_mps = 0;  ///< of its drives, at most the problem's
};

/// The resolutions that a lattice goes through, the coarsest first: forward, then in reverse too.
/// Scaled by the vehicle's tightest turn.
std::vector<LatticeResolution> lattice_resolutions(const PlanningProblem& problem);

/// Which states count as one.
std::uint64_t lattice_cell(const LatticeResolution& resolution, const PlanningProblem& problem,
                           const VehicleState& state);

/// The drives to try from a state: to a few speeds, on a few curvatures of what the soil can hold
/// at the fastest speed on the way, and toward the place ahead on the cheapest way.
std::vector<Drive> lattice_drives(const LatticeResolution& resolution, const OmplProblem& problem,
                                  const VehicleState& from);

/// Roughly where a drive ends, without slip, slopes or obstacles: good enough to choose which drive
/// to try first.
VehicleState rough_end(const Vehicle& vehicle, const VehicleState& from, const Drive& drive,
                       double step_s);

/// Roughly what the way from a state to the goal costs: `CostToGo`, the turn toward it, the time to
/// reach the top speed; infinite where there is no way.
double rough_cost_to_go(const LatticeResolution& resolution, const OmplProblem& problem,
                        const VehicleState& state);

}  // namespace regoplan
