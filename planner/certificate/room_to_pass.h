#pragma once

#include <vector>

#include "maps/rock_index.h"
#include "planner/problem/known_ground.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Roughly how much room there is to pass a place: between rocks in the vehicle's way and beside
/// unknown ground, whatever the heading. For guidance only.
class RoomToPass {
 public:
  /// \param problem must outlive it
  explicit RoomToPass(const PlanningProblem& problem);

  struct Place {
    double x_m = 0, y_m = 0;
    /// Beside a vehicle that passes there, to either side; below 0 where it cannot, at most
    /// `kPlenty_m`.
    double room_m = 0;
  };
  static constexpr double kPlenty_m = 1;

  /// The roomiest place in a square; its middle where that has plenty.
  Place roomiest(double x_m, double y_m, double half_m);

 private:
  struct Circle {
    double x_m = 0, y_m = 0, radius_m = 0;
  };
  /// Finds what a vehicle in the square must keep off.
  void gather(double x_m, double y_m, double half_m);
  double room_m(double x_m, double y_m) const;

  const TerrainMap& map_;
  RockIndex rocks_;  ///< those in the way
  KnownGround known_;
  double half_width_m_;  ///< of the body
  double half_track_m_;  ///< of the outermost contacts
  std::vector<Circle> near_;
};

}  // namespace regoplan
