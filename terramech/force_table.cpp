#include "terramech/force_table.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "terramech/corrected_forces.h"
#include "terramech/cubic_spline.h"
#include "terramech/force_table_axes.h"
#include "terramech/input_error.h"
#include "terramech/vector_math.h"

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define REGOPLAN_VECTOR_CLONES __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define REGOPLAN_VECTOR_CLONES
#endif
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors never cross a call that is not inlined

namespace regoplan {
namespace {

using cubic_spline::Weights;
using namespace force_table_axes;
using Four [[gnu::vector_size(16)]] = float;

double slip_max(bool driving) {
  return driving ? kSlipMaxDriving : kSlipMaxBraking;
}

/// The wheel rolls forward with the given slip ratio and |Vy|; the faster of rim and axle is 1 m/s.
WheelMotion rolling(double slip, double vy_mps) {
  return {.vx_mps = slip >= 0 ? 1 - slip : 1,
          .vy_mps = vy_mps,
          .rim_speed_mps = slip >= 0 ? 1 : 1 + slip};
}

double slip_at(double t, bool driving) {
  if (driving) return kSlipMaxDriving * t * t;
  const double share = kBrakingEnd * t * t;
  return -(1 + kBrakingBend) * share / (1 + kBrakingBend * share);
}

[[gnu::always_inline]] inline double dot(Four a, const std::array<double, 4>& b) {
  const Four product = a * Four{static_cast<float>(b[0]), static_cast<float>(b[1]),
                                static_cast<float>(b[2]), static_cast<float>(b[3])};
  return (product[0] + product[2]) + (product[1] + product[3]);
}

/// Sums of the 4 x 4 rows of four coefficients that a state reaches.
[[gnu::always_inline]] inline Four contract(const float* first, std::size_t load_stride,
                                            std::size_t slip_stride,
                                            const std::array<double, 4>& by_load,
                                            const std::array<double, 4>& by_slip) {
  Four sum{};
  for (std::size_t a = 0; a < 4; ++a) {
    Four line{};
    for (std::size_t b = 0; b < 4; ++b) {
      Four row;
      __builtin_memcpy(&row, first + a * load_stride + b * slip_stride, sizeof row);
      line += row * static_cast<float>(by_slip[b]);
    }
    sum += line * static_cast<float>(by_load[a]);
  }
  return sum;
}

std::vector<float> to_float(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

/// A state in the table's coordinates.
struct ForceTable::Place {
  bool driving = false;
  double a = 0, b = 0, c = 0;  // |rim|, |Vx|, |Vy|
  double x_sign = 1, y_sign = 0;
  double t = 0;  // sqrt(|slip|/slip_max)
  NearlyAngle<double> angle{};
  double v = 0;  // angle/(angle + kx0/kx1): how far kx has grown
  double y = 0, ky_over = 0;
  double log_load_at = 0;  // in [0, 1]
};

double ForceTable::lateral_scale(double angle_rad) const {
  return ky_scale_ * (spec_.model.soil.ky0_m + spec_.model.soil.ky1_m * angle_rad);
}

[[gnu::always_inline]] inline bool ForceTable::place(double load_n, const WheelMotion& motion,
                                                     Place& place) const {
  place.a = std::abs(motion.rim_speed_mps);
  place.b = std::abs(motion.vx_mps);
  place.c = std::abs(motion.vy_mps);
  place.driving = place.a >= place.b;
  const double share =
      place.driving ? (place.a - place.b) / (kSlipMaxDriving * place.a)
                    : (place.b - place.a) / (kBrakingEnd * (place.b + kBrakingBend * place.a));
  const bool inside = load_n >= load_min_n_ && load_n <= load_max_n_ &&
                      motion.rim_speed_mps * motion.vx_mps > 0 && share <= 1 &&
                      place.c <= kTanMax * place.b;
  if (!inside) return false;
  place.x_sign = motion.vx_mps < 0 ? -1 : 1;
  place.y_sign = motion.vy_mps > 0 ? 1 : motion.vy_mps < 0 ? -1 : 0;
  place.t = std::sqrt(share);
  place.angle = nearly_angle(place.b, place.c);
  place.v = place.angle.rad / (place.angle.rad + kx_angle_rad_);
  place.ky_over = lateral_scale(place.angle.rad);
  place.y = place.c / (place.c + place.ky_over * place.a);
  const double log_load = vector_math::log(vector_math::Vec{} + load_n)[0];
  place.log_load_at = std::clamp((log_load - log_load_min_) * loads_per_log_, 0.0, 1.0);
  return true;
}

bool ForceTable::covers(double load_n, const WheelMotion& motion) const {
  Place at;
  return place(load_n, motion, at);
}

namespace {

WheelStatus status_at(const auto& place) {
  constexpr double kTrustedTan = 1.7320508075688772, kRounding = 1e-9;
  const double slip = place.driving ? 1 - place.b / place.a : place.a / place.b - 1;
  const bool trusted = slip >= -0.9 - kRounding && slip <= 0.95 + kRounding &&
                       place.c <= kTrustedTan * place.b * (1 + kRounding);
  return trusted ? WheelStatus::kOk : WheelStatus::kUntrusted;
}

}  // namespace

REGOPLAN_VECTOR_CLONES WheelForces ForceTable::forces(double load_n,
                                                      const WheelMotion& motion) const {
  Place at;
  if (!place(load_n, motion, at)) [[unlikely]]
    return direct_.forces(load_n, motion);
  const Side& side = sides_[at.driving];
  const Weights load = cubic_spline::weights(at.log_load_at, grid_.loads);
  const Weights slip = cubic_spline::weights(at.t, grid_.slips);
  const Weights y = cubic_spline::weights(at.y, grid_.laterals);
  const std::size_t slips = cubic_spline::coefficients(grid_.slips);
  const std::size_t laterals = cubic_spline::coefficients(grid_.laterals);
  const std::size_t row = load.first * slips + slip.first;
  const std::array<double, 4> powers{1, at.v, at.v * at.v, at.v * at.v * at.v};
  const auto in_v = [&](const std::vector<float>& table) {
    return dot(contract(&table[row * kPowers], slips * kPowers, kPowers, load.value, slip.value),
               powers);
  };
  const double fy = dot(contract(&side.fy[row * laterals + y.first], slips * laterals, laterals,
                                 load.value, slip.value),
                        y.value);
  const double radius_m = spec_.model.wheel.radius_m;
  const WheelForces result{.fx_n = at.x_sign * load_n * in_v(side.fx),
                           .fy_n = at.y_sign * load_n * fy,
                           .torque_nm = at.x_sign * load_n * radius_m * in_v(side.torque),
                           .sinkage_m = radius_m * in_v(side.sinkage),
                           .status = status_at(at)};
  const auto& generic = spec_.model.generic;
  return generic ? corrected(*generic, load_n, motion, result) : result;
}

REGOPLAN_VECTOR_CLONES PlaneForces ForceTable::plane_forces(double load_n,
                                                            const WheelMotion& motion) const {
  Place at;
  if (spec_.model.generic || !place(load_n, motion, at)) [[unlikely]] {
    const WheelForces forces = this->forces(load_n, motion);
    return {forces.fx_n, forces.fy_n};
  }
  const Side& side = sides_[at.driving];
  const Weights load = cubic_spline::weights(at.log_load_at, grid_.loads);
  const Weights slip = cubic_spline::weights(at.t, grid_.slips);
  const Weights y = cubic_spline::weights(at.y, grid_.laterals);
  const std::size_t slips = cubic_spline::coefficients(grid_.slips);
  const std::size_t laterals = cubic_spline::coefficients(grid_.laterals);
  const std::size_t row = load.first * slips + slip.first;
  const Four fx =
      contract(&side.fx[row * kPowers], slips * kPowers, kPowers, load.value, slip.value);
  const Four fy = contract(&side.fy[row * laterals + y.first], slips * laterals, laterals,
                           load.value, slip.value);
  return {.fx_n = at.x_sign * load_n * dot(fx, {1, at.v, at.v * at.v, at.v * at.v * at.v}),
          .fy_n = at.y_sign * load_n * dot(fy, y.value)};
}

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

/// A force over the load and its slopes by the table's coordinates.
struct Partials {
  double value = 0, by_log_load = 0, by_t = 0, by_last = 0;
};

[[gnu::always_inline]] inline Partials partials(const float* first, std::size_t load_stride,
                                                std::size_t slip_stride, const Weights& load,
                                                const Weights& slip,
                                                const std::array<double, 4>& last,
                                                const std::array<double, 4>& slope_by_last) {
  Four value{}, by_load{}, by_t{};
  for (std::size_t a = 0; a < 4; ++a) {
    Four line{}, slope{};
    for (std::size_t b = 0; b < 4; ++b) {
      Four row;
      __builtin_memcpy(&row, first + a * load_stride + b * slip_stride, sizeof row);
      line += row * static_cast<float>(slip.value[b]);
      slope += row * static_cast<float>(slip.slope[b]);
    }
    value += line * static_cast<float>(load.value[a]);
    by_load += line * static_cast<float>(load.slope[a]);
    by_t += slope * static_cast<float>(load.value[a]);
  }
  return {.value = dot(value, last),
          .by_log_load = dot(by_load, last),
          .by_t = dot(by_t, last),
          .by_last = dot(value, slope_by_last)};
}

}  // namespace

REGOPLAN_VECTOR_CLONES SlopedForces
ForceTable::forces_with_slopes(double load_n, const WheelMotion& motion) const {
  Place at;
  if (!place(load_n, motion, at)) [[unlikely]]
    return differences(direct_, load_n, motion);
  const Side& side = sides_[at.driving];
  const Weights load = cubic_spline::weights(at.log_load_at, grid_.loads);
  const Weights slip = cubic_spline::weights(at.t, grid_.slips);
  const Weights y = cubic_spline::weights(at.y, grid_.laterals);
  const std::size_t slips = cubic_spline::coefficients(grid_.slips);
  const std::size_t laterals = cubic_spline::coefficients(grid_.laterals);
  const std::size_t row = load.first * slips + slip.first;
  const double v = at.v, radius_m = spec_.model.wheel.radius_m;
  const auto in_v = [&](const std::vector<float>& table) {
    return dot(contract(&table[row * kPowers], slips * kPowers, kPowers, load.value, slip.value),
               {1, v, v * v, v * v * v});
  };
  const Partials x = partials(&side.fx[row * kPowers], slips * kPowers, kPowers, load, slip,
                              {1, v, v * v, v * v * v}, {0, 1, 2 * v, 3 * v * v});
  const Partials l = partials(&side.fy[row * laterals + y.first], slips * laterals, laterals, load,
                              slip, y.value, y.slope);

  // t is the root of the share, whose slope is kept finite at slip 0
  constexpr double kTSmall = 0.02;
  const double t_by_share = 0.5 / std::max(at.t, kTSmall);
  const double from = at.driving ? at.a : at.b + kBrakingBend * at.a;
  const double rate = t_by_share / (from * from) *
                      (at.driving ? 1 / kSlipMaxDriving : -(1 + kBrakingBend) / kBrakingEnd);
  const double t_by_a = rate * at.b, t_by_b = -rate * at.a;
  const double angle_whole = at.angle.rad + kx_angle_rad_;
  const double v_by_angle = kx_angle_rad_ / (angle_whole * angle_whole);
  const double whole = at.c + at.ky_over * at.a;
  const double per_whole2 = 1 / (whole * whole);
  const double y_by_angle = -at.c * at.a * per_whole2 * ky_scale_ * spec_.model.soil.ky1_m;
  const double y_by_a = -at.c * at.ky_over * per_whole2;
  const double y_by_b = y_by_angle * at.angle.by_b;
  const double y_by_c = at.ky_over * at.a * per_whole2 + y_by_angle * at.angle.by_c;
  const auto sloped = [&](const Partials& p, double by_a, double by_b, double by_c) {
    return SlopedForce{.value_n = load_n * p.value,
                       .by_load = p.value + p.by_log_load * loads_per_log_,
                       .by_vx_nspm = load_n * (p.by_t * t_by_b + p.by_last * by_b),
                       .by_vy_nspm = load_n * p.by_last * by_c,
                       .by_rim_speed_nspm = load_n * (p.by_t * t_by_a + p.by_last * by_a)};
  };
  SlopedForces result{.fx = sloped(x, 0, v_by_angle * at.angle.by_b, v_by_angle * at.angle.by_c),
                      .fy = sloped(l, y_by_a, y_by_b, y_by_c),
                      .torque_nm = at.x_sign * load_n * radius_m * in_v(side.torque),
                      .status = status_at(at)};
  // Fx changes sign with the direction of travel, Fy with that of the lateral motion
  result.fx.value_n *= at.x_sign;
  result.fx.by_load *= at.x_sign;
  result.fx.by_vy_nspm *= at.x_sign * at.y_sign;
  result.fy.value_n *= at.y_sign;
  result.fy.by_load *= at.y_sign;
  result.fy.by_vx_nspm *= at.x_sign * at.y_sign;
  result.fy.by_rim_speed_nspm *= at.x_sign * at.y_sign;
  const auto& generic = spec_.model.generic;
  return generic ? corrected(*generic, load_n, motion, result) : result;
}

double ForceTable::v_at(double tangent) const {
  const double angle_rad = nearly_angle(1.0, tangent).rad;
  return angle_rad / (angle_rad + kx_angle_rad_);
}

/// The motion whose lateral coordinate is y.
WheelMotion ForceTable::motion_with_lateral(double slip, double y) const {
  WheelMotion motion = rolling(slip, 0);
  constexpr double kSideways_mps = 1e15;
  if (y >= 1) {
    motion.vy_mps = kSideways_mps;
    return motion;
  }
  // c = y/(1 - y) K a, and K grows with c only as far as the angle grows to a quarter turn
  const double share = y / (1 - y) * motion.rim_speed_mps;
  double low = share * lateral_scale(0), high = share * lateral_scale(1.6);
  for (int i = 0; i < 60 && high > low; ++i) {
    const double c = (low + high) / 2;
    (share * lateral_scale(nearly_angle(motion.vx_mps, c).rad) > c ? low : high) = c;
  }
  motion.vy_mps = high;
  return motion;
}

ForceTable::Side ForceTable::fill_side(const WheelModel& model, bool driving) const {
  using cubic_spline::coefficients;
  using cubic_spline::interpolate;
  using cubic_spline::nodes;
  const std::size_t loads = nodes(grid_.loads), slips = nodes(grid_.slips);
  const std::size_t laterals = nodes(grid_.laterals);

  // Chebyshev nodes in v, and the matrix that turns values there into powers of v
  std::array<double, kPowers> tangents{};
  Eigen::Matrix<double, kPowers, kPowers> vandermonde;
  const double v_max = v_at(kTanMax);
  for (std::size_t k = 0; k < kPowers; ++k) {
    const double wanted =
        v_max / 2 * (1 - std::cos(std::numbers::pi * (2.0 * double(k) + 1) / (2 * kPowers)));
    double low = 0, high = kTanMax;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (v_at(middle) < wanted ? low : high) = middle;
    }
    tangents[k] = high;
    for (std::size_t p = 0; p < kPowers; ++p) {
      vandermonde(Eigen::Index(k), Eigen::Index(p)) = std::pow(v_at(high), double(p));
    }
  }
  const Eigen::Matrix<double, kPowers, kPowers> to_powers = vandermonde.inverse();
  std::vector<std::vector<WheelMotion>> sideways(slips);
  for (std::size_t j = 0; j < slips; ++j) {
    const double slip = slip_at(static_cast<double>(j) / static_cast<double>(grid_.slips), driving);
    for (std::size_t k = 0; k < laterals; ++k) {
      const double y = static_cast<double>(k) / static_cast<double>(grid_.laterals);
      sideways[j].push_back(motion_with_lateral(slip, y));
    }
  }

