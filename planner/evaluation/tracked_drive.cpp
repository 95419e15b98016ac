#include "planner/evaluation/tracked_drive.h"

#include <cmath>
#include <utility>

namespace regoplan {

TrackedDrive::TrackedDrive(const World& world, const VehicleState& start, double step_s,
                           double deviation_max_m, std::stop_token stop)
    : world_(world), deviation_max_m_(deviation_max_m), stop_(std::move(stop)) {
  now_.state = start;
  run_.step_s = step_s;
}

std::optional<TrackingEnd> TrackedDrive::begin() {
  record();
  return allowed() ? std::nullopt : std::optional(TrackingEnd::kRejected);
}

std::optional<TrackingEnd> TrackedDrive::advance(const VehicleControl& control) {
  const StepResult step = world_.dynamics().step(now_.state, control, run_.step_s);
  now_.time_s += run_.step_s;
  if (!step.converged) {
    if (step.on_known_ground) return TrackingEnd::kDynamics;
    now_.state = step.state;
    run_.rejected = RejectedState{
        .reason = Rejection::kUnknownTerrain, .x_m = now_.state.x_m, .y_m = now_.state.y_m};
    return TrackingEnd::kRejected;
  }
  now_.state = step.state;
  now_.strain = step.strain;
  run_.energy_j += step.drive_energy_j;
  now_.energy_j = run_.energy_j;
  return std::nullopt;
}

std::optional<TrackingEnd> TrackedDrive::judge(const Place& place) {
  now_.s_m = place.s_m;
  now_.offset_m = place.offset_m;
  const double away_m = std::abs(place.offset_m);
  if (away_m > run_.deviation_max_m) {
    run_.deviation_max_m = away_m;
    run_.deviation_at = {now_.state.x_m, now_.state.y_m};
  }
  record();
  if (!allowed()) return TrackingEnd::kRejected;
  if (away_m > deviation_max_m_) return TrackingEnd::kStrayed;
  return std::nullopt;
}

bool TrackedDrive::allowed() {
  run_.rejected = world_.rejected(now_.state, now_.strain, std::nullopt);
  return !run_.rejected;
}

void TrackedDrive::record() {
  run_.strain_max = largest_of(run_.strain_max, now_.strain);
  if (!run_.moments.empty() && now_.s_m < run_.moments.back().s_m + TrackingRun::kRecordEvery_m) {
    return;
  }
  run_.moments.push_back(now_);
}

TrackingRun TrackedDrive::finish(TrackingEnd end) {
  run_.end = end;
  run_.last = now_;
  run_.duration_s = now_.time_s;
  return std::move(run_);
}

}  // namespace regoplan
