#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/diagnosis/truth_effect.h"

namespace regoplan::challenge {
namespace {

using P = TruthPhysics;
using C = TruthChannels;

constexpr double kTurn = 2 * std::numbers::pi;

double bump(double x, double middle, double width) {
  return std::exp(-std::pow((x - middle) / width, 2));
}

}  // namespace

const std::vector<TruthEffect>& unlisted_effects() {
  static const std::vector<TruthEffect> all{
      {"slip_resonance",
       "dip",
       "invented: pull and torque fall in a narrow band of slip",
       .04,
       .15,
       false,
       {},
       nullptr,
       [](C c, const P& p, double a, double u) {
         const double dip = a * p.at.load_n * bump(p.at.slip_ratio, 0.12 + 0.25 * u, 0.07);
         c.fx_n -= dip;
         c.torque_nm -= 0.3 * dip * p.wheel.radius_m;
         return c;
       }},
      {"cross_axis",
       "sine",
       "invented: Fy + a W sin(2 pi s), whatever the slip angle",
       .03,
       .12,
       true,
       {.side = true},
       nullptr,
       [](C c, const P& p, double a, double) {
         c.fy_n += a * p.at.load_n * std::sin(kTurn * p.at.slip_ratio);
         return c;
       }},
      {"time_wobble",
       "sine",
       "invented: all forces swing with time",
       .03,
       .12,
       false,
       {.times = true},
       nullptr,
       [](C c, const P& p, double a, double u) {
         const double swing = 1 + a * std::sin(kTurn * p.at.time_s / (5e3 + 5e3 * u));
         c.fx_n += (swing - 1) * p.at.load_n;
         c.torque_nm *= swing;
         c.fy_n *= swing;
         return c;
       }},
      {"load_threshold",
       "step",
       "invented: beyond a load the soil yields at once",
       .05,
       .2,
       false,
       {.loads = true},
       nullptr,
       [](C c, const P& p, double a, double) {
         // the middle of the rig's loads is what a mean pressure of some kPa carries
         const double x = std::pow(c.sinkage_m / (0.11 * p.wheel.radius_m), 8);
         const double yielded = x / (1 + x);
         c.fx_n -= a * p.at.load_n * yielded;
         c.torque_nm -= 0.5 * a * p.at.load_n * p.wheel.radius_m * yielded;
         return c;
       }},
      {"vibration",
       "resonance",
       "invented: the bed loosens at one speed between the others",
       .1,
       .3,
       false,
       {.speeds = true},
       [](P p, double a, double u) {
         p.limit *= 1 - a * bump(std::log(p.at.speed_mps), std::log(0.08 + 0.06 * u), 0.5);
         return p;
       }},
      {"anisotropic_bed",
       "furrows",
       "invented: a raked bed guides the wheel",
       .03,
       .12,
       true,
       {.side = true, .both_sides = true},
       nullptr,
       [](C c, const P& p, double a, double u) {
         const double furrow = (0.3 + 0.4 * u);
         c.fx_n += a * p.at.load_n * std::sin(4 * p.at.slip_angle_rad);
         c.fy_n += a * p.at.load_n * std::cos(2 * (p.at.slip_angle_rad - furrow));
         return c;
       }},
      {"history",
       "memory",
       "invented: each run feels the slip of the run before",
       .05,
       .2,
       false,
       {.sweep = true},
       nullptr,
       [](C c, const P& p, double a, double) {
         c.fx_n -= a * p.at.load_n * p.at.previous_slip_ratio;
         c.sinkage_m *= 1 + a * p.at.previous_slip_ratio;
         return c;
       }},
      {"torque_ripple",
       "sine",
       "invented: torque and sinkage ripple against each other in slip",
       .03,
       .12,
       true,
       {.torque = true},
       nullptr,
       [](C c, const P& p, double a, double u) {
         const double ripple = std::sin((2.2 + u) * kTurn * p.at.slip_ratio);
         c.torque_nm += a * p.at.load_n * p.wheel.radius_m * ripple;
         c.sinkage_m *= 1 - a * ripple;
         return c;
       }},
      {"angle_ripple",
       "cosine",
       "invented: sinkage and pull ripple in the slip angle",
       .05,
       .2,
       false,
       {.side = true, .sinkage = true},
       nullptr,
       [](C c, const P& p, double a, double u) {
         const double ripple = 1 - std::cos((14 + 8 * u) * p.at.slip_angle_rad);
         c.sinkage_m *= 1 - 0.5 * a * ripple;
         c.fx_n -= 0.5 * a * p.at.load_n * ripple;
         return c;
       }},
  };
  return all;
}

}  // namespace regoplan::challenge
