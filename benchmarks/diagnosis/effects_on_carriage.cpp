#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/diagnosis/truth_effect.h"
#include "benchmarks/diagnosis/truth_motion.h"

namespace regoplan::challenge {
namespace {

using P = TruthPhysics;
using C = TruthChannels;

/// Bekker 1969, general shear failure ahead of the wheel, with Terzaghi's N factors.
double bulldozing_n(const P& p, double z) {
  const double phi = p.soil.friction_angle_rad, c = p.soil.cohesion_pa;
  const double gamma = p.soil.density_kgpm3 * p.gravity_mps2;
  const double alpha = std::acos(1 - z / p.wheel.radius_m);
  const double nq = std::exp((1.5 * std::numbers::pi - phi) * std::tan(phi)) /
                    (2 * std::pow(std::cos(std::numbers::pi / 4 + phi / 2), 2));
  const double nc = (nq - 1) / std::tan(phi), ng = 2 * (nq + 1) * std::tan(phi);
  const double kc = (nc - std::tan(phi)) * std::pow(std::cos(phi), 2);
  const double kg = (2 * ng / std::tan(phi) + 1) * std::pow(std::cos(phi), 2);
  return p.wheel.width_m * std::sin(alpha + phi) / (2 * std::sin(alpha) * std::cos(phi)) *
         (2 * z * c * kc + gamma * z * z * kg);
}

}  // namespace

std::vector<TruthEffect> effects_on_carriage() {
  return {
      {"front_bulldozing",
       "terzaghi",
       "Bekker 1969 with Terzaghi's factors",
       .02,
       .15,
       false,
       {},
       nullptr,
       [](C c, const P& p, double a, double) {
         c.fx_n -= a * bulldozing_n(p, c.sinkage_m);
         return c;
       }},
      {"slope_tilt",
       "statics",
       "Fx - W sin(a) and the soil carries W cos(a)",
       .01,
       .06,
       true,
       {},
       [](P p, double a, double) {
         p.added_fx_n -= p.at.load_n * std::sin(a);
         p.at.load_n *= std::cos(a);
         return p;
       }},
      {"sidewall_shear",
       "earth_pressure",
       "earth pressure at rest on both flanks, by layers",
       .5,
       2,
       false,
       {.torque = true},
       [](P p, double a, double) {
         p.flank = a;
         return p;
       }},
      {"bearing_drag",
       "stribeck",
       "T0 (1 + exp(-w/w0)) + T1 W, Stribeck",
       .02,
       .15,
       false,
       {.torque = true},
       [](P p, double a, double u) {
         const double rim = p.at.speed_mps / std::max(0.05, 1 - driving(p));
         const double rest = std::exp(-rim / (0.02 + 0.1 * u));
         p.added_torque_nm += a * p.wheel.radius_m * (10 * (1 + rest) + 0.4 * p.at.load_n);
         return p;
       }},
      {"load_transfer",
       "lever",
       "W (1 + a + a s): the drive's torque presses on the wheel",
       .05,
       .2,
       true,
       {},
       [](P p, double a, double) {
         p.at.load_n *= 1 + a * (1 + 0.5 * driving(p));
         return p;
       }},
      {"load_transfer",
       "spring",
       "W + a W0 sqrt(W/W0): a carriage that hangs in its springs",
       .05,
       .2,
       true,
       {},
       [](P p, double a, double) {
         const double w0 = 1e4 * p.wheel.width_m * p.wheel.radius_m;
         p.at.load_n += a * w0 * std::sqrt(p.at.load_n / w0);
         return p;
       }},
      {"slope_tilt",
       "side",
       "Fy by W sin(a): the bed falls off to one side",
       .01,
       .06,
       true,
       {.both_sides = true},
       [](P p, double a, double) {
         p.added_fy_n += p.at.load_n * std::sin(a);
         p.at.load_n *= std::cos(a);
         return p;
       }},
  };
}

}  // namespace regoplan::challenge
