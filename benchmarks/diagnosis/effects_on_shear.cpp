#include <algorithm>
#include <cmath>

#include "benchmarks/diagnosis/truth_effect.h"
#include "benchmarks/diagnosis/truth_motion.h"

namespace regoplan::challenge {
namespace {

using P = TruthPhysics;

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

}  // namespace

std::vector<TruthEffect> effects_on_shear() {
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
      {"shear_hump",
       "brittle",
       "Bekker 1956: a share a of the soil has a peak and no strength far beyond",
       .15,
       .5,
       false,
       {},
       [](P p, double a, double) {
         p.brittle = a;
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

}  // namespace regoplan::challenge
