#pragma once

#include <optional>
#include <stop_token>

#include "planner/evaluation/path_tracking.h"

namespace regoplan {

/// A drive in closed loop while it goes on: its steps, what is judged at each, and the record of
/// it, whatever is to be kept to.
class TrackedDrive {
 public:
  /// Where the vehicle is, measured on what it should keep to.
  struct Place {
    double s_m = 0;
    double offset_m = 0;  ///< signed or not; by magnitude it counts as deviation
  };

  /// \param world must outlive it \param stop ends the drive with its next step
  TrackedDrive(const World& world, const VehicleState& start, double step_s, double deviation_max_m,
               std::stop_token stop);

  const TrackingRun::Moment& now() const { return now_; }
  double step_s() const { return run_.step_s; }

  /// Judges the start. \returns why the drive ends there
  std::optional<TrackingEnd> begin();

  /// One step. \param locate the place by (state before, state now) \returns why the drive ends
  /// with it
  template <class Locate>
  std::optional<TrackingEnd> step(const VehicleControl& control, Locate locate) {
    if (stop_.stop_requested()) return TrackingEnd::kInterrupted;
    const VehicleState before = now_.state;
    if (const auto end = advance(control)) return end;
    const Place place = locate(before, now_.state);
    return judge(place);
  }

  /// Ends the record.
  TrackingRun finish(TrackingEnd end);

 private:
  std::optional<TrackingEnd> advance(const VehicleControl& control);
  std::optional<TrackingEnd> judge(const Place& place);
  bool allowed();
  void record();

  const World& world_;
  double deviation_max_m_;
  std::stop_token stop_;
  TrackingRun::Moment now_;
  TrackingRun run_;
};

}  // namespace regoplan
