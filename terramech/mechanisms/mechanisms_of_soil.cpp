// Mechanisms of the soil: pushed aside, in layers and zones, changed by passes, speed and time.
#include <algorithm>
#include <cmath>

#include "terramech/mechanisms/mechanism_catalogue.h"

namespace regoplan::mechanism_catalogue {
namespace {

/// Before a course of time begins, the soil is as its numbers say.
double time_since(double first_time_s, const WheelState& at) {
  return std::max(0.0, at.conditions.time_s - first_time_s);
}

}  // namespace

// NOLINTBEGIN(bugprone-easily-swappable-parameters, readability-function-size)
std::vector<Definition> of_soil() {
  using E = Effects;
  using P = const Parameters&;
  using S = const WheelState&;
  return {
      {{"side_pileup",
        "raised",
        "Rb at h_b = h (1 + q sin|beta|)",
        "proxy; Hegedus 1960 with ground swell",
        {{"q", .3, 2, 1, 0, 100}}},
       [](E e, P p, S at) {
         e.bulldoze_height *= 1 + p[0] * std::sin(at.beta_abs_rad);
         return e;
       }},
      {{"side_pileup",
        "surcharge",
        "Rb += D1 q sin|beta| h",
        "proxy; Terzaghi's surcharge term",
        {{"surcharge_pa", 100, 2000, 600, 0, 1e6}}},
       [](E e, P p, S at) {
         e.surcharge_pa += p[0] * std::sin(at.beta_abs_rad);
         return e;
       }},
      {{"front_bulldozing",
        "passive",
        "Fx -= eta b (gamma h^2 Kp/2 + 2 c h sqrt(Kp))",
        "Bekker 1960; Wong 2008",
        {{"eta", .1, 1, .4, 0, 100}}},
       [](E e, P p, S) {
         e.front_bulldozing += p[0];
         return e;
       }},
      {{"multi_pass",
        "stiffening",
        "k = k0 (1 + a (1 - 1/pass))",
        "Wong 2008: unload-reload stiffness (proxy)",
        {{"a", .3, 3, 1, 0, 1000}}},
       [](E e, P p, S at) {
         e.stiffness *= 1 + p[0] * (1 - 1.0 / at.conditions.pass);
         return e;
       }},
      {{"multi_pass",
        "compaction",
        "with u = 1 - 1/pass: c (1 + a u), k (1 + b u), kx (1 - d u), rho (1 + e u)",
        "Holm 1969; Senatore & Sandu 2011",
        {{"cohesion", .1, 1, .4, 0, 100},
         {"stiffness", .1, 2, .6, 0, 1000},
         {"modulus", 0, .5, .2, 0, 1},
         {"density", 0, .2, .1, 0, 10}}},
       [](E e, P p, S at) {
         const double u = 1 - 1.0 / at.conditions.pass;
         e.soil.cohesion_pa *= 1 + p[0] * u;
         e.stiffness *= 1 + p[1] * u;
         e.soil.kx0_m *= 1 - p[2] * u;
         e.soil.density_kgpm3 *= 1 + p[3] * u;
         return e;
       }},
      {{"rate_dependence",
        "stiffness",
        "k = k0 (v/v0)^m",
        "Grahn 1991; Pope 1969",
        {{"m", .02, .2, .1, -1, 1}, {"v0_mps", .01, .1, .05, 1e-4, 100}}},
       [](E e, P p, S at) {
         if (at.speed_mps > 0) e.stiffness *= std::pow(at.speed_mps / p[1], p[0]);
         return e;
       }},
      {{"rate_dependence",
        "shear_limit",
        "c, tan(phi) times (v/v0)^m",
        "Grahn 1991",
        {{"m", .02, .2, .08, -1, 1}, {"v0_mps", .01, .1, .05, 1e-4, 100}}},
       [](E e, P p, S at) {
         if (at.speed_mps > 0) e.limit *= std::pow(at.speed_mps / p[1], p[0]);
         return e;
       }},
      {{"rate_dependence",
        "inertia",
        "Fx -= k rho v^2 b h",
        "Shmulevich & Osetinsky 2003 (proxy)",
        {{"k", .2, 2, 1, 0, 100}}},
       [](E e, P p, S) {
         e.inertia += p[0];
         return e;
       }},
      {{"layered_soil",
        "hard_below",
        "sigma times 1 + (R - 1)(1 - exp(-(z/d)^2)), z the depth of each point of the contact",
        "proxy; Bekker 1969 on soft ground over a hard base",
        {{"ratio", 2, 20, 6, .01, 1000}, {"depth_m", .005, .05, .02, 1e-4, 10}}},
       [](E e, P p, S) {
         e.layering = {.kind = Layering::Kind::kHardBelow, .depth_m = p[1], .ratio = p[0]};
         return e;
       }},
      {{"layered_soil",
        "crust",
        "sigma + p_c (z/d) exp(1 - z/d): a crust that bears p_c at the depth d, then breaks",
        "proxy; Wong 2008, section 2.4, on ground under a mat or crust",
        {{"crust_pa", 1e3, 2e4, 4e3, 0, 1e7}, {"depth_m", .002, .02, .005, 1e-4, 10}}},
       [](E e, P p, S) {
         e.layering = {.kind = Layering::Kind::kCrust, .depth_m = p[1], .crust_pa = p[0]};
         return e;
       }},
      {{"soil_zone",
        "factors",
        "from < position < to: k times a, c and tan(phi) times b",
        "another soil",
        {{"from_m", 0, 10, 0, -1e9, 1e9},
         {"to_m", 0, 10, 1, -1e9, 1e9},
         {"stiffness", .3, 3, .5, .001, 1000},
         {"limit", .5, 1.5, .8, .001, 100}}},
       [](E e, P p, S at) {
         if (at.conditions.position_m < p[0] || at.conditions.position_m > p[1]) return e;
         e.stiffness *= p[2];
         e.limit *= p[3];
         return e;
       }},
      {{"cohesion_drift",
        "linear",
        "c = c0 max(0, 1 + a (t - t0)+)",
        "moisture over time (proxy)",
        {{"per_s", -1e-4, 1e-4, -2e-5, -10, 10}, {"first_time_s", 0, 1e6, 0, -1e12, 1e12}}},
       [](E e, P p, S at) {
         e.soil.cohesion_pa *= std::max(0.0, 1 + p[0] * time_since(p[1], at));
         return e;
       }},
      {{"cohesion_drift",
        "drying",
        "c = c0 (f + (1 - f) exp(-(t - t0)+/tau))",
        "moisture over time (proxy)",
        {{"dry_share", 0, .8, .4, 0, 100},
         {"tau_s", 1e3, 1e6, 3e4, 1e-3, 1e12},
         {"first_time_s", 0, 1e6, 0, -1e12, 1e12}}},
       [](E e, P p, S at) {
         e.soil.cohesion_pa *= p[0] + (1 - p[0]) * std::exp(-time_since(p[2], at) / p[1]);
         return e;
       }},
      {{"cohesion_drift",
        "for_a_time",
        "from <= time <= to: c = a c0",
        "soil that was wetted or sieved anew (proxy)",
        {{"from_s", 0, 1e6, 0, -1e12, 1e12},
         {"to_s", 0, 1e6, 8.64e4, -1e12, 1e12},
         {"factor", .2, 3, .5, 0, 1000}}},
       [](E e, P p, S at) {
         const double time_s = at.conditions.time_s;
         if (time_s >= p[0] && time_s <= p[1]) e.soil.cohesion_pa *= p[2];
         return e;
       }},
  };
}
// NOLINTEND(bugprone-easily-swappable-parameters, readability-function-size)

}  // namespace regoplan::mechanism_catalogue
