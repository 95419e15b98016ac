#include <algorithm>
#include <cmath>

#include "benchmarks/diagnosis/truth_effect.h"
#include "benchmarks/diagnosis/truth_motion.h"

namespace regoplan::challenge {
namespace {

using P = TruthPhysics;

}  // namespace

std::vector<TruthEffect> effects_on_sinkage() {
  return {
      {"slip_sinkage",
       "saturating",
       "h = h0 (1 + a (1 - exp(-s/s0))), s0 .15-.5: digging that tails off as the rut fills",
       .6,
       2.5,
       false,
       {},
       [](P p, double a, double u) {
         const double s0 = 0.15 + 0.35 * u;
         p.sinkage_factor *= 1 + a * (1 - std::exp(-driving(p) / s0));
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
       "stiff_skin",
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
       "s < 0: h = h0 + a |s|/(1 + |s|), kx (1 + 25 a s^2)",
       .03,
       .12,
       false,
       {.skid = true},
       [](P p, double a, double) {
         p.sinkage_added_m += a * p.wheel.radius_m * braking(p) / (1 + braking(p));
         p.soil.kx0_m *= 1 + 25 * a * braking(p) * braking(p);
         return p;
       }},
      {"skid_branch",
       "pushed_soil",
       "s < 0: Fx - a W |s|^(1/2), h = h0 (1 + a |s|): the wheel pushes soil ahead",
       .03,
       .25,
       false,
       {.skid = true},
       [](P p, double a, double) {
         p.added_fx_n -= a * p.at.load_n * std::sqrt(braking(p));
         p.sinkage_factor *= 1 + a * braking(p);
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
         p.soil.kx0_m *= 1 - 0.1 * std::min(a, 3.0) * (1 - 1.0 / p.at.pass);
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

}  // namespace regoplan::challenge
