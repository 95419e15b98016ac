// Many states at once, in chunks: first coordinates and weights of eight states side by side, then
// the sums of each. Apart, neither waits for the other.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "terramech/basics/input_error.h"
#include "terramech/basics/vector_clones.h"
#include "terramech/force_table/force_table.h"
#include "terramech/force_table/force_table_lookup.h"

namespace regoplan {

using namespace force_table;

namespace {

constexpr std::size_t kSide = 8;  // states side by side

/// Eight states made ready for their sums.
struct Ready {
  std::array<Eight, 4> by_load, by_slip, by_lateral;
  std::array<vector_math::Ints<Eight>, 3> first;  ///< of the coefficients along each axis
  vector_math::Ints<Eight> driving, inside;
};

/// As place().
/// \param ready is written where it stands: a copy would cost a quarter of the whole
[[gnu::always_inline]] inline void make_ready(Ready& ready, const Values& values,
                                              const double* loads_n, const WheelMotion* motions) {
  const Axes& axes = values.axes;
  constexpr auto kTan = static_cast<float>(kTanMax);
  const auto number = [](double value) { return static_cast<float>(value); };
  const auto all = [&](double value) { return Eight{} + number(value); };
  Eight load, rim, vx, vy, ahead;
  for (std::size_t lane = 0; lane < kSide; ++lane) {
    const WheelMotion& motion = motions[lane];
    load[lane] = number(loads_n[lane] * values.per_load_min);
    rim[lane] = number(motion.rim_speed_mps);
    vx[lane] = number(motion.vx_mps);
    vy[lane] = number(motion.vy_mps);
    ahead[lane] = number(std::abs(motion.rim_speed_mps) - std::abs(motion.vx_mps));
  }
  const auto size = [](Eight of) {
    return reinterpret_cast<Eight>(reinterpret_cast<vector_math::Ints<Eight>>(of) & INT32_MAX);
  };
  const auto same_direction = rim * vx > 0.0F;
  rim = size(rim);
  vx = size(vx);
  vy = size(vy);
  ready.driving = ahead >= 0.0F;
  const Eight bend = ready.driving ? all(kDrivingBend) : all(kBrakingBend);
  const Eight end = ready.driving ? all(kDrivingEnd) : all(kBrakingEnd);
  const Eight share = ahead / ((vx + bend * rim) * end);
  const Eight per_rim = 1.0F / rim, tangent = vy / vx;
  ready.inside = (load >= 1.0F) & (load <= number(axes.load_max_n * values.per_load_min)) &
                 same_direction & (share <= 1.0F) & (tangent <= kTan);
  const float straight = number(axes.lateral_bend), turned = number(axes.lateral_bend_per_axle);
  const Eight rise = 1.0F + straight * tangent + turned * (vy * per_rim);
  const Eight most = (1.0F + straight * kTan) + (turned * kTan) * (vx * per_rim);
  const Eight log_load = vector_math::log_of_floats(load);
  const Eight lateral = vector_math::log_of_floats(rise) / vector_math::log_of_floats(most);
  Eight slip;
  for (std::size_t lane = 0; lane < kSide; ++lane) slip[lane] = std::sqrt(share[lane]);
  const auto along = [&](Axis axis, Eight at) {
    const std::int32_t intervals = values.intervals[axis];
    return weights(at * static_cast<float>(intervals), vector_math::Ints<Eight>{} + intervals);
  };
  const Weights<Eight> by_load = along(kLoad, log_load * values.loads_per_log);
  const Weights<Eight> by_slip = along(kSlip, slip), by_lateral = along(kLateral, lateral);
  ready.by_load = by_load.value;
  ready.by_slip = by_slip.value;
  ready.by_lateral = by_lateral.value;
  ready.first = {by_load.first, by_slip.first, by_lateral.first};
}

}  // namespace

REGOPLAN_VECTOR_CLONES std::vector<PlaneForces> ForceTable::plane_forces(
    std::span<const double> loads_n, std::span<const WheelMotion> motions) const {
  if (loads_n.size() != motions.size()) {
    throw InputError(fmt::format("{} loads for {} motions", loads_n.size(), motions.size()));
  }
  std::vector<PlaneForces> result(loads_n.size());
  if (spec_.model.generic) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      const WheelForces forces = this->forces(loads_n[i], motions[i]);
      result[i] = {forces.fx_n, forces.fy_n};
    }
    return result;
  }
  const ConstantShares& constant = values_.constant;
  const std::size_t load_stride = values_.load_stride, slip_stride = values_.slip_stride;
  constexpr std::size_t kChunk = 8;
  std::array<Ready, kChunk> chunk;
  const std::size_t whole = loads_n.size() / kSide;
  for (std::size_t start = 0; start < whole; start += kChunk) {
    const std::size_t count = std::min(kChunk, whole - start);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t state = (start + i) * kSide;
      make_ready(chunk[i], values_, &loads_n[state], &motions[state]);
    }
    for (std::size_t i = 0; i < count * kSide; ++i) {
      const Ready& ready = chunk[i / kSide];
      const std::size_t lane = i % kSide, state = start * kSide + i;
      const double load_n = loads_n[state];
      const WheelMotion& motion = motions[state];
      if (!ready.inside[lane]) [[unlikely]] {
        const WheelForces forces = direct_.forces(load_n, motion);
        result[state] = {forces.fx_n, forces.fy_n};
        continue;
      }
      const auto first = [&](Axis axis) {
        return static_cast<std::size_t>(ready.first[axis][lane]);
      };
      const Block at{.first = values_.coefficients.data() +
                              values_.side[static_cast<std::size_t>(ready.driving[lane] & 1)] +
                              first(kLoad) * load_stride + first(kSlip) * slip_stride +
                              first(kLateral) * kChannels,
                     .load_stride = load_stride,
                     .slip_stride = slip_stride};
      const Four channels = look_up(at, narrow(ready.by_load, lane), narrow(ready.by_slip, lane),
                                    narrow(ready.by_lateral, lane));
      const double x_sign = std::copysign(1.0, motion.vx_mps);
      const double y_sign = static_cast<double>((motion.vy_mps > 0) - (motion.vy_mps < 0));
      result[state] = {.fx_n = load_n * (x_sign * double{channels[kFx]} + constant.x),
                       .fy_n = load_n * (y_sign * double{channels[kFy]} + constant.y)};
    }
  }
  for (std::size_t i = whole * kSide; i < loads_n.size(); ++i) {
    const WheelForces forces = this->forces(loads_n[i], motions[i]);
    result[i] = {forces.fx_n, forces.fy_n};
  }
  return result;
}

}  // namespace regoplan
