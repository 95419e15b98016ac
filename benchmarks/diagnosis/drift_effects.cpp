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

const std::vector<TruthEffect>& effects_in_days() {
  static const std::vector<TruthEffect> all{
      {"cohesion_drift",
       "with the series",
       "c (1 - a (1 - exp(-t/T))), T of a fifth to four fifths of the series",
       .4,
       .95,
       false,
       {.times = true},
       [](P p, double a, double u) {
         const double passed = p.at.time_s / p.at.series_s;
         p.soil.cohesion_pa *= 1 - a * (1 - std::exp(-passed / (.2 + .6 * u)));
         return p;
       }},
      {"cohesion_drift",
       "sieved again",
       "c (1 + a) from one day on: the bed was sieved or wetted anew",
       .5,
       1.5,
       true,
       {.loads = true, .times = true},
       [](P p, double a, double u) {
         const int from = u < .5 ? 1 : 2;
         if (p.at.day >= from) p.soil.cohesion_pa *= a > 0 ? 1 + a : 1 / (1 - a);
         return p;
       }},
      {"bed_preparation",
       "one day",
       "the bed of one day is packed denser or looser: stiffness by a share, strength by a third",
       .15,
       .6,
       true,
       {},
       [](P p, double a, double u) {
         if (p.at.day != static_cast<int>(2.999 * u)) return p;
         p.stiffness *= 1 + a;
         p.limit *= 1 + a / 3;
         return p;
       }},
      {"warm_up",
       "with the series",
       "the amplifier's gain settles exponentially in the course of the series",
       .06,
       .25,
       true,
       {},
       nullptr,
       [](C c, const P& p, double a, double u) {
         const double gain = 1 + a * std::exp(-p.at.time_s / p.at.series_s / (.1 + .4 * u));
         c.fx_n *= gain;
         c.fy_n *= gain;
         return c;
       }},
      {"gain_drift",
       "linear",
       "the gain of one channel drifts in proportion to time",
       .06,
       .3,
       true,
       {.torque = true},
       nullptr,
       [](C c, const P& p, double a, double u) {
         (u < .5 ? c.fx_n : c.torque_nm) *= 1 + a * p.at.time_s / p.at.series_s;
         return c;
       }},
      {"zero_jump",
       "one day",
       "the zero of the drawbar pull is off on one day, by a share of the middle load",
       .03,
       .1,
       true,
       {},
       nullptr,
       [](C c, const P& p, double a, double u) {
         if (p.at.day == static_cast<int>(2.999 * u)) c.fx_n += a * p.at.middle_load_n;
         return c;
       }},
  };
  return all;
}

}  // namespace regoplan::challenge
