#include "terramech/wheel/wheel_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/parameters/gravity_range.h"
#include "terramech/wheel/corrected_forces.h"
#include "terramech/wheel/forward_motion.h"
#include "terramech/wheel/mechanism_model.h"

namespace regoplan {
namespace {

using wheel_contact::Contact;
using wheel_contact::Ground;
using wheel_contact::Integrals;
using wheel_contact::Ratios;
using wheel_contact::Resultant;
using wheel_contact::SinkageSolver;

/// r (1 - cos theta_f) without its cancellation.
double sinkage_m(const Contact& contact, double radius_m) {
  return radius_m * contact.sin_f * contact.sin_f / (1 + contact.cos_f);
}

WheelForces forces_at(const Ground& ground, const Contact& contact, const Resultant& resultant,
                      double stress_scale_q, const ForwardMotion& forward, WheelAccuracy accuracy) {
  return {.fx_n = forward.x_sign * resultant.fx_n,
          .fy_n = forward.y_sign *
                  side_force_n(ground, contact, forward.ratios, stress_scale_q, accuracy),
          .torque_nm = forward.x_sign * resultant.torque_nm,
          .sinkage_m = sinkage_m(contact, ground.wheel.radius_m),
          .theta_f_rad = contact.theta_f_rad,
          .theta_r_rad = contact.theta_r_rad,
          .status = forward.status};
}

/// ishigami2007: the sinkage carries the load with Q = 1.
WheelForces solve_sinkage(const SinkageSolver& solver, const Ground& ground, double load_n,
                          const ForwardMotion& forward, WheelAccuracy accuracy) {
  const auto equilibrium = solver.solve(ground, load_n, forward.ratios, accuracy);
  if (!equilibrium) return {.status = WheelStatus::kSinksToAxle};
  return forces_at(ground, equilibrium->contact, equilibrium->resultant, 1, forward, accuracy);
}

/// yoshida2004: h = h0 + c0 max(s, 0), and the stress is scaled until it carries the load.
WheelForces scale_stress(const SinkageSolver& solver, const Ground& ground, double load_n,
                         const ForwardMotion& forward, WheelAccuracy accuracy) {
  const Ratios free_rolling;
  const auto at_zero_slip = solver.solve(ground, load_n, free_rolling, accuracy);
  if (!at_zero_slip) return {.status = WheelStatus::kSinksToAxle};
  const double r = ground.wheel.radius_m;
  const double h =
      sinkage_m(at_zero_slip->contact, r) + ground.soil.c0_m * std::max(forward.ratios.slip, 0.0);
  if (!(h < r)) return {.status = WheelStatus::kSinksToAxle};
  const Contact contact =
      contact_at(ground, wheel_contact::entry_angle_rad(h, r), forward.ratios.slip);
  const Integrals integrals = integrate(ground, contact, forward.ratios, accuracy);
  const double q = integrals.stress_scale(load_n);
  if (!(q >= 0 && std::isfinite(q))) return {.status = WheelStatus::kCohesionCarriesLoad};
  return forces_at(ground, contact, integrals.at(q), q, forward, accuracy);
}

const WheelModelSpec& checked(const WheelModelSpec& spec) {
  validate(spec.wheel);
  validate(spec.soil);
  require("gravity_mps2", spec.gravity_mps2, kGravity_mps2);
  if (!resists_sinkage(spec.soil, spec.wheel.width_m)) {
    throw ValueError("kc", spec.soil.kc,
                     fmt::format("kc/width_m + kphi above 0, with kphi {}", spec.soil.kphi));
  }
  if (spec.generic) validate(*spec.generic);
  return spec;
}

}  // namespace

std::string_view name(WheelStatus status) {
  switch (status) {
    case WheelStatus::kOk:
      return "ok";
    case WheelStatus::kUntrusted:
      return "untrusted";
    case WheelStatus::kStandstill:
      return "standstill";
    case WheelStatus::kCounterRotating:
      return "counter_rotating";
    case WheelStatus::kSinksToAxle:
      return "sinks_to_axle";
    case WheelStatus::kCohesionCarriesLoad:
      return "cohesion_carries_load";
    case WheelStatus::kOutsideCorrection:
      return "outside_correction";
    case WheelStatus::kLifted:
      return "lifted";
  }
  return "";
}

WheelMotion motion_at(double slip_ratio, double slip_angle_rad) {
  if (!(std::abs(slip_ratio) <= 1)) throw ValueError("slip_ratio", slip_ratio, "-1 to 1");
  if (!(std::abs(slip_angle_rad) <= kQuarterTurn * (1 + 1e-15))) {
    throw ValueError("slip_angle_rad", slip_angle_rad, "-pi/2 to pi/2, in rad");
  }
  // At slip ratio 1 the axle stands still, yet the slip angle counts (kx, ky): the limit of an axle
  // that hardly moves.
  constexpr double kHardlyMoving_mps = 1e-200;
  const double vx = slip_ratio >= 0 ? std::max(1 - slip_ratio, kHardlyMoving_mps) : 1;
  const double rim = slip_ratio >= 0 ? 1 : 1 + slip_ratio;
  // At 90 deg tan is 1.6e16: the shear along y is fully mobilised, as in the limit.
  return {.vx_mps = vx, .vy_mps = vx * std::tan(slip_angle_rad), .rim_speed_mps = rim};
}

double slip_ratio(const WheelMotion& motion) {
  const ForwardMotion forward = forward_motion(motion);
  return forward.status == WheelStatus::kCounterRotating ? -1 : forward.ratios.slip;
}

double slip_angle_rad(const WheelMotion& motion) {
  return std::atan2(motion.vy_mps, std::abs(motion.vx_mps));
}

WheelModel::WheelModel(const WheelModelSpec& spec, WheelAccuracy accuracy, const WheelModel* near)
    : spec_(checked(spec)),
      accuracy_(accuracy),
      ground_(spec.wheel, spec.soil, spec.gravity_mps2),
      solver_(near == nullptr ? SinkageSolver(ground_) : SinkageSolver(ground_, near->solver_)) {
  for (const Mechanism& mechanism : spec.mechanisms) mechanisms_.push_back(bind(mechanism));
}

WheelModel::WheelModel(const WheelModelSpec& spec, WheelAccuracy accuracy)
    : WheelModel(spec, accuracy, nullptr) {}

WheelModel::WheelModel(const WheelModelSpec& spec, WheelAccuracy accuracy, const WheelModel& near)
    : WheelModel(spec, accuracy, &near) {}

namespace {

void require_valid(double load_n, const WheelMotion& motion) {
  if (!(load_n >= 0 && std::isfinite(load_n))) throw ValueError("load_n", load_n, "0 or above");
  for (const auto& [field, value] :
       {std::pair{"vx_mps", motion.vx_mps}, std::pair{"vy_mps", motion.vy_mps},
        std::pair{"rim_speed_mps", motion.rim_speed_mps}}) {
    if (!std::isfinite(value)) throw ValueError(field, value, "a finite number");
  }
}

}  // namespace

WheelChannels WheelModel::channels(double load_n, const WheelMotion& motion,
                                   const WheelConditions& conditions) const {
  require_valid(load_n, motion);
  if (conditions.pass < 1) throw ValueError("pass", conditions.pass, "1 or more");
  if (load_n == 0) return {.forces = {.status = WheelStatus::kLifted}};
  WheelChannels channels = mechanism_channels(*this, load_n, motion, conditions);
  if (spec_.generic) {
    const double sinkage_m = channels.forces.sinkage_m;
    channels.forces = corrected(*spec_.generic, load_n, motion, channels.forces);
    channels.rut_left_m += channels.forces.sinkage_m - sinkage_m;
    channels.rut_right_m += channels.forces.sinkage_m - sinkage_m;
  }
  return channels;
}

WheelForces WheelModel::forces(double load_n, const WheelMotion& motion) const {
  require_valid(load_n, motion);
  if (load_n == 0) return {.status = WheelStatus::kLifted};
  const WheelForces forces = without_correction(load_n, motion);
  return spec_.generic ? corrected(*spec_.generic, load_n, motion, forces) : forces;
}

WheelForces WheelModel::without_correction(double load_n, const WheelMotion& motion) const {
  if (!mechanisms_.empty()) return mechanism_channels(*this, load_n, motion, {}).forces;
  const ForwardMotion forward = forward_motion(motion);
  return spec_.variant == WheelVariant::kIshigami2007
             ? solve_sinkage(solver_, ground_, load_n, forward, accuracy_)
             : scale_stress(solver_, ground_, load_n, forward, accuracy_);
}

}  // namespace regoplan
