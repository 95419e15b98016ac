#include "terramech/wheel/rut_strips.h"

#include <algorithm>
#include <cmath>

#include "terramech/basics/angles.h"
#include "terramech/basics/bracketed_root.h"

namespace regoplan {

using wheel_contact::LawIntegrals;

RutStrips::Strip RutStrips::strip(std::size_t i, double sinkage_m) const {
  const double r = ground_.wheel.radius_m, b = ground_.wheel.width_m;
  const double inner_m = b * ((static_cast<double>(i) + 0.5) / static_cast<double>(count_) - 0.5);
  const double depth = std::clamp(sinkage_m + inner_m * std::tan(tilt_rad_), 1e-9 * r, r);
  const wheel_contact::Contact contact =
      wheel_contact::contact_at(ground_, wheel_contact::entry_angle_rad(depth, r), ratios_.slip);
  if (is_base_law()) {
    return {inner_m,
            contact,
            {.plane = wheel_contact::integrate(ground_, contact, ratios_, accuracy_)}};
  }
  return {inner_m, contact,
          wheel_contact::integrate_with_law(ground_, contact, ratios_, law_, accuracy_)};
}

LawIntegrals RutStrips::together(double sinkage_m) const {
  const double share = 1 / static_cast<double>(count_);
  LawIntegrals mean;
  for (std::size_t i = 0; i < count_; ++i) {
    const LawIntegrals one = strip(i, sinkage_m).integrals;
    mean.plane.cohesion = mean.plane.cohesion + share * one.plane.cohesion;
    mean.plane.stress = mean.plane.stress + share * one.plane.stress;
    mean.fu_cohesion_n += share * one.fu_cohesion_n;
    mean.fu_stress_n += share * one.fu_stress_n;
  }
  return mean;
}

std::optional<double> RutStrips::entry_angle(double load_n, double guess_rad) const {
  constexpr double kStep = 1.15, kShallowest = 1e-6;
  const auto excess = [&](double theta_f) {
    return together(wheel_contact::sinkage_at_m(theta_f, ground_.wheel.radius_m)).plane.at(1).fz_n -
           load_n;
  };
  double low = guess_rad, high = guess_rad;
  while (excess(low) >= 0) {
    high = low;
    low /= kStep;
    if (low < kShallowest) return std::nullopt;
  }
  while (high == low || excess(high) < 0) {
    if (high >= kQuarterTurn) return std::nullopt;
    low = high;
    high = std::min(high * kStep, kQuarterTurn * (1 - 1e-12));
    if (low == high) return std::nullopt;
  }
  return bracketed_root(excess,
                        {.from = low, .f_from = excess(low), .to = high, .f_to = excess(high)},
                        {.argument = 1e-12 * high, .value = 1e-10 * load_n, .calls_max = 60});
}

RutStrips::Sideways RutStrips::sideways(double sinkage_m, double q, double load_n) const {
  const double share = 1 / static_cast<double>(count_);
  double fz = 0, fu = 0, fs = 0, roll = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Strip at = strip(i, sinkage_m);
    const double strip_fz = share * at.integrals.plane.at(q).fz_n;
    fz += strip_fz;
    roll += strip_fz * at.inner_m;
    if (is_base_law()) {
      fu += share * wheel_contact::side_force_n(ground_, at.contact, ratios_, q, accuracy_);
      continue;
    }
    fu += share * (at.integrals.fu_cohesion_n + q * at.integrals.fu_stress_n);
    fs += share * wheel_contact::bulldozing_force_n(ground_, at.contact, ratios_);
  }
  return {.force_n = fu + fs, .roll_nm = roll * load_n / fz};
}

}  // namespace regoplan
