#include "planner/following/follower.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/following/trim_schedule.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

/// Slower, as a share of the path's top speed, a vehicle has no course.
constexpr double kStands = 0.01;

double angle_between(double to_rad, double from_rad) {
  return std::remainder(to_rad - from_rad, 2 * std::numbers::pi);
}

class PursuitFollower : public Follower {
 public:
  using Follower::Follower;

 protected:
  FeedForward ahead(std::size_t leg, double s_m) const override {
    return {.curvature_1pm = path().legs[leg].curvature_1pm(s_m)};
  }
  ForeseenSlip foreseen_at(std::size_t, double) const override { return {}; }
};

/// Steering angles and rim speeds that the trims need are fed forward, as in G. Ishigami,
/// K. Nagatani, K. Yoshida, "Slope traversal controls for planetary exploration rover on sandy
/// terrain", J. Field Robotics 26 (2009) 264-286, and D. Helmick et al., "Slip-compensated path
/// following for planetary exploration rovers", Advanced Robotics 20 (2006) 1257-1280.
class CompensatedFollower : public Follower {
 public:
  CompensatedFollower(const World& planned, const ReferencePath& path, const SteeringLaw& law)
      : Follower(planned.problem().vehicle, path, law) {
    for (const PathLeg& leg : path.legs) schedules_.emplace_back(planned, leg);
  }

 protected:
  FeedForward ahead(std::size_t leg, double s_m) const override { return schedules_[leg].at(s_m); }
  ForeseenSlip foreseen_at(std::size_t leg, double s_m) const override {
    return schedules_[leg].slip_at(s_m);
  }
  double slip_memory_m() const override { return 3 * wheelbase_m(vehicle()); }

 private:
  std::vector<TrimSchedule> schedules_;  // one a leg
};

/// The caller's own, held to the vehicle's range.
class OwnFollowerCaller : public Follower {
 public:
  OwnFollowerCaller(const Vehicle& vehicle, const ReferencePath& path, const FollowerChoice& choice)
      : Follower(vehicle, path, choice.law), own_(choice.own) {}

 protected:
  FeedForward ahead(std::size_t leg, double s_m) const override {
    return {.curvature_1pm = path().legs[leg].curvature_1pm(s_m)};
  }
  ForeseenSlip foreseen_at(std::size_t, double) const override { return {}; }

  VehicleControl follow(double step_s) const override {
    const VehicleControl control = own_(view(step_s));
    const auto hold = [](const char* what, double value, double most) {
      if (std::abs(value) <= most) return;
      throw InputError(fmt::format("follower: {}: {} is not valid (allowed: {} to {})", what, value,
                                   -most, most));
    };
    hold("speed_mps", control.speed_target_mps, vehicle().speed_max_mps);
    hold("curvature_1pm", control.curvature_target_1pm, vehicle().curvature_max_1pm);
    const bool crabs = vehicle().steering == Steering::kCrab;
    hold("crab_rad", control.crab_target_rad, crabs ? std::numbers::pi / 2 : 0);
    return control;
  }

 private:
  OwnFollower own_;
};

}  // namespace

std::string_view name(FollowerKind kind) {
  if (kind == FollowerKind::kOwn) return "own";
  return follower_names().at(static_cast<std::size_t>(kind));
}

std::vector<std::string_view> follower_names() {
  return {"pursuit", "compensated"};
}

FollowerKind follower_named(const std::optional<std::string>& name) {
  if (!name) return FollowerChoice{}.kind;
  const std::vector<std::string_view> names = follower_names();
  const auto found = std::ranges::find(names, *name);
  if (found == names.end()) {
    throw InputError(
        fmt::format("follower: '{}' is none (allowed: {})", *name, fmt::join(names, " | ")));
  }
  return static_cast<FollowerKind>(found - names.begin());
}

void Follower::foresee_braking() {
  constexpr double kRateShare = 0.98;  // what is left makes up for what was not foreseen
  for (std::size_t leg = 0; leg < path_.legs.size(); ++leg) {
    braking_.emplace_back(path_.legs[leg], wheelbase_m(vehicle_) / 8,
                          kRateShare * vehicle_.acceleration_max_mps2, [this, leg](double s_m) {
                            return path_.legs[leg].speed.at(s_m).speed_mps *
                                   ahead(leg, s_m).rim_per_speed;
                          });
  }
}

Follower::Follower(const Vehicle& vehicle, const ReferencePath& path, const SteeringLaw& law)
    : vehicle_(vehicle),
      path_(path),
      law_(law),
      speed_top_mps_(path.speed_max_mps()),
      seen_(start_of(path, vehicle)) {}

double Follower::speed() const {
  return std::hypot(seen_.motion.vx_mps, seen_.motion.vy_mps);
}

double Follower::foreseen_slip_angle_rad() const {
  return kinematic_body_slip_angle_rad(vehicle_, seen_.curvature_1pm) + seen_.crab_rad +
         foreseen().slip_angle_rad;
}

