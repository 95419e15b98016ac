#include "driving/pose_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regoplan {
namespace {

/// What slips are before anything is known of them, and how they drift in a metre: standard
/// deviations of speed ratio, slip angle (rad) and curvature (1/m). Slip of a tenth, and drift of
/// some degrees, are common on loose slopes.
constexpr double kFirst[] = {0.1, 0.05, 0.02};
constexpr double kDrift_per_sqrt_m[] = {0.02, 0.02, 0.01};
/// The same of what the trims of the planned soils leave: a quarter, as soils within their spread
/// change slip by about a quarter; steering transients stay.
constexpr double kDriftBesideTrims_per_sqrt_m[] = {0.005, 0.005, 0.01};
/// Of the prediction itself, per root metre of way.
constexpr double kOdometry_m = 0.005, kOdometry_rad = 0.003;

}  // namespace

PoseFilter::PoseFilter(const Vehicle& vehicle, const VehicleState& start, const PoseNoise& noise)
    : vehicle_(vehicle), noise_(noise), commanded_(start) {
  mean_ << start.x_m, start.y_m, start.yaw_rad, 1, 0, 0;
  Vector deviation;
  deviation << noise.position_m, noise.position_m, noise.yaw_rad, kFirst[0], kFirst[1], kFirst[2];
  covariance_ = deviation.cwiseAbs2().asDiagonal();
  rim_mps_ = start.rim_speed_mps;
  past_.push_back({0, start.x_m, start.y_m, start.yaw_rad});
}

void PoseFilter::predict(const VehicleState& commanded, const ForeseenSlip& foreseen,
                         double measured_rim_mps, std::optional<double> yaw_rate_rad_s,
                         double step_s) {
  commanded_ = commanded;
  foreseen_ = foreseen;
  rim_mps_ = measured_rim_mps;
  yaw_rate_rad_s_ = yaw_rate_rad_s;
  const double k = commanded.curvature_1pm + foreseen.curvature_1pm;
  const double way = foreseen.speed_ratio * rim_mps_ * step_s;
  const double v = mean_[kSpeedRatio] * way;
  const double turn = yaw_rate_rad_s ? *yaw_rate_rad_s * step_s : v * (k + mean_[kCurvature]);
  const double angle = slip_free_angle_rad() + foreseen.slip_angle_rad;
  const double course = mean_[kYaw] + angle + mean_[kSlipAngle] + turn / 2;
  const double c = std::cos(course), s = std::sin(course);
  mean_[kX] += v * c;
  mean_[kY] += v * s;
  mean_[kYaw] += turn;

  Matrix slopes = Matrix::Identity();
  slopes(kX, kYaw) = slopes(kX, kSlipAngle) = -v * s;
  slopes(kY, kYaw) = slopes(kY, kSlipAngle) = v * c;
  slopes(kX, kSpeedRatio) = way * c;
  slopes(kY, kSpeedRatio) = way * s;
  if (!yaw_rate_rad_s) {
    slopes(kYaw, kSpeedRatio) = way * (k + mean_[kCurvature]);
    slopes(kYaw, kCurvature) = v;
  }
  covariance_ = slopes * covariance_ * slopes.transpose();
  const double metres = std::abs(way);
  covariance_(kX, kX) += kOdometry_m * kOdometry_m * metres;
  covariance_(kY, kY) += kOdometry_m * kOdometry_m * metres;
  covariance_(kYaw, kYaw) += kOdometry_rad * kOdometry_rad * metres;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double drift =
        (foreseen.from_trims ? kDriftBesideTrims_per_sqrt_m : kDrift_per_sqrt_m)[i];
    covariance_(kSpeedRatio + i, kSpeedRatio + i) += drift * drift * metres;
  }
  time_s_ += step_s;
  past_.push_back({time_s_, mean_[kX], mean_[kY], mean_[kYaw]});
  while (past_.front().time_s < time_s_ - kMemory_s) past_.pop_front();
}

void PoseFilter::correct_one(Eigen::Index part, double innovation, double deviation) {
  const double variance = covariance_(part, part) + deviation * deviation;
  const Vector gain = covariance_.col(part) / variance;
  const Eigen::Matrix<double, 1, 6> row = covariance_.row(part);
  mean_ += gain * innovation;
  covariance_ -= gain * row;
  covariance_ = ((covariance_ + covariance_.transpose()) / 2).eval();
  for (Past& past : past_) {
    past.x_m += gain[kX] * innovation;
    past.y_m += gain[kY] * innovation;
    past.yaw_rad += gain[kYaw] * innovation;
  }
}

void PoseFilter::correct(const PoseFix& fix) {
  if (fix.time_s < past_.front().time_s) return;
  const auto then = std::ranges::min_element(
      past_, {}, [&](const Past& past) { return std::abs(past.time_s - fix.time_s); });
  // What the fix says of then is taken to hold now: the way since is short of what is corrected.
  if (fix.x_m) correct_one(kX, *fix.x_m - then->x_m, noise_.position_m);
  if (fix.y_m) correct_one(kY, *fix.y_m - then->y_m, noise_.position_m);
  if (fix.yaw_rad) {
    const double turned = std::remainder(*fix.yaw_rad - then->yaw_rad, 2 * std::numbers::pi);
    correct_one(kYaw, turned, noise_.yaw_rad);
  }
  mean_[kSpeedRatio] = std::clamp(mean_[kSpeedRatio], 0.05, 2.0);
}

double PoseFilter::slip_free_angle_rad() const {
  return kinematic_body_slip_angle_rad(vehicle_, commanded_.curvature_1pm) + commanded_.crab_rad;
}

VehicleState PoseFilter::state() const {
  VehicleState state = commanded_;
  state.x_m = mean_[kX];
  state.y_m = mean_[kY];
  state.yaw_rad = std::remainder(mean_[kYaw], 2 * std::numbers::pi);
  const double v = mean_[kSpeedRatio] * foreseen_.speed_ratio * rim_mps_;
  const double k = commanded_.curvature_1pm + foreseen_.curvature_1pm;
  const double angle = slip_free_angle_rad() + foreseen_.slip_angle_rad + mean_[kSlipAngle];
  state.motion = {.vx_mps = v * std::cos(angle),
                  .vy_mps = v * std::sin(angle),
                  .yaw_rate_rad_s = yaw_rate_rad_s_.value_or(v * (k + mean_[kCurvature]))};
  return state;
}

}  // namespace regoplan
