#include <algorithm>
#include <cmath>

#include "benchmarks/diagnosis/truth_effect.h"

namespace regoplan::challenge {
namespace {

using P = TruthPhysics;
using C = TruthChannels;

}  // namespace

const std::vector<TruthEffect>& drift_effects() {
  static const std::vector<TruthEffect> all{
      {"cohesion_drift",
       "exponential",
       "c (1 - a (1 - exp(-t/T))): a thin layer dries at a rate that falls with its moisture",
       .4,
       .95,
       false,
       {.times = true},
       [](P p, double a, double u) {
         p.soil.cohesion_pa *= 1 - a * (1 - std::exp(-p.at.time_s / (6e3 + 1.2e4 * u)));
         return p;
       }},
      {"soil_zone",
       "patch",
       "a patch of other soil with two straight edges, as a box of other sand let into the bed",
       .25,
       .6,
       true,
       {.positions = true},
       [](P p, double a, double u) {
         const double middle_m = 0.6 + 0.8 * u;
         if (std::abs(p.at.position_m - middle_m) > 0.4) return p;
         p.stiffness *= 1 + 1.2 * a;
         p.limit *= 1 + 0.3 * a;
         return p;
       }},
      {"bed_memory",
       "loosened",
       "invented: the run before has loosened the bed by the square of its slip",
       .1,
       .4,
       false,
       {.sweep = true},
       [](P p, double a, double) {
         const double before = std::max(p.at.previous_slip_ratio, 0.0);
         p.stiffness *= 1 - a * before * before;
         p.limit *= 1 - a * before * before;
         return p;
       }},
      {"warm_up",
       "gain",
       "the amplifier's gain settles exponentially from the start of the series",
       .06,
       .25,
       true,
       {.times = true},
       nullptr,
       [](C c, const P& p, double a, double u) {
         const double gain = 1 + a * std::exp(-p.at.time_s / (4e3 + 8e3 * u));
         c.fx_n *= gain;
         c.fy_n *= gain;
         return c;
       }},
  };
  return all;
}

}  // namespace regoplan::challenge
