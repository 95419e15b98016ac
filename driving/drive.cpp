#include "driving/drive.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "planner/evaluation/path_tracking.h"

namespace regoplan {
namespace {

constexpr double kRowEvery_s = 0.1;

/// Whatever a path ends with, its last braking takes so much longer at most until it counts as
/// stalled.
constexpr double kSettling_s = 10;

PoseNoise noise_of(const SensorSuite& suite) {
  // No filter trusts a sensor to the last bit.
  constexpr double kLeast_m = 1e-3, kLeast_rad = 1e-3;
  PoseNoise noise;
  if (suite.position) noise.position_m = std::max(kLeast_m, suite.position->noise);
  if (suite.yaw) noise.yaw_rad = std::max(kLeast_rad, suite.yaw->noise);
  return noise;
}

/// Feedback acts on poses as old as the wait for the next fix, and looks as much farther ahead.
FollowerChoice with_wait_for_fixes(FollowerChoice follower,
                                   const std::optional<SensorSuite>& sensors) {
  if (!sensors) return follower;
  double longest_s = 0;
  for (const auto& channel : {sensors->position, sensors->yaw}) {
    if (channel) longest_s = std::max(longest_s, 1 / channel->rate_hz + channel->latency_s);
  }
  follower.law.lookahead_s += longest_s;
  return follower;
}

/// All there is, as it is, at every row.
SensorSuite everything() {
  const SensorChannel exact{.rate_hz = 1 / kRowEvery_s};
  return {.position = exact,
          .yaw = exact,
          .attitude = exact,
          .wheel_speed = exact,
          .torque = exact,
          .sinkage = exact};
}

double speed_of(const VehicleState& state) {
  return std::hypot(state.motion.vx_mps, state.motion.vy_mps);
}

class Drive {
 public:
  Drive(const World& planned, const DrivenWorld& truth, const ReferencePath& path,
        bool ends_in_goal, const DriveSettings& settings)
      : planned_(planned),
        truth_(truth),
        path_(path),
        ends_in_goal_(ends_in_goal),
        settings_(settings),
        vehicle_(planned.problem().vehicle),
        step_s_(drive_step_s(path.speed_max_mps())),
        steps_per_row_(static_cast<int>(std::lround(row_interval_s(step_s_) / step_s_))),
        choice_(with_wait_for_fixes(settings.follower, settings.sensors)),
        follower_(make_follower(choice_, planned, path)),
        state_(start_of(path, vehicle_)),
        seen_(state_),
        sensors_(settings.sensors.value_or(everything()), vehicle_, settings.seed),
        scatter_(settings.sensors ? settings.sensors->scatter : GroundScatter{}, settings.seed) {
    constexpr double kMarginsEvery_s = 0.5, kMarginsEvery_m = 0.25;
    const double every_s = std::max(kMarginsEvery_s, kMarginsEvery_m / path.speed_max_mps());
    steps_per_margin_ = std::max(1, static_cast<int>(std::lround(every_s / step_s_)));
    result_.law = choice_.law;
    if (settings.sensors) filter_.emplace(vehicle_, state_, noise_of(*settings.sensors));
  }

  DriveResult run(const std::function<void(double)>& progress) {
    const double length_m = path_.length_m();
    const double patience_s = path_.patience_s(step_s_);
    bool goes_on = judge_place();
    if (goes_on) note();
    while (goes_on && !follower_->arrived(step_s_)) {
      if (result_.duration_s > patience_s) {
        end(Rejection::kStalled);
        goes_on = false;
        break;
      }
      goes_on = step(follower_->control(step_s_));
      if (progress) progress(follower_->s_m() / length_m);
    }
    if (goes_on && path_.goes_on && !ends_in_goal_) {
      result_.reached = true;
    } else if (goes_on) {
      come_to_rest();
    }
    finish();
    return std::move(result_);
  }

 private:
  const PathLeg& leg() const { return path_.legs[follower_->leg()]; }
  double s_on_leg_m() const { return s_m_ - path_.leg_start_m(follower_->leg()); }

