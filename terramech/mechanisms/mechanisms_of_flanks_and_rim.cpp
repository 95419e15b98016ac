// Mechanisms of the wheel's faces: the flank that pushes soil aside, and the rim's own friction.
#include <algorithm>
#include <cmath>

#include "terramech/mechanisms/mechanism_catalogue.h"

namespace regoplan::mechanism_catalogue {

// NOLINTBEGIN(bugprone-easily-swappable-parameters, readability-function-size)
std::vector<Definition> of_flanks_and_rim() {
  using E = Effects;
  using P = const Parameters&;
  using S = const WheelState&;
  return {
      {{"flank_friction",
        "side_force",
        "Fx -= mu |Fy|",
        "proxy; Coulomb friction on the flank that bears the side force",
        {{"mu", .1, .5, .3, 0, 10}}},
       [](E e, P p, S) {
         e.flank_friction += p[0];
         return e;
       }},
      {{"flank_friction",
        "bulldozing",
        "Fx -= mu Fs, Fs the bulldozing part of |Fy| (eq. (15))",
        "proxy; Coulomb friction on the flank that pushes the soil aside",
        {{"mu", .1, .6, .35, 0, 10}}},
       [](E e, P p, S) {
         e.flank_bulldozing += p[0];
         return e;
       }},
      {{"side_surcharge",
        "heap",
        "Rb += D1 q sin|beta| h, q the pressure of the heap beside the wheel",
        "Terzaghi 1943, surcharge term of passive earth pressure; heap as in Pavlov & Johnson 2019",
        {{"surcharge_pa", 800, 6000, 2500, 0, 1e7}}},
       [](E e, P p, S at) {
         e.surcharge_pa += p[0] * std::sin(at.beta_abs_rad);
         return e;
       }},
      {{"side_surcharge",
        "flank",
        "|Fy| += q sin|beta| A, A the buried segment of the flank",
        "proxy; the heap leans on the flank instead of loading the soil below it",
        {{"pressure_pa", 800, 8000, 2700, 0, 1e7}}},
       [](E e, P p, S at) {
         e.flank_pressure_pa += p[0] * std::sin(at.beta_abs_rad);
         return e;
       }},
      {{"rim_friction",
        "ratio",
        "rim: tan(phi) of delta = ratio phi, cohesion c; bulldozing keeps the soil's",
        "Potyondy 1961, Geotechnique 11, 339-353: friction of soils on steel, delta/phi .54-.9",
        {{"ratio", .5, .95, .75, 0, 1, true}}},
       [](E e, P p, S) {
         e.rim_friction_ratio = std::clamp(e.rim_friction_ratio * p[0], 0.0, 1.0);
         return e;
       }},
      {{"rim_friction",
        "no_adhesion",
        "as ratio, and the rim has a share of the soil's cohesion as adhesion",
        "Potyondy 1961, Geotechnique 11, 339-353",
        {{"ratio", .5, .95, .75, 0, 1, true}, {"adhesion", 0, .6, .2, 0, 1, true}}},
       [](E e, P p, S) {
         e.rim_friction_ratio = std::clamp(e.rim_friction_ratio * p[0], 0.0, 1.0);
         e.rim_adhesion_share = std::clamp(e.rim_adhesion_share * p[1], 0.0, 1.0);
         return e;
       }},
      {{"soil_change",
        "strength",
        "k times a, c and tan(phi) times b",
        "another density or moisture of the same soil; told by a reference recording only",
        {{"stiffness", .3, 3, 1, .001, 1000}, {"limit", .7, 1.4, 1, .001, 100}}},
       [](E e, P p, S) {
         e.stiffness *= p[0];
         e.limit *= p[1];
         return e;
       }},
      {{"soil_change",
        "state",
        "k times a, c and tan(phi) times b, kx and ky times d",
        "another density or moisture of the same soil; told by a reference recording only",
        {{"stiffness", .3, 3, 1, .001, 1000},
         {"limit", .7, 1.4, 1, .001, 100},
         {"modulus", .4, 2.5, 1, .001, 1000}}},
       [](E e, P p, S) {
         e.stiffness *= p[0];
         e.limit *= p[1];
         e.soil.kx0_m *= p[2];
         e.soil.ky0_m *= p[2];
         return e;
       }},
      {{"soil_change",
        "for_a_time",
        "from <= time <= to: k times a, c and tan(phi) times b",
        "another preparation of the bed; told by the replicates of other days",
        {{"from_s", 0, 1e6, 0, -1e12, 1e12},
         {"to_s", 0, 1e6, 8.64e4, -1e12, 1e12},
         {"stiffness", .3, 3, .5, .001, 1000},
         {"limit", .7, 1.4, .8, .001, 100}}},
       [](E e, P p, S at) {
         if (at.conditions.time_s < p[0] || at.conditions.time_s > p[1]) return e;
         e.stiffness *= p[2];
         e.limit *= p[3];
         return e;
       }},
  };
}
// NOLINTEND(bugprone-easily-swappable-parameters, readability-function-size)

}  // namespace regoplan::mechanism_catalogue
