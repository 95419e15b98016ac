// Building a force table: the loads that it can cover, the axes refined each by its own error, and
// the check against the direct model.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "terramech/basics/input_error.h"
#include "terramech/force_table/force_table.h"

namespace regoplan {
namespace {

using namespace force_table;

constexpr double kLowestShare = 0.02, kHighestShare = 3;  // of the nominal load

/// Whether the model carries a load at every motion that a table covers, and at full side slip.
bool carries(const WheelModel& model, double load_n) {
  constexpr int kSteps = 8;
  for (const bool driving : {false, true}) {
    for (int i = 0; i <= kSteps; ++i) {
      for (const double tangent : {0.0, kTanMax, 1e15}) {
        const WheelMotion motion = rolling(axle_at(double(i) / kSteps, driving), tangent);
        if (!has_forces(model.forces(load_n, motion).status)) return false;
      }
    }
  }
  return true;
}

Axes axes_of(const WheelModel& model, double nominal_load_n) {
  constexpr double kMargin = 1.1, kStep = 0.9;
  Axes axes{.load_min_n = kLowestShare * nominal_load_n,
            .load_max_n = kHighestShare * nominal_load_n};
  const auto any = [&] { return axes.load_max_n > axes.load_min_n; };
  while (any() && !carries(model, kMargin * axes.load_max_n)) axes.load_max_n *= kStep;
  while (any() && !carries(model, axes.load_min_n / kMargin)) axes.load_min_n /= kStep;
  const Wheel& wheel = model.spec().wheel;
  const Soil& soil = model.spec().soil;
  const WheelForces nominal = model.forces(nominal_load_n, rolling(1, 0));
  const double arc = has_forces(nominal.status) ? nominal.theta_f_rad - nominal.theta_r_rad : 1;
  axes.lateral_bend = 1 + soil.kx1_m / soil.kx0_m;
  axes.lateral_bend_per_axle = wheel.radius_m * arc / (3 * soil.ky0_m);
  return axes;
}

/// What the forces have at a motion and at the opposite one alike.
/// \throws InputError where they depend on the speed
ConstantShares constant_shares(const WheelModel& model, double load_n) {
  const WheelMotion motion = rolling(0.8, 0.3);
  const auto forces = [&](double factor) {
    return model.forces(
        load_n, {factor * motion.vx_mps, factor * motion.vy_mps, factor * motion.rim_speed_mps});
  };
  const WheelForces there = forces(1), back = forces(-1), slow = forces(0.1);
  constexpr double kSame = 1e-6;
  if (std::abs(slow.fx_n - there.fx_n) > kSame * load_n ||
      std::abs(slow.torque_nm - there.torque_nm) > kSame * load_n * model.spec().wheel.radius_m) {
    throw InputError("no force table of this wheel on this soil: its forces depend on the speed");
  }
  return {.x = (there.fx_n + back.fx_n) / (2 * load_n),
          .y = (there.fy_n + back.fy_n) / (2 * load_n)};
}

struct State {
  double load_n;
  WheelMotion motion;
};

/// Uniform in ln(load), slip and slip angle, any direction; \param near_corners most of them close
/// to ends of these: to 1e-6 of an axis
State random_state(const Axes& axes, std::mt19937_64& random, bool near_corners) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto share = [&](double often) {
    const double anywhere = uniform(random);
    if (!near_corners || uniform(random) > often) return anywhere;
    const double close = std::pow(10, -6 * uniform(random));
    return uniform(random) < 0.5 ? close : 1 - close;
  };
  const double load_n = load_at(axes, share(0.4));
  const double slip = share(0.7);
  const double axle =
      uniform(random) < 0.5 ? 1 - kSlipMaxDriving * slip : 1 / (1 - kSlipMaxBraking * slip);
  const WheelMotion at = rolling(axle, std::tan(share(0.7) * std::atan(kTanMax)));
  const double ahead = uniform(random) < 0.5 ? 1 : -1, left = uniform(random) < 0.5 ? 1 : -1;
  return {load_n, {ahead * at.vx_mps, left * at.vy_mps, ahead * at.rim_speed_mps}};
}

}  // namespace

ForceTable::ForceTable(const ForceTableSpec& spec, Values values, const TableError& error)
    : spec_(spec), direct_(spec.model), values_(std::move(values)), error_(error) {}

ForceTable::ForceTable(const ForceTableSpec& spec) : spec_(spec), direct_(spec.model) {
  if (!(spec.nominal_load_n > 0 && std::isfinite(spec.nominal_load_n))) {
    throw ValueError("nominal_load_n", spec.nominal_load_n, "above 0");
  }
  // A generic correction has edges that no spline follows: it is added to what the table gives.
  WheelModelSpec named = spec.model;
  named.generic.reset();
  const WheelModel model(named);
  Axes axes = axes_of(model, spec.nominal_load_n);
  if (!(axes.load_max_n > 2 * axes.load_min_n)) {
    throw InputError(
        fmt::format("no force table of this wheel on this soil: no loads from {:.3g} to {:.3g} N "
                    "are carried at "
                    "every slip from -{} to {}",
                    kLowestShare * spec.nominal_load_n, kHighestShare * spec.nominal_load_n,
                    kSlipMaxBraking, kSlipMaxDriving));
  }
  const ConstantShares constant =
      constant_shares(model, std::sqrt(axes.load_min_n * axes.load_max_n));
  // What is asked holds for other states than those of the check as well.
  constexpr double kReserve = 0.85;
  const TableAccuracy accuracy{.at_999_permille = kReserve * spec.accuracy.at_999_permille,
                               .at_worst = kReserve * spec.accuracy.at_worst};
  constexpr int kShrinkings = 3;
  for (int i = 0; i < kShrinkings && axes.load_max_n > 2 * axes.load_min_n; ++i) {
    if (refine(model, axes, constant, accuracy)) return;
    axes = with_fewer_loads(axes);
  }
  throw InputError(fmt::format(
      "no force table of this wheel on this soil reaches the accuracy asked: 99.9 % of states are "
      "within {:.2g} (asked {:.2g}), all within {:.2g} (asked {:.2g})",
      error_.at_999_permille, spec.accuracy.at_999_permille, error_.at_worst,
      spec.accuracy.at_worst));
}