  bool step(const VehicleControl& control) {
    if (settings_.stop.stop_requested()) {
      result_.interrupted = true;
      return false;
    }
    asked_ = control;
    const StepResult step = truth_.step(state_, control, step_s_);
    result_.duration_s += step_s_;
    ++steps_;
    if (!step.converged) {
      end(step.on_known_ground ? Rejection::kDynamics : Rejection::kUnknownTerrain);
      return false;
    }
    const double way_m = std::hypot(step.state.x_m - state_.x_m, step.state.y_m - state_.y_m);
    const double course = std::atan2(step.state.y_m - state_.y_m, step.state.x_m - state_.x_m);
    state_ = step.state;
    strain_ = step.strain;
    result_.energy_j += step.drive_energy_j;
    scatter_by(way_m, course);
    result_.length_m += way_m;
    locate(way_m);
    perceive();
    follower_->observe(seen_, step_s_);
    if (settings_.judge_margins && steps_ % steps_per_margin_ == 0) judge_margins();
    if (!judge_place()) return false;
    judge_strain();
    if (steps_ % steps_per_row_ == 0) note();
    return true;
  }

  /// The ground moves the vehicle as no model of it does.
  void scatter_by(double way_m, double course_rad) {
    if (way_m == 0) return;
    scatter_.advance(way_m);
    const double c = std::cos(course_rad), s = std::sin(course_rad);
    state_.x_m += way_m * (scatter_.speed_share() * c - scatter_.drift_rad() * s);
    state_.y_m += way_m * (scatter_.speed_share() * s + scatter_.drift_rad() * c);
    state_.yaw_rad =
        std::remainder(state_.yaw_rad + way_m * scatter_.turn_radpm(), 2 * std::numbers::pi);
  }

  /// Where the vehicle truly is beside its path.
  void locate(double way_m) {
    const double start_m = path_.leg_start_m(follower_->leg());
    const PathCurve& curve = leg().curve;
    const double s_m = nearest_m(curve, state_.x_m, state_.y_m, std::max(s_m_ - start_m, 0.0));
    s_m_ = start_m + s_m;
    offset_ = offset_m(curve.at(s_m), state_.x_m, state_.y_m);
    squares_m3_ += way_m * offset_ * offset_;
    result_.cross_track_max_m = std::max(result_.cross_track_max_m, std::abs(offset_));
  }

  void perceive() {
    const bool row_now = steps_ % steps_per_row_ == 0;
    if (row_now) sense();
    if (!filter_) {
      seen_ = state_;
      see_no_slip(state_.rim_speed_mps);
      return;
    }
    const double known = state_.rim_speed_mps;
    std::optional<double> gyro;
    if (std::isfinite(yaw_rate_seen_)) gyro = yaw_rate_seen_;
    filter_->predict(state_, follower_->foreseen(), known * rim_ratio_seen_, gyro, step_s_);
    if (row_now) {
      if (const auto fix = sensors_.fix(row_)) filter_->correct(*fix);
    }
    seen_ = filter_->state();
    see_no_slip(known * rim_ratio_seen_);
  }

  /// Pursuit takes the vehicle to move as its wheels roll: it compensates no slip.
  void see_no_slip(double rim_speed_mps) {
    if (settings_.follower.kind != FollowerKind::kPursuit) return;
    const double k = state_.curvature_1pm;
    const double angle = kinematic_body_slip_angle_rad(vehicle_, k) + state_.crab_rad;
    seen_.motion = {.vx_mps = rim_speed_mps * std::cos(angle),
                    .vy_mps = rim_speed_mps * std::sin(angle),
                    .yaw_rate_rad_s = rim_speed_mps * k};
  }

  void sense() {
    const GroundPatch patch = truth_.ground(state_);
    SensedTruth truth{.time_s = result_.duration_s, .state = state_, .wheels = {}};
    if (patch.known) {
      const double p = patch.slope_forward, q = patch.slope_left;
      truth.pitch_rad = std::atan(p) + scatter_.pitch_rad();
      truth.roll_rad = std::atan(q / std::sqrt(1 + p * p)) + scatter_.roll_rad();
      wheels_ = truth_.wheels(state_);
    }
    truth.wheels = wheels_;
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      truth.wheels[i].torque_nm *= truth_.motor_constant_factor(i) * (1 + scatter_.torque_share(i));
    }
    row_ = sensors_.sample(truth);
    if (std::isfinite(row_.yaw_rate_rad_s)) yaw_rate_seen_ = row_.yaw_rate_rad_s;
    if (row_.wheel_speed_rad_s.empty()) return;
    const double least_mps = 0.01 * path_.speed_max_mps();
    if (std::abs(state_.rim_speed_mps) < least_mps) return;
    const auto set = steered_wheels(vehicle_, {state_.curvature_1pm, state_.crab_rad});
    double sum = 0, driven = 0;
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      if (!vehicle_.wheels[i].driven) continue;
      sum += row_.wheel_speed_rad_s[i] * vehicle_.wheel.radius_m / set.at(i).rim_speed_per_speed;
      driven += 1;
    }
    rim_ratio_seen_ = sum / driven / state_.rim_speed_mps;
  }