  std::vector<double> fx, torque, sinkage, fy;
  for (std::size_t i = 0; i < loads; ++i) {
    const double at = static_cast<double>(i) / static_cast<double>(grid_.loads);
    const double load_n = std::exp(log_load_min_ + at / loads_per_log_);
    for (std::size_t j = 0; j < slips; ++j) {
      const double slip =
          slip_at(static_cast<double>(j) / static_cast<double>(grid_.slips), driving);
      std::array<Eigen::Vector<double, kPowers>, 3> in_v;
      for (std::size_t k = 0; k < kPowers; ++k) {
        WheelMotion motion = rolling(slip, 0);
        motion.vy_mps = motion.vx_mps * tangents[k];
        const WheelForces forces = model.forces(load_n, motion);
        const double r = spec_.model.wheel.radius_m;
        in_v[0](Eigen::Index(k)) = forces.fx_n / load_n;
        in_v[1](Eigen::Index(k)) = forces.torque_nm / (load_n * r);
        in_v[2](Eigen::Index(k)) = forces.sinkage_m / r;
      }
      for (auto& values : in_v) values = to_powers * values;
      fx.insert(fx.end(), in_v[0].begin(), in_v[0].end());
      torque.insert(torque.end(), in_v[1].begin(), in_v[1].end());
      sinkage.insert(sinkage.end(), in_v[2].begin(), in_v[2].end());
      for (const WheelMotion& motion : sideways[j]) {
        fy.push_back(model.forces(load_n, motion).fy_n / load_n);
      }
    }
  }
  const auto spline = [&](const std::vector<double>& values, std::size_t last) {
    const std::vector<double> along_load = interpolate(values, 1, grid_.loads, slips * last);
    return interpolate(along_load, coefficients(grid_.loads), grid_.slips, last);
  };
  return {.fx = to_float(spline(fx, kPowers)),
          .torque = to_float(spline(torque, kPowers)),
          .sinkage = to_float(spline(sinkage, kPowers)),
          .fy = to_float(interpolate(spline(fy, laterals),
                                     coefficients(grid_.loads) * coefficients(grid_.slips),
                                     grid_.laterals, 1))};
}

void ForceTable::limit_loads() {
  constexpr int kSteps = 8;
  const auto carried = [&](double load_n) {
    for (const bool driving : {false, true}) {
      for (int i = 0; i <= kSteps; ++i) {
        for (const double tangent : {0.0, kTanMax}) {
          WheelMotion motion = rolling(slip_at(double(i) / kSteps, driving), 0);
          motion.vy_mps = motion.vx_mps * tangent;
          if (!has_forces(direct_.forces(load_n, motion).status)) return false;
          motion.vy_mps = 1e15;
          if (!has_forces(direct_.forces(load_n, motion).status)) return false;
        }
      }
    }
    return true;
  };
  constexpr double kMargin = 1.1, kStep = 0.9;
  while (!carried(kMargin * load_max_n_) && load_max_n_ > load_min_n_) load_max_n_ *= kStep;
  while (!carried(load_min_n_ / kMargin) && load_max_n_ > load_min_n_) load_min_n_ /= kStep;
}

void ForceTable::scale_loads() {
  log_load_min_ = std::log(load_min_n_);
  loads_per_log_ = 1 / std::log(load_max_n_ / load_min_n_);
}

void ForceTable::fill() {
  scale_loads();
  // A generic correction has edges that no spline follows: it is added to what the table gives.
  WheelModelSpec spec = spec_.model;
  spec.generic.reset();
  const WheelModel model(spec);
  for (const bool driving : {false, true}) sides_[driving] = fill_side(model, driving);
}

ForceTable::ForceTable(const ForceTableSpec& spec, const Grid& grid)
    : spec_(spec), direct_(spec.model), grid_(grid) {
  if (!(spec.nominal_load_n > 0 && std::isfinite(spec.nominal_load_n))) {
    throw ValueError("nominal_load_n", spec.nominal_load_n, "above 0");
  }
  constexpr double kLowestShare = 0.02, kHighestShare = 3;
  load_min_n_ = kLowestShare * spec.nominal_load_n;
  load_max_n_ = kHighestShare * spec.nominal_load_n;
  const WheelForces nominal = direct_.forces(spec.nominal_load_n, rolling(0, 0));
  const double arc = has_forces(nominal.status) ? nominal.theta_f_rad - nominal.theta_r_rad : 1;
  ky_scale_ = 3 / (spec.model.wheel.radius_m * arc);
  // Where kx does not depend on the slip angle, neither does Fx.
  constexpr double kNoGrowth_rad = 1e6;
  const Soil& soil = spec.model.soil;
  kx_angle_rad_ = std::min(soil.kx0_m / std::max(soil.kx1_m, 1e-300), kNoGrowth_rad);
}

ForceTable::ForceTable(const ForceTableSpec& spec)
    : ForceTable(spec, Grid{.loads = 16, .slips = 20, .laterals = 20}) {
  constexpr int kRefinements = 4, kShrinkings = 4;
  constexpr std::size_t kRandomStates = 20000, kCornerStates = 20000;
  limit_loads();
  const Grid coarse = grid_;
  for (int shrinking = 0; shrinking < kShrinkings && load_max_n_ > 2 * load_min_n_; ++shrinking) {
    for (int refinement = 0; refinement < kRefinements; ++refinement) {
      fill();
      error_ = check(kRandomStates, kCornerStates, 1);
      if (error_.within(spec.accuracy)) return;
      const auto finer = [](std::size_t n) { return n + n / 3; };
      grid_ = {finer(grid_.loads), finer(grid_.slips), finer(grid_.laterals)};
    }
    grid_ = coarse;
    load_max_n_ *= 0.7;
  }
  throw InputError(fmt::format(
      "no force table of this wheel on this soil reaches the accuracy asked: 99.9 % of states are "
      "within {:.2g} (asked {:.2g}), all within {:.2g} (asked {:.2g})",
      error_.at_999_permille, spec.accuracy.at_999_permille, error_.at_worst,
      spec.accuracy.at_worst));
}

TableError ForceTable::check(std::size_t random_states, std::size_t corner_states,
                             std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const double angle_max = std::atan(kTanMax);
  std::vector<double> errors;
  for (std::size_t i = 0; i < random_states + corner_states; ++i) {
    double load_at = uniform(random), slip_at_share = uniform(random);
    double angle = angle_max * uniform(random);
    const bool driving = uniform(random) < 0.5;
    if (i >= random_states) {
      const auto near_an_end = [&](double& share) {
        const double close = std::pow(10, -6 * uniform(random));
        share = uniform(random) < 0.5 ? close : 1 - close;
      };
      double angle_share = angle / angle_max;
      if (uniform(random) < 0.4) near_an_end(load_at);
      if (uniform(random) < 0.7) near_an_end(slip_at_share);
      if (uniform(random) < 0.7) near_an_end(angle_share);
      angle = angle_share * angle_max;
    }
    const double load_n = load_min_n_ * std::pow(load_max_n_ / load_min_n_, load_at);
    const double slip = (driving ? 1 : -1) * slip_max(driving) * slip_at_share;
    WheelMotion motion = rolling(slip, 0);
    motion.vy_mps = motion.vx_mps * std::tan(angle) * (i % 2 == 0 ? 1 : -1);
    if (!covers(load_n, motion)) continue;
    const WheelForces exact = direct_.forces(load_n, motion);
    const WheelForces table = forces(load_n, motion);
    const double scale = std::max(load_n, 0.1 * spec_.nominal_load_n);
    errors.push_back(
        has_forces(exact.status)
            ? std::max(std::abs(exact.fx_n - table.fx_n), std::abs(exact.fy_n - table.fy_n)) / scale
            : 1);
  }
  if (errors.empty()) return {};
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(double(errors.size()) * 0.999);
  std::nth_element(errors.begin(), at, errors.end());
  return {.at_999_permille = *at,
          .at_worst = *std::max_element(at, errors.end()),
          .states = errors.size()};
}

std::size_t ForceTable::bytes() const {
  std::size_t floats = 0;
  for (const Side& side : sides_) {
    floats += side.fx.size() + side.torque.size() + side.sinkage.size() + side.fy.size();
  }
  return floats * sizeof(float);
}

}  // namespace regoplan