/// Tabulates ever finer, each axis as its own error asks, until the check is within the accuracy.
bool ForceTable::refine(const WheelModel& model, const Axes& axes, const ConstantShares& constant,
                        const TableAccuracy& accuracy) {
  constexpr std::size_t kMostNodes = 60000;  // on either side of slip 0: 2 MB
  constexpr std::size_t kRandomStates = 20000, kCornerStates = 20000;
  constexpr double kOrder = 4, kLeastGrowth = 1.15, kMostGrowth = 1.6;
  double share = 0.6;  // of the accuracy that an axis alone may use up
  std::mt19937_64 random(1);
  Sizes sizes{.loads = 8, .slips = 12, .laterals = 8};
  while (sizes.loads * sizes.slips * sizes.laterals < kMostNodes) {
    values_ = tabulate(model, axes, sizes, constant);
    bool fine = true;
    for (const auto along : {&Sizes::loads, &Sizes::slips, &Sizes::laterals}) {
      const double excess = excess_along(along, accuracy, random) / share;
      if (excess <= 1) continue;
      const double growth = std::clamp(std::pow(excess, 1 / kOrder), kLeastGrowth, kMostGrowth);
      sizes.*along =
          static_cast<std::size_t>(std::ceil(static_cast<double>(sizes.*along) * growth));
      fine = false;
    }
    if (!fine) continue;
    error_ = check(kRandomStates, kCornerStates, 1);
    if (error_.within(accuracy)) return true;
    share *= 0.6;
  }
  error_ = check(kRandomStates, kCornerStates, 1);
  return error_.within(accuracy);
}

/// Errors half way between the nodes of one axis and on those of the others are that axis's own:
/// what they are over the accuracy.
double ForceTable::excess_along(std::size_t Sizes::*axis, const TableAccuracy& accuracy,
                                std::mt19937_64& random) const {
  constexpr std::size_t kStates = 500, kTail = 4;
  std::uniform_real_distribution<double> uniform(0, 1);
  const Axes& axes = values_.axes;
  std::vector<double> errors;
  for (std::size_t state = 0; state < kStates; ++state) {
    const auto coordinate = [&](std::size_t Sizes::*along) {
      const auto n = static_cast<double>(values_.sizes.*along);
      return along == axis ? (std::floor(uniform(random) * n) + 0.5) / n
                           : std::floor(uniform(random) * (n + 1)) / n;
    };
    const double load_n = load_at(axes, coordinate(&Sizes::loads));
    const double axle = axle_at(coordinate(&Sizes::slips), uniform(random) < 0.5);
    errors.push_back(
        error_in(load_n, rolling(axle, tangent_at(axes, axle, coordinate(&Sizes::laterals)))));
  }
  std::sort(errors.begin(), errors.end());
  return std::max(errors[kStates - kTail] / accuracy.at_999_permille,
                  errors.back() / accuracy.at_worst);
}

/// Cuts that end of the loads off which is the less accurate.
Axes ForceTable::with_fewer_loads(Axes axes) const {
  constexpr int kStates = 4000;
  constexpr double kShare = 0.15;  // of the logarithm
  std::mt19937_64 random(2);
  double light = 0, heavy = 0;
  const double middle_n = std::sqrt(axes.load_min_n * axes.load_max_n);
  for (int i = 0; i < kStates; ++i) {
    const State at = random_state(axes, random, false);
    (at.load_n < middle_n ? light : heavy) += error_in(at.load_n, at.motion);
  }
  const double cut = std::pow(axes.load_max_n / axes.load_min_n, kShare);
  if (light > heavy) {
    axes.load_min_n *= cut;
  } else {
    axes.load_max_n /= cut;
  }
  return axes;
}

/// Over max(load, 10 % of nominal).
double ForceTable::error_in(double load_n, const WheelMotion& motion) const {
  const WheelForces exact = direct_.forces(load_n, motion);
  if (!has_forces(exact.status)) return 1;
  const WheelForces looked_up = forces(load_n, motion);
  return std::max(std::abs(exact.fx_n - looked_up.fx_n), std::abs(exact.fy_n - looked_up.fy_n)) /
         std::max(load_n, 0.1 * spec_.nominal_load_n);
}

TableError ForceTable::check(std::size_t random_states, std::size_t corner_states,
                             std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  std::vector<double> errors;
  errors.reserve(random_states + corner_states);
  for (std::size_t i = 0; i < random_states + corner_states; ++i) {
    const State at = random_state(values_.axes, random, i >= random_states);
    if (covers(at.load_n, at.motion)) errors.push_back(error_in(at.load_n, at.motion));
  }
  if (errors.empty()) return {};
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(double(errors.size()) * 0.999);
  std::nth_element(errors.begin(), at, errors.end());
  return {.at_999_permille = *at,
          .at_worst = *std::max_element(at, errors.end()),
          .states = errors.size()};
}

}  // namespace regoplan
