// Mechanisms that change how deep the wheel stands and where the stress is.
//
// Slip sinkage: what the stress integrals make of Fx is open. The longer contact of a deeper wheel
// pulls more where the shear is not yet mobilised or cohesion counts, as on most soils that come
// with the program; it pulls less on dry sand. They also lose what a deeper rut costs, as they
// scale the stress down until it balances the load. That cost is Lyasko's point; `dug_rut` pays it,
// and Fx falls on every soil.
#include <algorithm>
#include <cmath>

#include "terramech/mechanisms/mechanism_catalogue.h"

namespace regoplan::mechanism_catalogue {
namespace {

constexpr double kSteepest_rad = 1;  // of a rut's wall, and the slip angle up to which it grows

}  // namespace

// NOLINTBEGIN(bugprone-easily-swappable-parameters, readability-function-size)
std::vector<Definition> of_sinkage() {
  using E = Effects;
  using P = const Parameters&;
  using S = const WheelState&;
  return {
      {{"slip_sinkage",
        "exponent",
        "n = n0 + n1 s + n2 s^2 (s > 0)",
        "Ding et al. 2010, J. Cent. South Univ. Technol. 17, 129-135",
        {{"n1", .1, .6, .3, 0, 4}, {"n2", 0, .3, 0, 0, 4}}},
       [](E e, P p, S at) {
         e.soil.n += p[0] * driving(at) + p[1] * driving(at) * driving(at);
         return e;
       }},
      {{"slip_sinkage",
        "lyasko",
        "h = h0 (1 + k (K(s) - 1)), K = (1 + s)/(1 - 0.5 s)",
        "Lyasko 2010, J. Terramechanics 47, 21-31",
        {{"strength", .5, 1.5, 1, 0, 20}}},
       [](E e, P p, S at) {
         const double s = driving(at);
         e.sinkage_factor *= 1 + p[0] * ((1 + s) / (1 - s / 2) - 1);
         return e;
       }},
      {{"slip_sinkage",
        "linear",
        "h = h0 + c0 s (s > 0)",
        "Yoshida & Ishigami 2004, eq. (14)",
        {{"c0_m", .005, .04, .015, 0, 1}}},
       [](E e, P p, S at) {
         e.sinkage_added_m += p[0] * driving(at);
         return e;
       }},
      {{"slip_sinkage",
        "hyperbolic",
        "h = h0 + h_j s/(1 - s) (s > 0)",
        "Vasil'ev et al. 1969: jet sinkage, after Lyasko 2010",
        {{"hj_m", .001, .01, .004, 0, 1}}},
       [](E e, P p, S at) {
         const double s = std::min(driving(at), 1 - 1e-9);
         e.sinkage_added_m += p[0] * s / (1 - s);
         return e;
       }},
      {{"slip_sinkage",
        "power",
        "h = h0 (1 + a s^p) (s > 0)",
        "proxy; as lyasko, where digging sets in late or tails off",
        {{"a", .3, 3, 1, 0, 100}, kExponent}},
       [](E e, P p, S at) {
         e.sinkage_factor *= 1 + p[0] * std::pow(driving(at), p[1]);
         return e;
       }},
      {{"slip_sinkage",
        "dug_rut",
        "as lyasko, and Fx less eta b k (h^(n+1) - h0^(n+1))/(n+1), the work of compacting the rut",
        "Lyasko 2010, J. Terramechanics 47, 21-31; resistance: Bekker 1969",
        {{"strength", .5, 1.5, 1, 0, 20}, {"eta", .3, 1, 1, 0, 20}}},
       [](E e, P p, S at) {
         const double s = driving(at);
         e.sinkage_factor *= 1 + p[0] * ((1 + s) / (1 - s / 2) - 1);
         e.dug_resistance += p[1];
         return e;
       }},
      {{"sliding_sinkage",
        "power",
        "h = h0 (1 + a v^p), v = |slip velocity|/max(r w, V)",
        "proxy; slip sinkage (Lyasko 2010; Ding et al. 2014) carried over to skid and lateral "
        "motion",
        {{"a", .5, 4, 1.8, 0, 100}, {"p", 1, 2.2, 1.7, .4, 10}}},
       [](E e, P p, S at) {
         e.sinkage_factor *= 1 + p[0] * std::pow(slip_velocity(at), p[1]);
         return e;
       }},
      {{"sliding_sinkage",
        "added",
        "h = h0 + d v^p, v = |slip velocity|/max(r w, V)",
        "proxy; as power, for digging that does not grow with the static sinkage",
        {{"d_m", .003, .04, .012, 0, 1}, {"p", 1, 2.2, 1.7, .4, 10}}},
       [](E e, P p, S at) {
         e.sinkage_added_m += p[0] * std::pow(slip_velocity(at), p[1]);
         return e;
       }},
      {{"lateral_digging",
        "sine",
        "h = h0 (1 + kappa sin|beta|)",
        "proxy; sinkage over slip angle as in Pavlov & Johnson 2019",
        {{"kappa", .2, 2, .8, 0, 100}}},
       [](E e, P p, S at) {
         e.sinkage_factor *= 1 + p[0] * std::sin(at.beta_abs_rad);
         return e;
       }},
      {{"lateral_digging",
        "power",
        "h = h0 (1 + kappa sin^p|beta|)",
        "proxy; as sine, where digging sets in late or tails off",
        {{"kappa", .2, 2, .8, 0, 100}, kExponent}},
       [](E e, P p, S at) {
         e.sinkage_factor *= 1 + p[0] * std::pow(std::sin(at.beta_abs_rad), p[1]);
         return e;
       }},
      {{"rut_asymmetry",
        "tilt",
        "h(y) = h + y tan(psi), psi = kappa (|beta| - beta0)+, at most 1 rad",
        "proxy; Yoshida & Ishigami 2004, section V.B",
        {{"kappa", .2, 1, .5, 0, 20}, {"beta0_rad", .05, .2, .1, 0, 1.6}}},
       [](E e, P p, S at) {
         e.rut_tilt_rad =
             std::min(e.rut_tilt_rad + p[0] * std::max(at.beta_abs_rad - p[1], 0.0), kSteepest_rad);
         return e;
       }},
      {{"rut_asymmetry",
        "tilt_in_balance",
        "as tilt; the strips together carry the load, and all forces are theirs",
        "proxy; Yoshida & Ishigami 2004, section V.B",
        {{"kappa", .2, 1, .5, 0, 20}, {"beta0_rad", .05, .2, .1, 0, 1.6}}},
       [](E e, P p, S at) {
         e.rut_tilt_rad =
             std::min(e.rut_tilt_rad + p[0] * std::max(at.beta_abs_rad - p[1], 0.0), kSteepest_rad);
         e.rut_in_balance = true;
         return e;
       }},
      {{"rut_asymmetry",
        "inner_wall",
        "edges at h (1 +- q tan|beta|), |beta| at most 1 rad there, Rb at the depth of the inner "
        "one, "
        "at most r",
        "proxy; Yoshida & Ishigami 2004, section V.B: soil reaction on the deeper side",
        {{"q", .5, 3, 1.5, 0, 100}}},
       [](E e, P p, S at) {
         e.wall_share += p[0] * std::tan(std::min(at.beta_abs_rad, kSteepest_rad));
         return e;
       }},
      {{"skid_branch",
        "reversal",
        "s < 0: h = h0 (1 + k |s|), kx = kx0 (1 + m |s|)",
        "Wong & Reece 1967, part II; Ding et al. 2014 (proxy)",
        {{"sinkage", .1, 1, .4, 0, 100}, {"modulus", 0, 2, .5, 0, 100}}},
       [](E e, P p, S at) {
         e.sinkage_factor *= 1 + p[0] * braking(at);
         e.soil.kx0_m *= 1 + p[1] * braking(at);
         return e;
       }},
      {{"skid_branch",
        "weakened",
        "s < 0: c, tan(phi) times exp(-w |s|), h = h0 (1 + k |s|)",
        "Wong & Reece 1967, part II (proxy): a braked wheel rolls on soil that it has sheared "
        "ahead",
        {{"weakening", .1, 1.5, .4, 0, 50}, {"sinkage", 0, 1, .4, 0, 100}}},
       [](E e, P p, S at) {
         e.limit *= std::exp(-p[0] * braking(at));
         e.sinkage_factor *= 1 + p[1] * braking(at);
         return e;
       }},
      {{"skid_branch",
        "heap_ahead",
        "s < 0: Fx -= eta |s| b (gamma h^2 Kp/2 + 2 c h sqrt(Kp)), h = h0 (1 + k |s|)",
        "Wong & Reece 1967, part II (proxy): a braked wheel heaps up soil ahead and pushes it",
        {{"eta", .3, 6, 1.5, 0, 100}, {"sinkage", 0, 1, .3, 0, 100}}},
       [](E e, P p, S at) {
         e.front_bulldozing += p[0] * braking(at);
         e.sinkage_factor *= 1 + p[1] * braking(at);
         return e;
       }},
      {{"rear_contact",
        "linear",
        "lambda = lambda0 + l1 s + l2 |beta|, from 0 to 1.5",
        "Ishigami et al. 2007; Ding et al. 2011",
        {{"l1", .1, .8, .4, -10, 10}, {"l2_per_rad", 0, .8, .3, -10, 10}}},
       [](E e, P p, S at) {
         e.soil.lambda =
             std::clamp(e.soil.lambda + p[0] * at.slip + p[1] * at.beta_abs_rad, 0.0, 1.5);
         return e;
       }},
      {{"rear_contact",
        "power",
        "lambda = lambda0 + l1 sgn(s) |s|^p + l2 sin^p|beta|, from 0 to 1.5",
        "proxy; as linear, where soil fills in behind late or early",
        {{"l1", .1, .8, .4, -10, 10}, {"l2", 0, .8, .3, -10, 10}, kExponent}},
       [](E e, P p, S at) {
         const double by_slip = std::copysign(std::pow(std::abs(at.slip), p[2]), at.slip);
         const double by_angle = std::pow(std::sin(at.beta_abs_rad), p[2]);
         e.soil.lambda = std::clamp(e.soil.lambda + p[0] * by_slip + p[1] * by_angle, 0.0, 1.5);
         return e;
       }},
      {{"max_stress_angle",
        "linear",
        "theta_m/theta_f = a0 + a1 s + a2 |beta|, a0 + a2 |beta| from |a1| to 1 - |a1|: theta_m "
        "stays "
        "in the contact",
        "Wong & Reece 1967, extended in beta (proxy)",
        {{"a2_per_rad", -.6, .6, .15, -10, 10}}},
       [](E e, P p, S at) {
         const double edge = std::abs(e.soil.a1) + 1e-3;
         e.soil.a0 = std::clamp(e.soil.a0 + p[0] * at.beta_abs_rad, edge, 1 - edge);
         return e;
       }},
      {{"max_stress_angle",
        "power",
        "theta_m/theta_f = a0 + a1 s + a2 sin^p|beta|, a0 + a2 sin^p|beta| from |a1| to 1 - |a1|: "
        "theta_m stays in the contact",
        "proxy; as linear, where the shift sets in late or tails off",
        {{"a2", -.6, .6, .15, -10, 10}, kExponent}},
       [](E e, P p, S at) {
         const double edge = std::abs(e.soil.a1) + 1e-3;
         const double by_angle = std::pow(std::sin(at.beta_abs_rad), p[1]);
         e.soil.a0 = std::clamp(e.soil.a0 + p[0] * by_angle, edge, 1 - edge);
         return e;
       }},
  };
}
// NOLINTEND(bugprone-easily-swappable-parameters, readability-function-size)

}  // namespace regoplan::mechanism_catalogue
