#include "terramech/wheel/sinkage_solver.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "terramech/basics/angles.h"

namespace regoplan::wheel_contact {
namespace {

double fz_n(const Ground& ground, double theta_f_rad, const Ratios& ratios,
            WheelAccuracy accuracy) {
  return integrate(ground, contact_at(ground, theta_f_rad, ratios.slip), ratios, accuracy)
      .at(1)
      .fz_n;
}

/// Ratios at a slip ratio and slip angle 0; the axle of a locked wheel counts as very fast.
Ratios straight_at(double slip) {
  return {.axle = slip >= 0 ? 1 - slip : 1 / std::max(1 + slip, 1e-6), .slip = slip};
}

/// The root in [low, high], Fz below the load at low and not below it at high.
Equilibrium close_in(const Ground& ground, double load_n, const Ratios& ratios,
                     WheelAccuracy accuracy, double low, double high) {
  std::uintmax_t iterations = 60;
  constexpr int kBits = 42;
  const auto root = boost::math::tools::toms748_solve(
      [&](double theta_f) { return fz_n(ground, theta_f, ratios, accuracy) - load_n; }, low, high,
      boost::math::tools::eps_tolerance<double>(kBits), iterations);
  const Contact contact = contact_at(ground, root.second, ratios.slip);
  return {contact, integrate(ground, contact, ratios, accuracy).at(1)};
}

/// Steps outward from almost no contact, finest where it is shallow, to the first entry angle that
/// carries the load; a hump of Fz between two steps that almost reaches the load is looked into.
/// The steps themselves are integrated fast.
std::optional<Equilibrium> search(const Ground& ground, double load_n, const Ratios& ratios,
                                  WheelAccuracy accuracy) {
  constexpr int kSteps = 60;
  constexpr double kShallowest = 1e-6;
  constexpr double kNearlyReached = 0.8;
  const auto fz = [&](double theta_f) { return fz_n(ground, theta_f, ratios, accuracy); };
  const auto crosses = [&](double low, double high) {
    return fz(low) < load_n && fz(high) >= load_n;
  };
  // steps of a constant ratio up to .1 rad, then of constant size
  const auto theta_at = [&](int i) {
    constexpr int kRatioSteps = 20;
    constexpr double kShallow = 0.1;
    return i <= kRatioSteps
               ? kShallowest * std::pow(kShallow / kShallowest, double(i) / kRatioSteps)
               : kShallow + (kQuarterTurn - kShallow) * (i - kRatioSteps) / (kSteps - kRatioSteps);
  };
  const auto rough_fz = [&](int i) {
    return fz_n(ground, theta_at(i), ratios, WheelAccuracy::kFast);
  };
  double before = 0, low = kShallowest;
  double fz_before = 0, fz_low = rough_fz(0);
  for (int i = 1; i <= kSteps + 1; ++i) {
    const double high = theta_at(std::min(i, kSteps));
    const double fz_high = i <= kSteps ? rough_fz(i) : -1;
    constexpr double kRough = 1e-3;
    if (i <= kSteps && fz_high >= (1 - kRough) * load_n && crosses(low, high)) {
      return close_in(ground, load_n, ratios, accuracy, low, high);
    }
    if (fz_low > fz_before && fz_low > fz_high && fz_low > kNearlyReached * load_n) {
      constexpr int kBits = 20;
      const auto top = boost::math::tools::brent_find_minima(
          [&](double theta_f) { return -fz(theta_f); }, before, high, kBits);
      if (-top.second >= load_n && fz(before) < load_n) {
        return close_in(ground, load_n, ratios, accuracy, before, top.first);
      }
    }
    before = low;
    fz_before = fz_low;
    low = high;
    fz_low = fz_high;
  }
  return std::nullopt;
}

}  // namespace

SinkageSolver::Table SinkageSolver::tabulate(const Ground& ground, double beta_abs_rad) {
  constexpr std::size_t kAngles = 15;
  constexpr double kShallowest = 0.01;
  constexpr double kNone = -700;
  const double log_theta_min = std::log(kShallowest);
  const double log_theta_step = std::log(kQuarterTurn / kShallowest) / (kAngles - 1);
  std::array<std::array<double, kAngles>, kSlips> log_fz{};
  double log_load_max = kNone;
  Table table;
  table.kx_m = ground.soil.kx0_m + ground.soil.kx1_m * beta_abs_rad;
  table.log_load_min = -kNone;
  for (std::size_t i = 0; i < kAngles; ++i) {
    const double theta_f = std::exp(log_theta_min + static_cast<double>(i) * log_theta_step);
    for (std::size_t row = 0; row < kSlips; ++row) {
      const double t = 2 * static_cast<double>(row) / (kSlips - 1) - 1;
      Ratios ratios = straight_at(t * std::abs(t));
      ratios.beta_abs_rad = beta_abs_rad;
      const double fz = fz_n(ground, theta_f, ratios, WheelAccuracy::kFast);
      log_fz[row][i] = fz > 1e-300 ? std::log(fz) : kNone;
      log_load_max = std::max(log_load_max, log_fz[row][i]);
      if (log_fz[row][i] > kNone) {
        table.log_load_min = std::min(table.log_load_min, log_fz[row][i]);
      }
    }
  }
  table.log_load_step = std::max(log_load_max - table.log_load_min, 1e-3) / (kLoads - 1);
  for (std::size_t row = 0; row < kSlips; ++row) {
    const auto& fz = log_fz[row];
    const auto top = static_cast<std::size_t>(std::max_element(fz.begin(), fz.end()) - fz.begin());
    std::size_t i = 0;
    for (std::size_t k = 0; k < kLoads; ++k) {
      const double log_load = table.log_load_min + static_cast<double>(k) * table.log_load_step;
      // the first crossing is that of the smallest root; where there is none, the best carried
      while (i + 1 < kAngles && fz[i + 1] < log_load) ++i;
      const double at = i + 1 == kAngles
                            ? static_cast<double>(top)
                            : static_cast<double>(i) +
                                  std::clamp((log_load - fz[i]) / (fz[i + 1] - fz[i]), 0.0, 1.0);
      table.log_theta_f[row][k] = log_theta_min + at * log_theta_step;
    }
  }
  return table;
}

SinkageSolver::SinkageSolver(const Ground& ground)
    : power_(2 * ground.soil.n + 1),
      kx_varies_(ground.soil.kx1_m > 0),
      straight_(tabulate(ground, 0)) {
  if (kx_varies_) at_slip_angle_ = tabulate(ground, 1);
}

SinkageSolver::SinkageSolver(const Ground& ground, const SinkageSolver& near)
    : power_(2 * ground.soil.n + 1),
      kx_varies_(near.kx_varies_),
      straight_(near.straight_),
      at_slip_angle_(near.at_slip_angle_) {}

SinkageSolver::Guess SinkageSolver::look_up(const Table& table, double log_load,
                                            const Ratios& ratios, double kx_m) const {
  // A larger kx acts like a smaller slip velocity.
  const double excess = (ratios.axle - ratios.rim) * table.kx_m / kx_m;
  const double slip = excess <= 0 ? -excess : 1 / (1 + excess) - 1;
  const double t = std::copysign(std::sqrt(std::abs(slip)), slip);
  const double row_at = std::clamp((t + 1) / 2 * (kSlips - 1), 0.0, kSlips - 1.0);
  const auto row = std::min(static_cast<std::size_t>(row_at), kSlips - 2);
  const double u = row_at - static_cast<double>(row);
  const double load_at = (log_load - table.log_load_min) / table.log_load_step;
  const double inside = std::clamp(load_at, 0.0, kLoads - 1.0);
  const auto k = std::min(static_cast<std::size_t>(inside), kLoads - 2);
  const double v = inside - static_cast<double>(k);
  const auto& a = table.log_theta_f[row];
  const auto& b = table.log_theta_f[row + 1];
  const double low = a[k] + u * (b[k] - a[k]);
  const double rise = a[k + 1] + u * (b[k + 1] - a[k + 1]) - low;
  const double below = std::min(load_at, 0.0) * table.log_load_step / power_;
  return {.log_theta_f = low + v * rise + below,
          .slope = load_at <= 0 ? power_ : std::clamp(table.log_load_step / rise, 0.3, 2 * power_)};
}

SinkageSolver::Guess SinkageSolver::guess(const Ground& ground, double load_n,
                                          const Ratios& ratios) const {
  const double kx = ground.soil.kx0_m + ground.soil.kx1_m * ratios.beta_abs_rad;
  const double log_load = std::log(load_n);
  Guess guess = look_up(straight_, log_load, ratios, kx);
  if (kx_varies_) {
    const double share = (kx - straight_.kx_m) / (at_slip_angle_.kx_m - straight_.kx_m);
    const Guess other = look_up(at_slip_angle_, log_load, ratios, kx);
    guess.log_theta_f += share * (other.log_theta_f - guess.log_theta_f);
  }
  return guess;
}

std::optional<Equilibrium> SinkageSolver::solve(const Ground& ground, double load_n,
                                                const Ratios& ratios,
                                                WheelAccuracy accuracy) const {
  // What is left after the linear correction is of the order of the product of the last two errors.
  const double product_tolerance = accuracy == WheelAccuracy::kFast ? 2e-5 : 1e-7;
  const double converged = accuracy == WheelAccuracy::kFast ? 1e-5 : 1e-9;
  constexpr int kIterations = 10;
  const Guess start = guess(ground, load_n, ratios);
  double theta_f = std::exp(start.log_theta_f);
  double slope = start.slope;
  double step = 0;  // in ln theta_f, that led here
  double y_before = 0;
  Resultant before;
  for (int iteration = 0; iteration < kIterations && theta_f < kQuarterTurn; ++iteration) {
    const Contact contact = contact_at(ground, theta_f, ratios.slip);
    const Resultant at = integrate(ground, contact, ratios, accuracy).at(1);
    if (!(at.fz_n > 0)) break;
    // ln(Fz/load) but for its cube
    const double y = 2 * (at.fz_n - load_n) / (at.fz_n + load_n);
    if (std::abs(y) < converged) return Equilibrium{contact, at};
    if (iteration > 0) {
      slope = (y - y_before) / step;
      constexpr double kRising = 0.1, kFlat = 0.5;
      if (!(slope > kRising)) break;
      if (slope < kFlat && accuracy == WheelAccuracy::kFast) {
        // small errors of Fz are large ones of the sinkage
        return solve(ground, load_n, ratios, WheelAccuracy::kExact);
      }
    }
    const double next = std::clamp(-y / slope, -1.0, 0.5);
    if (iteration > 0 && std::abs(y * step) < product_tolerance) {
      // Fx/Fz and T/Fz are nearly linear in ln theta_f
      const double along = next / step;
      const auto corrected = [&](double now, double then) {
        const double ratio = now / at.fz_n;
        return load_n * (ratio + along * (ratio - then / before.fz_n));
      };
      return Equilibrium{contact_at(ground, theta_f * (1 + next / 2) / (1 - next / 2), ratios.slip),
                         {.fx_n = corrected(at.fx_n, before.fx_n),
                          .fz_n = load_n,
                          .torque_nm = corrected(at.torque_nm, before.torque_nm)}};
    }
    y_before = y;
    before = at;
    step = next;
    theta_f *= (1 + next / 2) / (1 - next / 2);  // exp(next) but for its cube
  }
  return search(ground, load_n, ratios, accuracy);
}

}  // namespace regoplan::wheel_contact