  /// A row of the recording, with the truth of the same moment.
  void note() {
    if (steps_ == 0) sense();
    result_.rows.push_back(row_);
    const double course = std::atan2(state_.motion.vy_mps, state_.motion.vx_mps) + state_.yaw_rad;
    const bool moves = speed_of(state_) > 0.01 * path_.speed_max_mps();
    const CurvePlace place = leg().curve.at(s_on_leg_m());
    result_.moments.push_back(
        {.time_s = result_.duration_s,
         .s_m = s_m_,
         .offset_m = offset_,
         .heading_error_rad =
             moves ? std::remainder(course - place.heading_rad, 2 * std::numbers::pi) : 0,
         .state = state_,
         .seen = seen_,
         .asked = asked_,
         .wheels = wheels_});
  }

  void break_limit(Rejection limit, const Exceeded& exceeded) {
    const auto known = std::ranges::find(result_.broken, limit, &LimitBroken::limit);
    if (known == result_.broken.end()) {
      result_.broken.push_back({.limit = limit,
                                .x_m = state_.x_m,
                                .y_m = state_.y_m,
                                .s_m = s_m_,
                                .time_s = result_.duration_s,
                                .first = exceeded,
                                .worst = exceeded.found});
      return;
    }
    const bool further = is_margin(limit) ? exceeded.found < known->worst
                                          : std::abs(exceeded.found) > std::abs(known->worst);
    if (further) known->worst = exceeded.found;
  }

  /// What lies on the map at the place: off it, on unknown ground or against a rock the drive ends.
  /// \returns whether it goes on
  bool judge_place() {
    VehicleState on_map = state_;
    const PathPoint place = truth_.on_the_map(state_.x_m, state_.y_m);
    on_map.x_m = place.x_m;
    on_map.y_m = place.y_m;
    const auto rejected = planned_.rejected(on_map, {}, std::nullopt);
    if (std::abs(offset_) > settings_.deviation_max_m) {
      end(Rejection::kDeviation,
          Exceeded{.found = std::abs(offset_), .limit = settings_.deviation_max_m});
      return false;
    }
    if (!rejected) return true;
    if (rejected->reason == Rejection::kSlope || rejected->reason == Rejection::kSpeed) {
      break_limit(rejected->reason, *rejected->exceeded);
      return true;
    }
    end(rejected->reason);
    return false;
  }

  void judge_strain() {
    const Limits& limits = planned_.problem().limits;
    const auto hold = [&](Rejection limit, double value, double allowed) {
      if (std::abs(value) > allowed) break_limit(limit, {.found = value, .limit = allowed});
    };
    hold(Rejection::kSinkage, strain_.sinkage_m, limits.sinkage_max_m);
    hold(Rejection::kSlip, strain_.slip, limits.slip_max);
    hold(Rejection::kSlipAngle, strain_.slip_angle_rad, limits.slip_angle_max_rad);
  }

  /// Of the manoeuvre that the path asks for here, at the speed that there is, on the true soils.
  void judge_margins() {
    const GroundPatch patch = truth_.ground(state_);
    if (!patch.known) return;
    VehicleState manoeuvre = state_;
    if (!braking_) {
      const double s_m = s_on_leg_m();
      manoeuvre.curvature_1pm = std::clamp(leg().curvature_1pm(s_m), -vehicle_.curvature_max_1pm,
                                           vehicle_.curvature_max_1pm);
      manoeuvre.rim_acceleration_mps2 = leg().direction() * leg().speed.at(s_m).acceleration_mps2;
      manoeuvre.direction_at_rest = leg().direction();
    }
    const StateMargins margins = truth_.margins(manoeuvre, patch);
    const MarginMoment moment{.time_s = result_.duration_s,
                              .s_m = s_m_,
                              .cornering = margins.counted_cornering(),
                              .tip_over = margins.tip_over,
                              .traction = margins.counted_traction()};
    result_.margins.push_back(moment);
    result_.margin_cornering_min = std::min(result_.margin_cornering_min, moment.cornering);
    result_.margin_tip_over_min = std::min(result_.margin_tip_over_min, moment.tip_over);
    result_.margin_traction_min = std::min(result_.margin_traction_min, moment.traction);
    if (!result_.smallest_margin || moment.smallest() < result_.smallest_margin->smallest()) {
      result_.smallest_margin = moment;
    }
    const double least = planned_.problem().limits.margin_min;
    const auto hold = [&](Rejection limit, double margin) {
      if (margin < least) break_limit(limit, {.found = margin, .limit = least});
    };
    hold(Rejection::kTraction, moment.traction);
    hold(Rejection::kTipOver, moment.tip_over);
    hold(Rejection::kCornering, moment.cornering);
  }

