// Forces with their slopes: the splines differentiated along each axis, and the chain rule from the
// coordinates to load and motion.
#include <algorithm>
#include <cmath>

#include "terramech/basics/vector_clones.h"
#include "terramech/force_table/force_table.h"
#include "terramech/force_table/force_table_lookup.h"
#include "terramech/wheel/corrected_forces.h"

namespace regoplan {

using namespace force_table;

namespace {

/// Slopes by differences, where there is no table.
SlopedForces differences(const WheelModel& model, double load_n, const WheelMotion& motion) {
  const WheelForces here = model.forces(load_n, motion);
  SlopedForces result{.fx = {.value_n = here.fx_n},
                      .fy = {.value_n = here.fy_n},
                      .torque_nm = here.torque_nm,
                      .status = here.status};
  if (!has_forces(here.status)) return result;
  constexpr double kShare = 1e-4;
  const double speed_mps = std::max(
      {std::abs(motion.vx_mps), std::abs(motion.vy_mps), std::abs(motion.rim_speed_mps), 1e-6});
  const auto slope = [&](double SlopedForce::*member, double load_step_n, WheelMotion step) {
    const auto moved = [&](double sign) {
      return model.forces(load_n + sign * load_step_n,
                          {motion.vx_mps + sign * step.vx_mps, motion.vy_mps + sign * step.vy_mps,
                           motion.rim_speed_mps + sign * step.rim_speed_mps});
    };
    const WheelForces up = moved(1), down = moved(-1);
    if (!has_forces(up.status) || !has_forces(down.status)) return;
    const double width = 2 * (load_step_n + step.vx_mps + step.vy_mps + step.rim_speed_mps);
    result.fx.*member = (up.fx_n - down.fx_n) / width;
    result.fy.*member = (up.fy_n - down.fy_n) / width;
  };
  const double step_mps = kShare * speed_mps;
  slope(&SlopedForce::by_load, kShare * load_n, {});
  slope(&SlopedForce::by_vx_nspm, 0, {.vx_mps = step_mps});
  slope(&SlopedForce::by_vy_nspm, 0, {.vy_mps = step_mps});
  slope(&SlopedForce::by_rim_speed_nspm, 0, {.rim_speed_mps = step_mps});
  return result;
}

/// All channels and their slopes over the coordinates counted in intervals.
struct Sloped {
  Four value, by_load, by_slip, by_lateral;
};

[[gnu::always_inline]] inline Sloped look_up_sloped(const Block& at, const Weights<Four>& weights) {
  const Four f = weights.f, g = 1.0F - f;
  const std::array<Four, 4> slopes{g * g * -0.5F, f * (1.5F * f - 2.0F), g * (2.0F - 1.5F * g),
                                   f * f * 0.5F};
  const Narrow load = narrow(weights.value, kLoad), load_slope = narrow(slopes, kLoad);
  const Narrow slip = narrow(weights.value, kSlip), slip_slope = narrow(slopes, kSlip);
  const Narrow lateral = narrow(weights.value, kLateral);
  std::array<Eight, 2> value{}, by_load{}, by_slip{};
  const float* line_at = at.first;
#pragma GCC unroll 1
  for (std::size_t a = 0; a < 4; ++a, line_at += at.load_stride) {
    std::array<Eight, 2> line{}, slope{};
#pragma GCC unroll 4
    for (std::size_t b = 0; b < 4; ++b) {
#pragma GCC unroll 2
      for (std::size_t half = 0; half < 2; ++half) {
        const Eight row = two(line_at + b * at.slip_stride + half * 8);
        line[half] += row * slip[b];
        slope[half] += row * slip_slope[b];
      }
    }
#pragma GCC unroll 2
    for (std::size_t half = 0; half < 2; ++half) {
      value[half] += line[half] * load[a];
      by_load[half] += line[half] * load_slope[a];
      by_slip[half] += slope[half] * load[a];
    }
  }
  return {.value = along_lateral(value[0], value[1], lateral),
          .by_load = along_lateral(by_load[0], by_load[1], lateral),
          .by_slip = along_lateral(by_slip[0], by_slip[1], lateral),
          .by_lateral = along_lateral(value[0], value[1], narrow(slopes, kLateral))};
}

}  // namespace

REGOPLAN_VECTOR_CLONES SlopedForces
ForceTable::forces_with_slopes(double load_n, const WheelMotion& motion) const {
  const Place at = place(values_, load_n, motion);
  if (!at.inside) [[unlikely]]
    return differences(direct_, load_n, motion);
  const auto intervals = force_table::intervals(values_);
  const Weights<Four> weights = force_table::weights(at.at, intervals);
  Sloped sloped = look_up_sloped(block(values_, at, weights), weights);

  // The slip coordinate is the root of the share: at slip 0 a slope over the share is 0/0, and next
  // to it a spline's noise over nothing. Forces are straight over the share there: the slope next
  // to 0 is that a little further out.
  constexpr float kSmallSlip = 0.02F;
  const float slip = std::max(at.slip, kSmallSlip);
  if (at.slip < kSmallSlip) [[unlikely]] {
    Four outward = at.at;
    outward[kSlip] = kSmallSlip * static_cast<float>(intervals[kSlip]);
    const Weights<Four> there = force_table::weights(outward, intervals);
    sloped.by_slip = look_up_sloped(block(values_, at, there), there).by_slip;
  }
  const double q = double{at.axle}, tangent = double{at.tangent};
  const double bend = kBend[at.driving], end = kEnd[at.driving];
  const double share_by_q = -(1 + bend) / ((q + bend) * (q + bend) * end);
  const double slip_by_q = 0.5 * share_by_q / double{slip};
  const Axes& axes = values_.axes;
  const double g = axes.lateral_bend + axes.lateral_bend_per_axle * q;
  const double per_rise = 1 / double{at.rise}, per_width = 1 / double{at.width};
  const double lateral_by_tangent = g * per_rise * per_width;
  const double lateral_by_g =
      (tangent * per_rise - double{at.lateral} * kTanMax / (1 + g * kTanMax)) * per_width;
  const double lateral_by_q = axes.lateral_bend_per_axle * lateral_by_g;
  const double q_by_vx = 1 / at.rim, q_by_rim = -q * q_by_vx;
  const double tangent_by_vy = 1 / at.vx, tangent_by_vx = -tangent * tangent_by_vy;
  const double load_slope = double{values_.loads_per_log} * static_cast<double>(intervals[kLoad]);
  const auto force = [&](Channel channel, double sign, double x_sign, double y_sign,
                         double constant) {
    const double value = double{sloped.value[channel]};
    const double by_slip = double{sloped.by_slip[channel]} * static_cast<double>(intervals[kSlip]);
    const double by_lateral =
        double{sloped.by_lateral[channel]} * static_cast<double>(intervals[kLateral]);
    const double by_q = by_slip * slip_by_q + by_lateral * lateral_by_q;
    const double by_tangent = by_lateral * lateral_by_tangent;
    return SlopedForce{
        .value_n = load_n * (sign * value + constant),
        .by_load = sign * (value + double{sloped.by_load[channel]} * load_slope) + constant,
        .by_vx_nspm = x_sign * load_n * (by_q * q_by_vx + by_tangent * tangent_by_vx),
        .by_vy_nspm = y_sign * load_n * by_tangent * tangent_by_vy,
        .by_rim_speed_nspm = x_sign * load_n * by_q * q_by_rim};
  };
  // Fx changes sign with the direction of travel, Fy with that of the lateral motion; at none, its
  // slope is that to the left.
  const double turned = at.x_sign * at.y_sign;
  const SlopedForces looked_up{
      .fx = force(kFx, at.x_sign, 1, turned, values_.constant.x),
      .fy = force(kFy, at.y_sign, turned, 1, values_.constant.y),
      .torque_nm = at.x_sign * load_n * spec_.model.wheel.radius_m * double{sloped.value[kTorque]},
      .status = at.trusted ? WheelStatus::kOk : WheelStatus::kUntrusted};
  const auto& generic = spec_.model.generic;
  return generic ? corrected(*generic, load_n, motion, looked_up) : looked_up;
}

}  // namespace regoplan
