#pragma once

#include <optional>
#include <vector>

#include "planner/following/follower.h"

namespace regoplan {

/// What the trims of the planner's model need along a leg of a path, at its speeds: the steering
/// that gives the lateral force which curvature and side slope demand, the rim speed that gives the
/// force along the path, and for vehicles that crab the angle that keeps them headed along it.
/// Solved at stations an eighth of a wheelbase apart, linear between.
///
/// Beyond the steady trim it counts that the vehicle takes up its slip angle b while it goes on
/// (yaw rate v (k - db/ds)) and that its turning has to be sped up (moment I dr/dt).
///
/// Where a leg brings a record of its steering, as a candidate of `plan` does, that record holds
/// all of this, transients included, and stands in place of the trims' steering. Where there is no
/// trim, as on ground that is unknown, driving is taken to be free of slip.
class TrimSchedule {
 public:
  /// \param planned is only asked while this is made
  TrimSchedule(const World& planned, const PathLeg& leg);

  FeedForward at(double s_m) const;
  /// What the trims slip there; nothing where there is no trim.
  ForeseenSlip slip_at(double s_m) const;

 private:
  struct Station {
    FeedForward forward;
    ForeseenSlip slip;
  };
  struct Between;  ///< two stations, and where between them
  Between between(double s_m) const;

  double apart_m_ = 1;
  std::vector<Station> stations_;
};

}  // namespace regoplan
