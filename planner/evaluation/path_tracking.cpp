#include "planner/evaluation/path_tracking.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "planner/evaluation/tracked_drive.h"

namespace regoplan {
namespace {

class Tracker {
 public:
  Tracker(const World& world, const ReferencePath& path, const FollowerChoice& choice,
          double deviation_max_m, const std::stop_token& stop)
      : path_(path),
        follower_(make_follower(choice, world, path)),
        drive_(world, start_of(path, world.problem().vehicle),
               tracking_step_s(path.speed_max_mps()), deviation_max_m, stop) {}

  TrackingRun drive() {
    const double step_s = drive_.step_s();
    const double patience_s = path_.patience_s(step_s);
    if (const auto end = drive_.begin()) return drive_.finish(*end);
    while (!follower_->arrived(step_s)) {
      if (drive_.now().time_s > patience_s) return drive_.finish(TrackingEnd::kStalled);
      const auto end = drive_.step(
          follower_->control(step_s), [&](const VehicleState&, const VehicleState& state) {
            follower_->observe(state, step_s);
            return TrackedDrive::Place{.s_m = follower_->s_m(), .offset_m = follower_->offset_m()};
          });
      if (end) return drive_.finish(*end);
    }
    return drive_.finish(TrackingEnd::kArrived);
  }

 private:
  const ReferencePath& path_;
  std::unique_ptr<Follower> follower_;
  TrackedDrive drive_;
};

}  // namespace

WheelStrain largest_of(const WheelStrain& a, const WheelStrain& b) {
  const auto larger = [](double one, double other) {
    return std::abs(other) > std::abs(one) ? other : one;
  };
  return {.slip = larger(a.slip, b.slip),
          .slip_angle_rad = larger(a.slip_angle_rad, b.slip_angle_rad),
          .sinkage_m = std::max(a.sinkage_m, b.sinkage_m),
          .load_min_n = std::min(a.load_min_n, b.load_min_n),
          .torque_max_nm = larger(a.torque_max_nm, b.torque_max_nm)};
}

double tracking_step_s(double speed_max_mps) {
  constexpr double kTravel_m = 0.05, kLongest_s = 0.25;
  return std::min(kTravel_m / speed_max_mps, kLongest_s);
}

TrackingRun track(const World& world, const ReferencePath& path, const FollowerChoice& follower,
                  double deviation_max_m, const std::stop_token& stop) {
  return Tracker(world, path, follower, deviation_max_m, stop).drive();
}

}  // namespace regoplan
