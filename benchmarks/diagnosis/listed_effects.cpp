#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/diagnosis/truth_effect.h"

namespace regoplan::challenge {
namespace {

using P = TruthPhysics;
using C = TruthChannels;

constexpr double kDegree = std::numbers::pi / 180;

double driving(const P& p) {
  return std::max(p.at.slip_ratio, 0.0);
}
double braking(const P& p) {
  return std::max(-p.at.slip_ratio, 0.0);
}
double beta_rad(const P& p) {
  return std::abs(p.at.slip_angle_rad);
}

std::vector<TruthEffect> of_sinkage() {
  return {
      {"slip_sinkage",
       "power",
       "Ding et al. 2014: h = h0 (1 + a s^p), p 1.3-2.1",
       .6,
       2.5,
       false,
       {},
       [](P p, double a, double u) {
         p.sinkage_factor *= 1 + a * std::pow(driving(p), 1.3 + 0.8 * u);
         return p;
       }},
      {"slip_sinkage",
       "exponential",
       "h = h0 exp(a s), after Reece 1965",
       .4,
       1.4,
       false,
       {},
       [](P p, double a, double) {
         p.sinkage_factor *= std::exp(a * driving(p));
         return p;
       }},
      {"slip_sinkage",
       "excavation",
       "sigma (1 - a s' (1 - exp(-|jx|/d))): soil carried out by the shear under the wheel",
       .2,
       .6,
       false,
       {},
       [](P p, double a, double u) {
         p.excavated_x = a * std::min(1.0, 3 * driving(p));
         p.excavation_m = (2 + 4 * u) * 0.1 * p.wheel.radius_m;
         return p;
       }},
      {"lateral_digging",
       "saturating",
       "h = h0 (1 + a t^2/(t^2 + t0^2)), t = tan|beta|",
       .4,
       2,
       false,
       {.side = true},
       [](P p, double a, double u) {
         const double t = std::tan(beta_rad(p)), t0 = std::tan((10 + 15 * u) * kDegree);
         p.sinkage_factor *= 1 + a * t * t / (t * t + t0 * t0);
         return p;
       }},
      {"lateral_digging",
       "slide",
       "h = h0 + a r u, u the lateral over the rim speed",
       .05,
       .4,
       false,
       {.side = true},
       [](P p, double a, double) {
         const double forward = 1 - driving(p);
         p.sinkage_added_m += a * 0.3 * p.wheel.radius_m * forward * std::tan(beta_rad(p));
         return p;
       }},
      {"layered_soil",
       "bilinear",
       "Wong 1989: two pressure-sinkage branches, by local depth",
       2,
       12,
       false,
       {.sinkage = true, .loads = true},
       [](P p, double a, double u) {
         p.deep_ratio = 1 + a;
         p.break_depth_m = (0.05 + 0.07 * u) * p.wheel.radius_m;
         return p;
       }},
      {"layered_soil",
       "crust",
       "p = k z^n + a k zc^n (1 - exp(-z/zc)), after Wong 1989",
       1,
       5,
       false,
       {.sinkage = true, .loads = true},
       [](P p, double a, double u) {
         p.crust = a;
         p.crust_depth_m = (0.015 + 0.03 * u) * p.wheel.radius_m;
         return p;
       }},
      {"rear_contact",
       "tanh",
       "lambda = lambda0 + a tanh(2.5 s) + a |beta|",
       .15,
       .6,
       false,
       {},
       [](P p, double a, double) {
         p.soil.lambda = std::clamp(
             p.soil.lambda + a * (std::tanh(2.5 * p.at.slip_ratio) + beta_rad(p)), 0.0, 1.5);
         return p;
       }},
      {"rear_contact",
       "exponential",
       "lambda = lambda0 exp(a s + b |beta|)",
       .6,
       1.6,
       false,
       {},
       [](P p, double a, double u) {
         p.soil.lambda = std::clamp(
             p.soil.lambda * std::exp(a * p.at.slip_ratio + 2 * a * u * beta_rad(p)), 0.0, 1.5);
         return p;
       }},
      {"max_stress_angle",
       "cosine",
       "theta_m/theta_f = (a0 + a1 s) cos(beta)^a",
       3,
       14,
       false,
       {.side = true},
       [](P p, double a, double) {
         const double c = std::pow(std::cos(beta_rad(p)), a);
         p.soil.a0 *= c;
         p.soil.a1 *= c;
         return p;
       }},
      {"max_stress_angle",
       "tangent",
       "theta_m/theta_f = a0 + a1 s + a tan|beta|",
       .25,
       .6,
       true,
       {.side = true},
       [](P p, double a, double) {
         p.soil.a0 = std::clamp(p.soil.a0 + a * std::tan(beta_rad(p)), 0.05, 0.95);
         return p;
       }},
      {"skid_branch",
       "remoulded",
       "s < 0: strength (1 - a |s|), h = h0 (1 + 2 a s^2)",
       .3,
       .9,
       false,
       {.skid = true},
       [](P p, double a, double) {
         p.limit *= 1 - a * braking(p);
         p.sinkage_factor *= 1 + 2 * a * braking(p) * braking(p);
         return p;
       }},
      {"skid_branch",
       "bow_wave",
       "s < 0: h = h0 + a |s|/(1 + |s|), kx (1 + 2 s^2)",
       .03,
       .12,
       false,
       {.skid = true},
       [](P p, double a, double) {
         p.sinkage_added_m += a * p.wheel.radius_m * braking(p) / (1 + braking(p));
         p.soil.kx0_m *= 1 + 2 * braking(p) * braking(p);
         return p;
       }},
      {"multi_pass",
       "logarithm",
       "k pass^a, c (1 + a ln(pass)/2), after Holm 1969",
       .3,
       1.5,
       false,
       {.passes = true},
       [](P p, double a, double) {
         p.stiffness *= std::pow(p.at.pass, a);
         p.soil.cohesion_pa *= 1 + a / 2 * std::log(p.at.pass);
         return p;
       }},
      {"multi_pass",
       "unload_reload",
       "Wong 1989: a stiff branch to the depth of the first pass",
       .5,
       3,
       false,
       {.passes = true},
       [](P p, double a, double u) {
         p.crust = a * (1 - std::exp(1.0 - p.at.pass));
         p.crust_depth_m = (0.05 + 0.1 * u) * p.wheel.radius_m;
         p.soil.kx0_m *= 1 - 0.2 * (1 - 1.0 / p.at.pass);
         return p;
       }},
      {"flexible_wheel",
       "flattened",
       "Schmid 1995: substitute circle sqrt(1 + f/h) + sqrt(f/h)",
       .002,
       .03,
       false,
       {.loads = true},
       [](P p, double a, double) {
         // f grows with the load over that which the nominal pressure of 10 kPa carries
         const double f =
             a * p.wheel.radius_m * p.at.load_n / (1e4 * p.wheel.width_m * p.wheel.radius_m);
         const double h = 0.12 * p.wheel.radius_m;
         const double root = std::sqrt(1 + f / h) + std::sqrt(f / h);
         p.wheel.radius_m *= 1 + (root * root - 1) / 4;
         return p;
       }},
  };
}

/// Lugs: Bekker's two factors on the shear strength, shear at the tips, digging.
P lugged(P p, double height_over_radius, double shape) {
  const double lug = height_over_radius * p.wheel.radius_m, b = p.wheel.width_m;
  const double bite = driving(p) / (driving(p) + 0.1);
  p.soil.cohesion_pa *= 1 + bite * 2 * lug / b;
  const double tan_phi = std::tan(p.soil.friction_angle_rad);
  p.soil.friction_angle_rad = std::atan(tan_phi * (1 + bite * 0.64 * lug / b * std::atan(b / lug)));
  p.lug_m = bite * lug;
  p.sinkage_added_m += (0.3 + 0.5 * shape) * lug * driving(p);
  return p;
}

std::vector<TruthEffect> of_shear() {
  return {
      {"shear_modulus_slip_angle",
       "saturating",
       "kx, ky (1 + a (1 - exp(-|beta|/beta0)))",
       .8,
       4,
       false,
       {.side = true},
       [](P p, double a, double u) {
         const double factor = 1 + a * -std::expm1(-beta_rad(p) / ((8 + 8 * u) * kDegree));
         p.soil.kx0_m *= factor;
         p.soil.kx1_m *= factor;
         p.soil.ky0_m *= factor;
         p.soil.ky1_m *= factor;
         return p;
       }},
      {"shear_modulus_slip_angle",
       "quadratic",
       "kx, ky (1 + a (beta/15 deg)^2)",
       .3,
       1.5,
       false,
       {.side = true},
       [](P p, double a, double) {
         const double x = beta_rad(p) / (15 * kDegree), factor = 1 + a * x * x;
         p.soil.kx0_m *= factor;
         p.soil.kx1_m *= factor;
         p.soil.ky0_m *= factor;
         p.soil.ky1_m *= factor;
         return p;
       }},
      {"coupled_shear",
       "friction_circle",
       "shares cut back to the circle where they leave it",
       .7,
       1,
       false,
       {.side = true},
       [](P p, double a, double) {
         p.circle = a;
         return p;
       }},
      {"coupled_shear",
       "product",
       "shares over sqrt(1 + (ex ey)^2), proxy",
       .7,
       1,
       false,
       {.side = true},
       [](P p, double a, double) {
         p.product = a;
         return p;
       }},
      {"grousers",
       "bekker",
       "Bekker 1956: c (1 + 2 hg/b), tan(phi) (1 + .64 hg/b atan(b/hg))",
       .06,
       .2,
       false,
       {},
       lugged},
      {"shear_hump",
       "kacigin_guskov",
       "Kacigin & Guskov 1968: (1 + a/cosh(j/k))",
       .3,
       1.2,
       false,
       {},
       [](P p, double a, double) {
         p.sech_peak = a;
         return p;
       }},
      {"shear_hump",
       "loosening",
       "1 - a (1 - exp(-(j/jp)^3)): strength lost beyond the peak",
       .15,
       .5,
       false,
       {},
       [](P p, double a, double u) {
         p.softening = a;
         p.softening_m = (1.5 + 2 * u) * p.soil.kx0_m;
         return p;
       }},
      {"rate_dependence",
       "logarithm",
       "k (1 + a ln(1 + v/v0)), v0 .02-.1 m/s",
       .1,
       .5,
       false,
       {.speeds = true},
       [](P p, double a, double u) {
         p.stiffness *= 1 + a * std::log1p(p.at.speed_mps / (0.02 + 0.08 * u));
         return p;
       }},
      {"rate_dependence",
       "viscous",
       "c, tan(phi) (1 + a v/(v + v0))",
       .1,
       .35,
       false,
       {.speeds = true},
       [](P p, double a, double u) {
         p.limit *= 1 + a * p.at.speed_mps / (p.at.speed_mps + 0.05 + 0.15 * u);
         return p;
       }},
      {"soil_zone",
       "blended",
       "k and phi change over .1 m of the bed",
       .25,
       .6,
       true,
       {.positions = true},
       [](P p, double a, double u) {
         const double inside = 0.5 * (1 + std::tanh((p.at.position_m - (0.7 + 0.6 * u)) / 0.05));
         p.stiffness *= std::exp(1.5 * a * inside);
         p.limit *= std::exp(0.35 * a * inside);
         return p;
       }},
      {"cohesion_drift",
       "root",
       "c (1 - a sqrt(t/T)): drying from the surface",
       .4,
       .95,
       false,
       {.times = true},
       [](P p, double a, double) {
         p.soil.cohesion_pa *= 1 - a * std::sqrt(std::min(1.0, p.at.time_s / 4e4));
         return p;
       }},
      {"cohesion_drift",
       "front",
       "c falls by a around a time: a drying front passes",
       .4,
       .95,
       false,
       {.times = true},
       [](P p, double a, double u) {
         p.soil.cohesion_pa *= 1 - a / 2 * (1 + std::tanh((p.at.time_s - (8e3 + 1.6e4 * u)) / 6e3));
         return p;
       }},
  };
}

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

std::vector<TruthEffect> of_sides() {
  const auto tilted = [](P p, double a, RutProfile profile) {
    // a: half the difference of the edges' depth at 16 deg over half the width
    const double x = beta_rad(p) / (16 * kDegree);
    p.profile = profile;
    p.rut_m = a * p.wheel.width_m / 2 * std::min(1.8, x * x);
    return p;
  };
  static const auto kTilted = tilted;
  constexpr std::string_view kRutSource = "Yoshida & Ishigami 2004, Fig. 9; strip-wise reaction";
  return {
      {"rut_asymmetry",
       "edges",
       kRutSource,
       .06,
       .25,
       false,
       {.side = true},
       [](P p, double a, double) { return kTilted(p, a, RutProfile::kCubic); }},
      {"rut_asymmetry",
       "parabola",
       kRutSource,
       .06,
       .25,
       false,
       {.side = true},
       [](P p, double a, double) { return kTilted(p, a, RutProfile::kParabolic); }},
      {"rut_asymmetry",
       "terrace",
       kRutSource,
       .05,
       .2,
       false,
       {.side = true},
       [](P p, double a, double) { return kTilted(p, a, RutProfile::kStep); }},
      {"side_pileup",
       "berm",
       "a berm at the angle of repose of the soil swept aside",
       .5,
       4,
       false,
       {.side = true},
       [](P p, double a, double) {
         const double swept_m2 = 0.1 * std::pow(p.wheel.radius_m, 2) * std::sin(beta_rad(p));
         p.berm_m = a * std::sqrt(0.1 * swept_m2 * std::tan(p.soil.friction_angle_rad)) *
                    std::min(1.0, beta_rad(p) / (8 * kDegree));
         return p;
       }},
  };
}

std::vector<TruthEffect> of_carriage() {
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

}  // namespace

const std::vector<TruthEffect>& listed_effects() {
  static const std::vector<TruthEffect> all = [] {
    std::vector<TruthEffect> effects;
    for (auto* part : {&of_sinkage, &of_shear, &of_sides, &of_carriage}) {
      const std::vector<TruthEffect> some = part();
      effects.insert(effects.end(), some.begin(), some.end());
    }
    return effects;
  }();
  return all;
}

std::optional<TruthChannels> channels_with(const std::vector<DrawnEffect>& effects,
                                           const TruthPhysics& base) {
  TruthPhysics p = base;
  for (const DrawnEffect& drawn : effects) {
    if (drawn.effect->act) p = drawn.effect->act(p, drawn.amplitude, drawn.shape);
  }
  if (!(p.at.load_n > 0)) return std::nullopt;
  std::optional<TruthChannels> c = truth_channels(p);
  if (!c) return c;
  for (const DrawnEffect& drawn : effects) {
    if (drawn.effect->after) c = drawn.effect->after(*c, p, drawn.amplitude, drawn.shape);
  }
  return c;
}

}  // namespace regoplan::challenge
