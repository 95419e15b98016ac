// Many states of a force table at once: coordinates and spline weights of four states in one
// vector, then state by state the sums over the coefficients.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "terramech/cubic_spline.h"
#include "terramech/force_table.h"
#include "terramech/force_table_axes.h"
#include "terramech/input_error.h"
#include "terramech/vector_math.h"

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define REGOPLAN_VECTOR_CLONES __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define REGOPLAN_VECTOR_CLONES
#endif

namespace regoplan {
namespace {

using namespace force_table_axes;
using vector_math::Bits;
using vector_math::kLanes;
using vector_math::Vec;
using Four [[gnu::vector_size(16)]] = float;

/// Spline weights of four states and the first coefficient that each reaches.
struct FourWeights {
  std::array<Four, 4> value;
  Bits first;
};

[[gnu::always_inline]] inline FourWeights weights(Vec t, std::size_t intervals) {
  const double n = static_cast<double>(intervals);
  constexpr double kRound = 0x1.8p52;  // adding it leaves the nearest integer in the low bits
  const Vec x = t * n;
  const Vec nearest = (x - 0.5) + kRound;
  const Vec last = Vec{} + (kRound + (n - 1));
  const Vec rounded = nearest < last ? nearest : last;
  const Vec f = x - (rounded - kRound);
  const Vec g = 1.0 - f;
  const Vec f2 = f * f, g2 = g * g;
  const auto narrow = [](Vec v) { return __builtin_convertvector(v, Four); };
  constexpr double kSixth = 1.0 / 6, kTwoThirds = 2.0 / 3;
  return {.value = {narrow(g2 * g * kSixth), narrow(kTwoThirds - f2 * (1.0 - f * 0.5)),
                    narrow(kTwoThirds - g2 * (1.0 - g * 0.5)), narrow(f2 * f * kSixth)},
          .first = reinterpret_cast<Bits>(rounded) & 0xFFFFFFFFLL};
}

[[gnu::always_inline]] inline Four contract(const float* first, std::size_t load_stride,
                                            std::size_t slip_stride,
                                            const std::array<Four, 4>& by_load,
                                            const std::array<Four, 4>& by_slip, std::size_t lane) {
  Four sum{};
  for (std::size_t a = 0; a < 4; ++a) {
    Four line{};
    for (std::size_t b = 0; b < 4; ++b) {
      Four row;
      __builtin_memcpy(&row, first + a * load_stride + b * slip_stride, sizeof row);
      line += row * by_slip[b][lane];
    }
    sum += line * by_load[a][lane];
  }
  return sum;
}

[[gnu::always_inline]] inline float total(Four v) {
  return (v[0] + v[2]) + (v[1] + v[3]);
}

}  // namespace

REGOPLAN_VECTOR_CLONES std::vector<PlaneForces> ForceTable::plane_forces(
    std::span<const double> loads_n, std::span<const WheelMotion> motions) const {
  if (loads_n.size() != motions.size()) {
    throw InputError(fmt::format("{} loads for {} motions", loads_n.size(), motions.size()));
  }
  std::vector<PlaneForces> result(loads_n.size());
  if (spec_.model.generic) {
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = plane_forces(loads_n[i], motions[i]);
    return result;
  }
  const std::size_t slips = cubic_spline::coefficients(grid_.slips);
  const std::size_t laterals = cubic_spline::coefficients(grid_.laterals);
  const Soil& soil = spec_.model.soil;
  const std::size_t whole = loads_n.size() / kLanes * kLanes;
  for (std::size_t start = 0; start < whole; start += kLanes) {
    Vec load, rim, vx, vy;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const WheelMotion& motion = motions[start + lane];
      load[lane] = loads_n[start + lane];
      rim[lane] = motion.rim_speed_mps;
      vx[lane] = motion.vx_mps;
      vy[lane] = motion.vy_mps;
    }
    // as in ForceTable::place
    const Vec told_a = vector_math::abs(rim), told_b = vector_math::abs(vx);
    const Vec told_c = vector_math::abs(vy);
    const Bits driving = told_a >= told_b;
    const Vec from =
        driving ? told_a * kSlipMaxDriving : (told_b + kBrakingBend * told_a) * kBrakingEnd;
    const Vec told_share = vector_math::abs(told_a - told_b) / from;
    const Bits inside = (load >= load_min_n_) & (load <= load_max_n_) & (rim * vx > 0.0) &
                        (told_share <= 1.0) & (told_c <= kTanMax * told_b);
    const Vec one = Vec{} + 1.0;
    const Vec a = inside ? told_a : one, b = inside ? told_b : one, c = inside ? told_c : one;
    const Vec share = inside ? told_share : one;
    Vec t;
    for (std::size_t lane = 0; lane < kLanes; ++lane) t[lane] = std::sqrt(share[lane]);
    const Vec angle = nearly_angle(b, c).rad;
    const Vec v = angle / (angle + kx_angle_rad_);
    const Vec y = c / (c + a * (ky_scale_ * (soil.ky0_m + soil.ky1_m * angle)));
    const Vec carried = inside ? load : Vec{} + load_min_n_;
    const Vec at = (vector_math::log(carried) - log_load_min_) * loads_per_log_;
    const Vec at_least = at < 0.0 ? Vec{} : at;
    const FourWeights by_load = weights(at_least > 1.0 ? one : at_least, grid_.loads);
    const FourWeights by_slip = weights(t, grid_.slips);
    const FourWeights by_y = weights(y, grid_.laterals);
    const Vec x_factor = vx < 0.0 ? -load : load;
    const Vec no_load{};
    const Vec y_factor = vy > 0.0 ? load : vy < 0.0 ? -load : no_load;

    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!inside[lane]) [[unlikely]] {
        const WheelForces forces = direct_.forces(loads_n[start + lane], motions[start + lane]);
        result[start + lane] = {forces.fx_n, forces.fy_n};
        continue;
      }
      const Side& side = sides_[driving[lane] ? 1 : 0];
      const std::size_t row = static_cast<std::size_t>(by_load.first[lane]) * slips +
                              static_cast<std::size_t>(by_slip.first[lane]);
      const Four fx = contract(&side.fx[row * kPowers], slips * kPowers, kPowers, by_load.value,
                               by_slip.value, lane);
      const Four fy =
          contract(&side.fy[row * laterals + static_cast<std::size_t>(by_y.first[lane])],
                   slips * laterals, laterals, by_load.value, by_slip.value, lane);
      const auto v1 = static_cast<float>(v[lane]);
      const Four in_v{1, v1, v1 * v1, v1 * v1 * v1};
      const Four in_y{by_y.value[0][lane], by_y.value[1][lane], by_y.value[2][lane],
                      by_y.value[3][lane]};
      result[start + lane] = {.fx_n = x_factor[lane] * double{total(fx * in_v)},
                              .fy_n = y_factor[lane] * double{total(fy * in_y)}};
    }
  }
  for (std::size_t i = whole; i < loads_n.size(); ++i) {
    const WheelForces forces = this->forces(loads_n[i], motions[i]);
    result[i] = {forces.fx_n, forces.fy_n};
  }
  return result;
}

}  // namespace regoplan
