#include "planner/following/trim_schedule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regoplan {
namespace {

using std::numbers::pi;

/// A station's trim.
struct Trimmed {
  double steer_curvature_1pm = 0;
  double body_slip_angle_rad = 0;
  double drive_factor = 1;
  double crab_rad = 0;
};

/// Solves one station after the other, each from the trim of the one before.
class StationSolver {
 public:
  StationSolver(const World& planned, const PathLeg& leg)
      : world_(planned), vehicle_(planned.problem().vehicle), leg_(leg) {}

  std::optional<Trimmed> solve(double s_m) {
    const VehicleDynamics& dynamics = world_.dynamics();
    VehicleState state = leg_.state_at(vehicle_, s_m);
    const double sign = leg_.direction();
    state.curvature_1pm = std::clamp(sign * leg_.curve.at(s_m).curvature_1pm,
                                     -vehicle_.curvature_max_1pm, vehicle_.curvature_max_1pm);
    const GroundPatch patch = dynamics.ground(state.x_m, state.y_m, state.yaw_rad);
    if (!patch.known) return std::nullopt;
    std::vector<WheelLaw> laws;
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      laws.push_back(world_.soil_laws()[static_cast<std::size_t>(patch.soil.at(i))]);
    }
    std::optional<Trimmed> trimmed;
    // A crab angle that takes up all of the slip angle is found by taking off what is left of it.
    const int rounds = vehicle_.steering == Steering::kCrab ? 4 : 1;
    for (int round = 0; round < rounds; ++round) {
      state.crab_rad = crab_rad_;
      trimmed = solve(state, patch, laws, s_m);
      if (!trimmed) return std::nullopt;
      if (round + 1 < rounds) crab_rad_ -= trimmed->body_slip_angle_rad;
    }
    return trimmed;
  }

 private:
  std::optional<Trimmed> solve(const VehicleState& state, const GroundPatch& patch,
                               const std::vector<WheelLaw>& laws, double s_m) {
    const SupplyQuestion question = question_of(world_.dynamics(), state, patch);
    if (!(question.normal_n > 0)) return std::nullopt;
    const SteadyManoeuvre manoeuvre =
        manoeuvre_of(vehicle_, world_.dynamics().sharing(), laws, question);
    const ForceLine line{.from = {.forward_n = question.force.forward_n,
                                  .left_n = question.force.left_n,
                                  .yaw_nm = turning_nm(s_m)},
                         .per_unit = {}};
    std::optional<SteadyManoeuvre::Point> point;
    if (last_) point = manoeuvre.solve(*last_, line);
    if (!point) point = manoeuvre.solve_from_rolling(line);
    last_ = point;
    if (!point) return std::nullopt;
    const Trim trim = manoeuvre.trim(*point, line);
    return Trimmed{.steer_curvature_1pm = trim.steer_curvature_1pm,
                   .body_slip_angle_rad = trim.body_slip_angle_rad,
                   .drive_factor = trim.drive_factor,
                   .crab_rad = state.crab_rad};
  }

  /// Moment that speeds the turning up as the path asks: I d(v k)/dt.
  double turning_nm(double s_m) const {
    const double reach_m = wheelbase_m(vehicle_) / 4;
    const double from = std::max(s_m - reach_m, 0.0);
    const double to = std::min(s_m + reach_m, leg_.curve.length_m());
    const double per_m =
        (leg_.curve.at(to).curvature_1pm - leg_.curve.at(from).curvature_1pm) / (to - from);
    const SpeedProfile::Value speed = leg_.speed.at(s_m);
    return vehicle_.yaw_inertia_kgm2 * (speed.speed_mps * speed.speed_mps * per_m +
                                        speed.acceleration_mps2 * leg_.curve.at(s_m).curvature_1pm);
  }

  const World& world_;
  const Vehicle& vehicle_;
  const PathLeg& leg_;
  std::optional<SteadyManoeuvre::Point> last_;
  double crab_rad_ = 0;
};

