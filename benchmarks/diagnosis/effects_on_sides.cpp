#include <algorithm>
#include <cmath>

#include "benchmarks/diagnosis/truth_effect.h"
#include "benchmarks/diagnosis/truth_motion.h"

namespace regoplan::challenge {
namespace {

using P = TruthPhysics;

/// A rut whose edges differ by twice `share` of the sinkage at 16 deg and beyond.
P tilted(P p, double share, RutProfile profile) {
  const double x = beta_rad(p) / (16 * kDegree);
  p.profile = profile;
  p.rut = share * std::min(1.0, x * x);
  return p;
}

}  // namespace

std::vector<TruthEffect> effects_on_sides() {
  constexpr std::string_view kRutSource = "Yoshida & Ishigami 2004, Fig. 9; strip-wise reaction";
  return {
      {"rut_asymmetry",
       "edges",
       kRutSource,
       .5,
       .95,
       false,
       {.side = true},
       [](P p, double a, double) { return tilted(p, a, RutProfile::kCubic); }},
      {"rut_asymmetry",
       "parabola",
       kRutSource,
       .5,
       .95,
       false,
       {.side = true},
       [](P p, double a, double) { return tilted(p, a, RutProfile::kParabolic); }},
      {"rut_asymmetry",
       "terrace",
       kRutSource,
       .4,
       .75,
       false,
       {.side = true},
       [](P p, double a, double) { return tilted(p, a, RutProfile::kStep); }},
      {"rut_asymmetry",
       "strips_with_inner_wall",
       kRutSource,
       .3,
       .8,
       false,
       {.side = true},
       [](P p, double a, double u) {
         p.inner_flank = true;
         return tilted(p, a, u < 0.5 ? RutProfile::kParabolic : RutProfile::kCubic);
       }},
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

}  // namespace regoplan::challenge
