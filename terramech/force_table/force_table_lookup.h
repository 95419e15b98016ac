#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "terramech/basics/vector_math.h"
#include "terramech/force_table/force_table_values.h"

/// Looking states up in a force table, all of it inlined into kernels that are compiled for several
/// instruction sets. Coordinates are floats: each is right to 1e-7 of itself, as the coefficients.
namespace regoplan::force_table {

using vector_math::Eight;
using vector_math::Four;
using vector_math::Vec;

/// Weights of the four coefficients that reach into an interval, the first of them, and where in
/// the interval the state is. Lanes are axes of one state (Four) or states on one axis (Eight).
template <class Floats>
struct Weights {
  std::array<Floats, 4> value;
  vector_math::Ints<Floats> first;
  Floats f;
};

/// \param at coordinates counted in intervals
template <class Floats>
[[gnu::always_inline]] inline Weights<Floats> weights(Floats at,
                                                      vector_math::Ints<Floats> intervals) {
  using Ints = vector_math::Ints<Floats>;
  const Ints whole = __builtin_convertvector(at, Ints);  // at >= 0: the floor
  const Ints last = intervals - 1;
  const Ints first = whole < last ? whole : last;
  const Floats f = at - __builtin_convertvector(first, Floats);
  const Floats g = 1.0F - f;
  const Floats f2 = f * f, g2 = g * g;
  constexpr float kSixth = 1.0F / 6, kTwoThirds = 2.0F / 3;
  return {.value = {g2 * g * kSixth, kTwoThirds - f2 * (1.0F - f * 0.5F),
                    kTwoThirds - g2 * (1.0F - g * 0.5F), f2 * f * kSixth},
          .first = first,
          .f = f};
}

/// Weights of one axis or state, as they multiply coefficients.
using Narrow = std::array<float, 4>;

template <class Floats>
[[gnu::always_inline]] inline Narrow narrow(const std::array<Floats, 4>& of, std::size_t lane) {
  return {of[0][lane], of[1][lane], of[2][lane], of[3][lane]};
}

/// Where the coefficients of one state stand, in floats.
struct Block {
  const float* first;
  std::size_t load_stride, slip_stride;
};

/// Two of the four coefficients along the lateral axis with all their channels.
[[gnu::always_inline]] inline Eight two(const float* at) {
  Eight two;
  __builtin_memcpy(&two, at, sizeof two);
  return two;
}

/// All channels, from the four coefficients along the lateral axis that are left.
[[gnu::always_inline]] inline Four along_lateral(Eight first, Eight second, const Narrow& weight) {
  return (__builtin_shufflevector(first, first, 0, 1, 2, 3) * weight[0] +
          __builtin_shufflevector(first, first, 4, 5, 6, 7) * weight[1]) +
         (__builtin_shufflevector(second, second, 0, 1, 2, 3) * weight[2] +
          __builtin_shufflevector(second, second, 4, 5, 6, 7) * weight[3]);
}

[[gnu::always_inline]] inline Four look_up(const Block& at, const Narrow& by_load,
                                           const Narrow& by_slip, const Narrow& by_lateral) {
  Eight first{}, second{};
#pragma GCC unroll 4
  for (std::size_t a = 0; a < 4; ++a) {
    const float* const line = at.first + a * at.load_stride;
    Eight line_first{}, line_second{};
#pragma GCC unroll 4
    for (std::size_t b = 0; b < 4; ++b) {
      const float* const row = line + b * at.slip_stride;
      line_first += two(row) * by_slip[b];
      line_second += two(row + 8) * by_slip[b];
    }
    first += line_first * by_load[a];
    second += line_second * by_load[a];
  }
  return along_lateral(first, second, by_lateral);
}

enum Axis : std::uint8_t { kLoad, kSlip, kLateral };

/// Lanes: load, slip, lateral.
[[gnu::always_inline]] inline vector_math::Ints<Four> intervals(const Values& values) {
  vector_math::Ints<Four> intervals;
  __builtin_memcpy(&intervals, values.intervals.data(), sizeof intervals);
  return intervals;
}

/// A state in the table's coordinates; without meaning where it is not inside.
struct Place {
  bool inside;   ///< whether the table answers
  bool trusted;  ///< slip in [-0.9, 0.95], slip angle to 60 deg
  bool driving;
  double x_sign, y_sign;
  double rim, vx;       ///< magnitudes
  float axle, tangent;  ///< q = |Vx|/|r w|, tan|beta|
  float slip, lateral;  ///< coordinates in [0, 1]
  float rise, width;    ///< 1 + g tan|beta|, ln(1 + g tan 62 deg)
  Four at;              ///< coordinates counted in intervals; lanes: load, slip, lateral
};

/// No branches: what states follow each other is not to be foreseen.
[[gnu::always_inline]] inline Place place(const Values& values, double load_n,
                                          const WheelMotion& motion) {
  const Axes& axes = values.axes;
  const double rim = std::abs(motion.rim_speed_mps), vx = std::abs(motion.vx_mps);
  const double vy = std::abs(motion.vy_mps);
  const bool driving = vx <= rim;
  // q, Vy/(r w), tan|beta|, and the square of the slip coordinate
  const Four ratios = __builtin_convertvector(
      (Vec{vx, vy, vy, rim - vx} / Vec{rim, rim, vx, (vx + kBend[driving] * rim) * kEnd[driving]}),
      Four);
  const auto bend = static_cast<float>(axes.lateral_bend);
  const auto bend_per_axle = static_cast<float>(axes.lateral_bend_per_axle);
  constexpr auto kTan = static_cast<float>(kTanMax);
  const float rise = 1 + bend * ratios[2] + bend_per_axle * ratios[1];
  const Four logs =
      vector_math::log_of_floats(Four{static_cast<float>(load_n * values.per_load_min), rise,
                                      (1 + bend * kTan) + bend_per_axle * kTan * ratios[0], 1});
  const float share = ratios[3], tangent = ratios[2];
  const float slip = std::sqrt(share), lateral = logs[1] / logs[2];
  return {
      .inside = bool((load_n >= axes.load_min_n) & (load_n <= axes.load_max_n) &
                     (motion.rim_speed_mps * motion.vx_mps > 0) & (share <= 1) & (tangent <= kTan)),
      .trusted = bool((share <= kTrusted[driving]) & (tangent <= kTrustedTangent)),
      .driving = driving,
      .x_sign = std::copysign(1.0, motion.vx_mps),
      .y_sign = static_cast<double>((motion.vy_mps > 0) - (motion.vy_mps < 0)),
      .rim = rim,
      .vx = vx,
      .axle = ratios[0],
      .tangent = tangent,
      .slip = slip,
      .lateral = lateral,
      .rise = rise,
      .width = logs[2],
      .at = Four{logs[0] * values.loads_per_log, slip, lateral, 0} *
            __builtin_convertvector(intervals(values), Four)};
}

[[gnu::always_inline]] inline Block block(const Values& values, const Place& place,
                                          const Weights<Four>& weights) {
  const auto first = [&](Axis axis) { return static_cast<std::size_t>(weights.first[axis]); };
  return {.first = values.coefficients.data() + values.side[place.driving] +
                   first(kLoad) * values.load_stride + first(kSlip) * values.slip_stride +
                   first(kLateral) * kChannels,
          .load_stride = values.load_stride,
          .slip_stride = values.slip_stride};
}

}  // namespace regoplan::force_table