/// What a record tells of the slip that it was driven with; near rest it tells nothing.
void add_recorded(const Vehicle& vehicle, const PathLeg& leg, double s_m, ForeseenSlip& slip) {
  const VehicleState recorded = leg.recorded_at(s_m);
  const double speed_mps = recorded.motion.vx_mps;
  if (std::abs(speed_mps) < 0.1 * leg.speed.speed_max_mps()) return;
  const double k = recorded.curvature_1pm;
  const double course_rad = leg.curve.at(s_m).heading_rad + (speed_mps < 0 ? pi : 0);
  slip.slip_angle_rad = std::remainder(
      course_rad - recorded.yaw_rad - kinematic_body_slip_angle_rad(vehicle, k), 2 * pi);
  slip.curvature_1pm = recorded.motion.yaw_rate_rad_s / speed_mps - k;
}

}  // namespace

TrimSchedule::TrimSchedule(const World& planned, const PathLeg& leg) {
  const Vehicle& vehicle = planned.problem().vehicle;
  const double length_m = leg.curve.length_m();
  constexpr double kMost = 40000;  // stations: of longer paths they lie farther apart
  const double apart_m = std::max(wheelbase_m(vehicle) / 8, length_m / kMost);
  const auto pieces = std::max(2, static_cast<int>(std::ceil(length_m / apart_m)));
  apart_m_ = length_m / pieces;

  StationSolver solver(planned, leg);
  std::vector<std::optional<Trimmed>> trims;
  for (int i = 0; i <= pieces; ++i) trims.push_back(solver.solve(i * apart_m_));

  const double direction = leg.direction();
  const auto slip_angle_per_m = [&](std::size_t i) {
    constexpr std::size_t kReach = 2;
    const std::size_t from = i < kReach ? 0 : i - kReach;
    const std::size_t to = std::min(i + kReach, trims.size() - 1);
    if (!trims[from] || !trims[to]) return 0.0;
    return (trims[to]->body_slip_angle_rad - trims[from]->body_slip_angle_rad) /
           (static_cast<double>(to - from) * apart_m_);
  };
  for (std::size_t i = 0; i < trims.size(); ++i) {
    const double s_m = static_cast<double>(i) * apart_m_;
    Station station{.forward = {.curvature_1pm = leg.curvature_1pm(s_m)}, .slip = {}};
    if (const auto& trim = trims[i]) {
      if (leg.recorded.empty()) {
        station.forward.curvature_1pm = trim->steer_curvature_1pm - direction * slip_angle_per_m(i);
      }
      station.forward.rim_per_speed = trim->drive_factor;
      station.forward.crab_rad = trim->crab_rad;
      const double slip_free_rad =
          kinematic_body_slip_angle_rad(vehicle, trim->steer_curvature_1pm) + trim->crab_rad;
      station.slip = {
          .from_trims = true,
          .speed_ratio = 1 / trim->drive_factor,
          .slip_angle_rad = trim->body_slip_angle_rad - slip_free_rad,
          .curvature_1pm = direction * leg.curve.at(s_m).curvature_1pm - trim->steer_curvature_1pm};
    }
    if (!leg.recorded.empty()) add_recorded(vehicle, leg, s_m, station.slip);
    stations_.push_back(station);
  }
}

struct TrimSchedule::Between {
  const Station &before, &after;
  double share = 0;

  double of(double from, double to) const { return from + share * (to - from); }
};

TrimSchedule::Between TrimSchedule::between(double s_m) const {
  const double u = std::clamp(s_m / apart_m_, 0.0, static_cast<double>(stations_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(u), stations_.size() - 2);
  return {stations_[i], stations_[i + 1], u - static_cast<double>(i)};
}

FeedForward TrimSchedule::at(double s_m) const {
  const Between here = between(s_m);
  const FeedForward &a = here.before.forward, &b = here.after.forward;
  return {.curvature_1pm = here.of(a.curvature_1pm, b.curvature_1pm),
          .rim_per_speed = here.of(a.rim_per_speed, b.rim_per_speed),
          .crab_rad = here.of(a.crab_rad, b.crab_rad)};
}

ForeseenSlip TrimSchedule::slip_at(double s_m) const {
  const Between here = between(s_m);
  const ForeseenSlip &a = here.before.slip, &b = here.after.slip;
  return {.from_trims = a.from_trims && b.from_trims,
          .speed_ratio = here.of(a.speed_ratio, b.speed_ratio),
          .slip_angle_rad = here.of(a.slip_angle_rad, b.slip_angle_rad),
          .curvature_1pm = here.of(a.curvature_1pm, b.curvature_1pm)};
}

}  // namespace regoplan