void Follower::observe(const VehicleState& seen, double step_s) {
  seen_ = seen;
  time_s_ += step_s;
  if (!changes_direction_ && leg_ + 1 < path_.legs.size() && at_end_of_leg(step_s)) {
    changes_direction_ = true;
  }
  if (changes_direction_ && ready_for_next_leg()) {
    changes_direction_ = false;
    ++leg_;
    s_m_ = 0;
  }
  s_m_ = nearest_m(now().curve, seen.x_m, seen.y_m, s_m_);
  offset_m_ = regoplan::offset_m(now().curve.at(s_m_), seen.x_m, seen.y_m);
  const BodyMotion& motion = seen.motion;
  const double direction = now().direction();
  // At rest there is no course; the heading tells where it will go.
  if (speed() > kStands * speed_top_mps_) {
    const double way_m = speed() * step_s;
    const double angle = std::atan2(direction * motion.vy_mps, direction * motion.vx_mps);
    unforeseen_rad_ +=
        way_m / (way_m + slip_memory_m()) * (angle - foreseen_slip_angle_rad() - unforeseen_rad_);
  } else {
    unforeseen_rad_ = 0;
  }
  const double expected = direction * seen.rim_speed_mps / ahead(leg_, s_m_).rim_per_speed;
  if (std::abs(expected) > 0.05 * speed_top_mps_) {
    const double share = step_s / (step_s + law_.slip_memory_s);
    const double ratio = std::clamp(speed() / expected, 0.5, 1.5);
    slip_factor_ += share * (ratio - slip_factor_);
  }
}

bool Follower::at_end_of_leg(double step_s) const {
  const double near_m = std::max(0.02, 2 * speed() * step_s);
  return s_m_ >= now().length_m() - near_m;
}

FeedForward Follower::next_steering() const {
  FeedForward next = ahead(leg_ + 1, 0);
  next.curvature_1pm =
      std::clamp(next.curvature_1pm, -vehicle_.curvature_max_1pm, vehicle_.curvature_max_1pm);
  return next;
}

bool Follower::ready_for_next_leg() const {
  constexpr double kShareOfRange = 1e-3;
  constexpr double kCrab_rad = 1e-3;
  const FeedForward next = next_steering();
  return seen_.rim_speed_mps == 0 && speed() < kStands * speed_top_mps_ &&
         std::abs(next.curvature_1pm - seen_.curvature_1pm) <=
             kShareOfRange * vehicle_.curvature_max_1pm &&
         std::abs(next.crab_rad - seen_.crab_rad) <= kCrab_rad;
}

bool Follower::arrived(double step_s) const {
  return leg_ + 1 == path_.legs.size() && at_end_of_leg(step_s);
}

VehicleControl Follower::control(double step_s) const {
  if (changes_direction_) {
    const bool rolls = seen_.rim_speed_mps != 0;
    const FeedForward next = next_steering();
    return {.speed_target_mps = 0,
            .curvature_target_1pm = rolls ? seen_.curvature_1pm : next.curvature_1pm,
            .crab_target_rad = rolls ? seen_.crab_rad : next.crab_rad};
  }
  return follow(step_s);
}

double Follower::creep_mps(double step_s) const {
  return std::min(0.05 * speed_top_mps_, vehicle_.acceleration_max_mps2 * 4 * step_s);
}

double Follower::path_speed_mps(double step_s) const {
  const double v = speed(), a = vehicle_.acceleration_max_mps2;
  const double ahead_mps = now().speed.at(s_m_ + v * step_s + a * step_s * step_s / 2).speed_mps;
  return now().direction() * std::max(creep_mps(step_s), ahead_mps);
}

FollowerView Follower::view(double step_s) const {
  const VehicleState on_path = now().state_at(vehicle_, s_m_);
  return {.time_s = time_s_,
          .seen = seen_,
          .s_m = s_m(),
          .length_m = path_.length_m(),
          .offset_m = offset_m_,
          .heading_error_rad = angle_between(seen_.yaw_rad, on_path.yaw_rad),
          .path_speed_mps = path_speed_mps(step_s),
          .path_curvature_1pm = on_path.curvature_1pm};
}

VehicleControl Follower::follow(double step_s) const {
  const double v = speed();
  const double direction = now().direction();
  const CurvePlace place = now().curve.at(s_m_);
  const FeedForward forward = ahead(leg_, s_m_ + v * law_.reaction_s);
  const double length =
      std::max(law_.lookahead_wheelbases * wheelbase_m(vehicle_), law_.lookahead_s * v);
  const double slip_angle = foreseen_slip_angle_rad() + unforeseen_rad_;
  const double heading = seen_.yaw_rad + (now().reverse ? std::numbers::pi : 0);
  const double course = angle_between(heading + slip_angle, place.heading_rad);
  const double curvature = forward.curvature_1pm - direction * (offset_m_ / (length * length) +
                                                                2 * law_.damping * course / length);
  double rim = std::abs(path_speed_mps(step_s)) * ahead(leg_, s_m_).rim_per_speed;
  if (!braking_.empty()) {
    rim = std::min(rim, std::max(creep_mps(step_s), braking_[leg_].most_mps(s_m_ + v * step_s)));
  }
  return {.speed_target_mps = direction * rim / slip_factor_,
          .curvature_target_1pm =
              std::clamp(curvature, -vehicle_.curvature_max_1pm, vehicle_.curvature_max_1pm),
          .crab_target_rad = forward.crab_rad};
}

std::unique_ptr<Follower> make_follower(const FollowerChoice& choice, const World& planned,
                                        const ReferencePath& path) {
  if (choice.kind == FollowerKind::kOwn) {
    return std::make_unique<OwnFollowerCaller>(planned.problem().vehicle, path, choice);
  }
  std::unique_ptr<Follower> follower;
  if (choice.kind == FollowerKind::kPursuit) {
    follower = std::make_unique<PursuitFollower>(planned.problem().vehicle, path, choice.law);
  } else {
    follower = std::make_unique<CompensatedFollower>(planned, path, choice.law);
  }
  follower->foresee_braking();
  return follower;
}

}  // namespace regoplan