  bool in_goal() const { return ends_in_goal_ && planned_.at_goal(state_); }

  /// Brakes with the steering held until the vehicle stands, or the goal takes it as it is.
  void come_to_rest() {
    braking_ = true;
    const double until_s = result_.duration_s + kSettling_s +
                           std::abs(state_.rim_speed_mps) / vehicle_.acceleration_max_mps2;
    bool goes_on = true;
    while (goes_on && !in_goal() && !truth_.at_rest(state_)) {
      if (result_.duration_s > until_s) {
        end(Rejection::kDoesNotStop,
            Exceeded{.found = speed_of(state_), .limit = VehicleDynamics::kStandstillSpeed_mps});
        return;
      }
      goes_on = step({.speed_target_mps = 0,
                      .curvature_target_1pm = state_.curvature_1pm,
                      .crab_target_rad = state_.crab_rad});
    }
    if (!goes_on) return;
    if (!ends_in_goal_ || planned_.at_goal(state_)) {
      result_.reached = true;
      return;
    }
    const Goal& goal = planned_.problem().goal;
    end(Rejection::kGoalMissed,
        Exceeded{.found = std::hypot(state_.x_m - goal.x_m, state_.y_m - goal.y_m),
                 .limit = goal.radius_m});
  }

  void end(std::optional<Rejection> reason, std::optional<Exceeded> exceeded = {}) {
    result_.reason = reason;
    result_.exceeded = exceeded;
    result_.x_m = state_.x_m;
    result_.y_m = state_.y_m;
    result_.s_m = s_m_;
    result_.time_s = result_.duration_s;
  }

  void finish() {
    if (steps_ % steps_per_row_ != 0) {
      sense();
      note();
    }
    if (result_.length_m > 0) {
      result_.cross_track_rms_m = std::sqrt(squares_m3_ / result_.length_m);
    }
    if (result_.reason) return;
    if (result_.broken.empty() || result_.interrupted) {
      end({});
      return;
    }
    const LimitBroken& first = result_.broken.front();
    result_.reason = first.limit;
    result_.x_m = first.x_m;
    result_.y_m = first.y_m;
    result_.s_m = first.s_m;
    result_.time_s = first.time_s;
    result_.exceeded = first.first;
  }

  const World& planned_;
  const DrivenWorld& truth_;
  const ReferencePath& path_;
  bool ends_in_goal_;
  const DriveSettings& settings_;
  const Vehicle& vehicle_;
  double step_s_;
  int steps_per_row_, steps_per_margin_ = 1, steps_ = 0;
  FollowerChoice choice_;
  std::unique_ptr<Follower> follower_;
  VehicleState state_, seen_;
  WheelStrain strain_;
  VehicleControl asked_;
  std::vector<WheelNow> wheels_;
  Sensors sensors_;
  ScatterWalk scatter_;
  std::optional<PoseFilter> filter_;
  SensedRow row_;
  double rim_ratio_seen_ = 1, yaw_rate_seen_ = SensedRow::kNone;
  double s_m_ = 0, offset_ = 0, squares_m3_ = 0;
  bool braking_ = false;
  DriveResult result_;
};

}  // namespace

double MarginMoment::smallest() const {
  return std::min({cornering, tip_over, traction});
}

double drive_step_s(double speed_max_mps) {
  const double longest_s = tracking_step_s(speed_max_mps);
  if (longest_s >= kRowEvery_s) return longest_s;
  return kRowEvery_s / std::ceil(kRowEvery_s / longest_s);
}

double row_interval_s(double step_s) {
  return std::max(kRowEvery_s, step_s);
}

DriveResult drive(const World& planned, const DrivenWorld& truth, const ReferencePath& path,
                  bool ends_in_goal, const DriveSettings& settings,
                  const std::function<void(double share)>& progress) {
  return Drive(planned, truth, path, ends_in_goal, settings).run(progress);
}

}  // namespace regoplan
