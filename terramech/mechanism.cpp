// The forms of all mechanisms. Each states its formula, its source and the usual range of its
// parameters; `proxy` marks a simple stand-in of our own for effects that the literature describes
// in words or by experiment.
#include "terramech/mechanism.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "terramech/input_error.h"
#include "terramech/mechanism_effects.h"

namespace regoplan {
namespace {

using Parameters = std::array<double, 4>;

struct Definition {
  MechanismForm form;
  Effects (*act)(Effects, const Parameters&, const WheelState&);
};

double driving(const WheelState& at) {
  return std::max(at.slip, 0.0);
}
double braking(const WheelState& at) {
  return std::max(-at.slip, 0.0);
}

// NOLINTBEGIN(bugprone-easily-swappable-parameters, readability-function-size)
std::vector<Definition> definitions() {
  using E = Effects;
  using P = const Parameters&;
  using S = const WheelState&;
  return {
      {{"slip_sinkage",
        "exponent",
        "n = n0 + n1 s + n2 s^2 (s > 0)",
        "Ding et al. 2010, J. Terramechanics 47",
        {{"n1", .1, .6, .3}, {"n2", 0, .3, 0}}},
       [](E e, P p, S at) {
         e.soil.n += p[0] * driving(at) + p[1] * driving(at) * driving(at);
         return e;
       }},
      {{"slip_sinkage",
        "lyasko",
        "h = h0 (1 + k (K(s) - 1)), K = (1 + s)/(1 - 0.5 s)",
        "Lyasko 2010, J. Terramechanics 47",
        {{"strength", .5, 1.5, 1}}},
       [](E e, P p, S at) {
         const double s = driving(at);
         e.sinkage_factor *= 1 + p[0] * ((1 + s) / (1 - s / 2) - 1);
         return e;
       }},
      {{"slip_sinkage",
        "linear",
        "h = h0 + c0 s (s > 0)",
        "Yoshida & Ishigami 2004, eq. (14)",
        {{"c0_m", .005, .04, .015}}},
       [](E e, P p, S at) {
         e.sinkage_added_m += p[0] * driving(at);
         return e;
       }},
      {{"slip_sinkage",
        "hyperbolic",
        "h = h0 + h_j s/(1 - s) (s > 0)",
        "Vasilev et al.: jet sinkage, after Lyasko 2010",
        {{"hj_m", .001, .01, .004}}},
       [](E e, P p, S at) {
         const double s = std::min(driving(at), 1 - 1e-9);
         e.sinkage_added_m += p[0] * s / (1 - s);
         return e;
       }},
      {{"lateral_digging",
        "sine",
        "h = h0 (1 + kappa sin|beta|)",
        "proxy; sinkage over slip angle as in Pavlov & Johnson 2019",
        {{"kappa", .2, 2, .8}}},
       [](E e, P p, S at) {
         e.sinkage_factor *= 1 + p[0] * std::sin(at.beta_abs_rad);
         return e;
       }},
      {{"rut_asymmetry",
        "tilt",
        "h(y) = h + y tan(psi), psi = kappa (|beta| - beta0)+",
        "proxy; Yoshida & Ishigami 2004, section V.B",
        {{"kappa", .2, 1, .5}, {"beta0_rad", .05, .2, .1}}},
       [](E e, P p, S at) {
         e.rut_tilt_rad += p[0] * std::max(at.beta_abs_rad - p[1], 0.0);
         return e;
       }},
      {{"rut_asymmetry",
        "tilt_in_balance",
        "as tilt; the strips together carry the load, and all forces are theirs",
        "proxy; Yoshida & Ishigami 2004, section V.B",
        {{"kappa", .2, 1, .5}, {"beta0_rad", .05, .2, .1}}},
       [](E e, P p, S at) {
         e.rut_tilt_rad += p[0] * std::max(at.beta_abs_rad - p[1], 0.0);
         e.rut_in_balance = true;
         return e;
       }},
      {{"shear_modulus_slip_angle",
        "linear",
        "kx += kx1 |beta|, ky += ky1 |beta|",
        "Ishigami et al. 2007, J. Field Robotics 24",
        {{"kx1_m", .01, .1, .04}, {"ky1_m", .01, .1, .02}}},
       [](E e, P p, S) {
         e.soil.kx1_m += p[0];
         e.soil.ky1_m += p[1];
         return e;
       }},
      {{"coupled_shear",
        "displacement",
        "tau = tau_max (1 - exp(-|j|/K)) j/|j|",
        "Wong 2008, Theory of Ground Vehicles",
        {}},
       [](E e, P, S) {
         e.shear = ShearLaw::kAlongDisplacement;
         return e;
       }},
      {{"coupled_shear",
        "slip_velocity",
        "tau = tau_max (1 - exp(-|j|/K)) v/|v|",
        "Tran et al. 2002; Wong & Preston-Thomas 1988",
        {}},
       [](E e, P, S) {
         e.shear = ShearLaw::kAlongSlipVelocity;
         return e;
       }},
      {{"grousers",
        "passive_pressure",
        "thrust m b (gamma hg^2 Kp/2 + 2 c hg sqrt(Kp)) (1 - exp(-5 s)) a lug in the soil, digging "
        "hg s/2",
        "Bekker 1969; Iizuka & Kubota 2011",
        {{"lug_height_m", .004, .02, .01},
         {"mobilised", .3, 1, .8},
         {"ripple", 0, .5, 0},
         {"lugs", 12, 32, 24}}},
       [](E e, P p, S at) {
         e.lug_height_m = p[0];
         e.lug_share = p[1] * (1 - std::exp(-5 * driving(at)));
         e.lug_ripple = p[2];
         e.lugs = p[3];
         e.lug_phase_rad = p[3] * at.conditions.wheel_angle_rad;
         e.sinkage_added_m += p[0] * driving(at) / 2;
         return e;
       }},
      {{"grousers",
        "effective_radius",
        "c, tan(phi) times 1 + 4 x (hg/r) (1 - exp(-5 s)), digging hg s/2",
        "proxy; lugs as a larger shear radius",
        {{"lug_height_m", .004, .02, .01}, {"share", .3, 1, .7}}},
       [](E e, P p, S at) {
         e.limit *= 1 + p[1] * p[0] / e.wheel.radius_m * 4 * (1 - std::exp(-5 * driving(at)));
         e.sinkage_added_m += p[0] * driving(at) / 2;
         return e;
       }},
      {{"side_pileup",
        "raised",
        "Rb at h_b = h (1 + q sin|beta|)",
        "proxy; Hegedus 1960 with ground swell",
        {{"q", .3, 2, 1}}},
       [](E e, P p, S at) {
         e.bulldoze_height *= 1 + p[0] * std::sin(at.beta_abs_rad);
         return e;
       }},
      {{"side_pileup",
        "surcharge",
        "Rb += D1 q sin|beta| h",
        "proxy; Terzaghi's surcharge term",
        {{"surcharge_pa", 100, 2000, 600}}},
       [](E e, P p, S at) {
         e.surcharge_pa += p[0] * std::sin(at.beta_abs_rad);
         return e;
       }},
      {{"front_bulldozing",
        "passive",
        "Fx -= eta b (gamma h^2 Kp/2 + 2 c h sqrt(Kp))",
        "Bekker 1960; Wong 2008",
        {{"eta", .1, 1, .4}}},
       [](E e, P p, S) {
         e.front_bulldozing += p[0];
         return e;
       }},
      {{"rear_contact",
        "linear",
        "lambda = lambda0 + l1 s + l2 |beta|",
        "Ishigami et al. 2007; Ding et al. 2011",
        {{"l1", .1, .8, .4}, {"l2_per_rad", 0, .8, .3}}},
       [](E e, P p, S at) {
         e.soil.lambda =
             std::clamp(e.soil.lambda + p[0] * at.slip + p[1] * at.beta_abs_rad, 0.0, 1.5);
         return e;
       }},
      {{"max_stress_angle",
        "linear",
        "theta_m/theta_f = a0 + a1 s + a2 |beta|",
        "Wong & Reece 1967, extended in beta (proxy)",
        {{"a2_per_rad", -.3, .3, .15}}},
       [](E e, P p, S at) {
         const double edge = std::abs(e.soil.a1) + 1e-3;
         e.soil.a0 = std::clamp(e.soil.a0 + p[0] * at.beta_abs_rad, edge, 1 - edge);
         return e;
       }},
      {{"skid_branch",
        "reversal",
        "s < 0: h = h0 (1 + k |s|), kx = kx0 (1 + m |s|)",
        "Wong & Reece 1967, part II; Ding et al. 2014 (proxy)",
        {{"sinkage", .1, 1, .4}, {"modulus", 0, 2, .5}}},
       [](E e, P p, S at) {
         e.sinkage_factor *= 1 + p[0] * braking(at);
         e.soil.kx0_m *= 1 + p[1] * braking(at);
         return e;
       }},
      {{"multi_pass",
        "stiffening",
        "k = k0 (1 + a (1 - 1/pass))",
        "Wong 2008: unload-reload stiffness (proxy)",
        {{"a", .3, 3, 1}}},
       [](E e, P p, S at) {
         e.stiffness *= 1 + p[0] * (1 - 1.0 / at.conditions.pass);
         return e;
       }},
      {{"multi_pass",
        "compaction",
        "with u = 1 - 1/pass: c (1 + a u), k (1 + b u), kx (1 - d u), rho (1 + e u)",
        "Holm 1969; Senatore & Sandu 2011",
        {{"cohesion", .1, 1, .4},
         {"stiffness", .1, 2, .6},
         {"modulus", 0, .5, .2},
         {"density", 0, .2, .1}}},
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
        {{"m", .02, .2, .1}, {"v0_mps", .01, .1, .05}}},
       [](E e, P p, S at) {
         if (at.speed_mps > 0) e.stiffness *= std::pow(at.speed_mps / p[1], p[0]);
         return e;
       }},
      {{"rate_dependence",
        "shear_limit",
        "c, tan(phi) times (v/v0)^m",
        "Grahn 1991",
        {{"m", .02, .2, .08}, {"v0_mps", .01, .1, .05}}},
       [](E e, P p, S at) {
         if (at.speed_mps > 0) e.limit *= std::pow(at.speed_mps / p[1], p[0]);
         return e;
       }},
      {{"rate_dependence",
        "inertia",
        "Fx -= k rho v^2 b h",
        "Shmulevich & Osetinsky 2003 (proxy)",
        {{"k", .2, 2, 1}}},
       [](E e, P p, S) {
         e.inertia += p[0];
         return e;
       }},
      {{"layered_soil",
        "hard_below",
        "k = k0 (1 + (R - 1)(1 - exp(-(h/d)^2))), R > 1",
        "Wong 2008, section 2.4 (proxy)",
        {{"ratio", 2, 20, 6}, {"depth_m", .005, .05, .02}}},
       [](E e, P p, S) {
         e.layer_stiffness = p[0];
         e.layer_depth_m = p[1];
         return e;
       }},
      {{"layered_soil",
        "crust",
        "k = k0 (1 + (R - 1)(1 - exp(-(h/d)^2))), R < 1",
        "Wong 2008, section 2.4 (proxy)",
        {{"ratio", .1, .7, .4}, {"depth_m", .002, .02, .008}}},
       [](E e, P p, S) {
         e.layer_stiffness = p[0];
         e.layer_depth_m = p[1];
         return e;
       }},
      {{"soil_zone",
        "factors",
        "from < position < to: k times a, c and tan(phi) times b",
        "another soil",
        {{"from_m", 0, 10, 0},
         {"to_m", 0, 10, 1},
         {"stiffness", .3, 3, .5},
         {"limit", .5, 1.5, .8}}},
       [](E e, P p, S at) {
         if (at.conditions.position_m < p[0] || at.conditions.position_m > p[1]) return e;
         e.stiffness *= p[2];
         e.limit *= p[3];
         return e;
       }},
      {{"cohesion_drift",
        "linear",
        "c = c0 max(0, 1 + a t)",
        "moisture over time (proxy)",
        {{"per_s", -1e-4, 1e-4, -2e-5}}},
       [](E e, P p, S at) {
         e.soil.cohesion_pa *= std::max(0.0, 1 + p[0] * at.conditions.time_s);
         return e;
       }},
      {{"cohesion_drift",
        "drying",
        "c = c0 (f + (1 - f) exp(-t/tau))",
        "moisture over time (proxy)",
        {{"dry_share", 0, .8, .4}, {"tau_s", 1e3, 1e6, 3e4}}},
       [](E e, P p, S at) {
         e.soil.cohesion_pa *= p[0] + (1 - p[0]) * std::exp(-at.conditions.time_s / p[1]);
         return e;
       }},
      {{"shear_hump",
        "wong",
        "tau/tau_max = Kr {1 + [1/(Kr (1 - 1/e)) - 1] exp(1 - j/Kw)} (1 - exp(-j/Kw))",
        "Wong 2008, eq. (2.73)",
        {{"residual", .4, .95, .7}}},
       [](E e, P p, S) {
         e.shear = ShearLaw::kHump;
         e.residual = p[0];
         return e;
       }},
      {{"slope_tilt",
        "gravity",
        "Fx -= W sin(a) cos(heading - d), Fy likewise along y",
        "statics",
        {{"tilt_rad", .005, .05, .02}, {"direction_rad", -3.1, 3.1, 0}}},
       [](E e, P p, S at) {
         const double towards = at.conditions.heading_rad - p[1];
         e.tilt_x -= std::sin(p[0]) * std::cos(towards);
         e.tilt_y -= std::sin(p[0]) * std::sin(towards);
         return e;
       }},
      {{"flexible_wheel",
        "substitute_circle",
        "r = r0 (1 + k W)",
        "Bekker 1960; Schmid 1995",
        {{"per_n", 1e-4, 5e-3, 1e-3}}},
       [](E e, P p, S at) {
         e.wheel.radius_m *= 1 + p[0] * at.load_n;
         return e;
       }},
      {{"sidewall_shear",
        "segment",
        "T += eta 2 r A (c + gamma h tan(phi)/2), A the flank's segment",
        "proxy; Gee-Clough 1976",
        {{"eta", .2, 1, .5}}},
       [](E e, P p, S) {
         e.flank_shear += p[0];
         return e;
       }},
      {{"bearing_drag",
        "linear",
        "T += (T0 + T1 W + T2 |w|) sgn(w)",
        "friction of bearings and gears",
        {{"t0_nm", 0, .2, .05}, {"t1_m", 0, 2e-3, 5e-4}, {"t2_nms", 0, .05, 0}}},
       [](E e, P p, S at) {
         const double rate = std::abs(at.rim_speed_mps) / e.wheel.radius_m;
         e.drag_torque_nm += p[0] + p[1] * at.load_n + p[2] * rate;
         return e;
       }},
      {{"load_transfer", "proportional", "W = W0 (1 + k)", "statics", {{"share", -.2, .2, .08}}},
       [](E e, P p, S) {
         e.load_n *= 1 + p[0];
         return e;
       }},
      {{"load_transfer", "offset", "W = W0 + dW", "statics", {{"added_n", -10, 10, 4}}},
       [](E e, P p, S) {
         e.load_n += p[0];
         return e;
       }},
      {{"slip_scale",
        "rim_speed",
        "true rim speed = (1 + e) times the one told",
        "rolling radius or encoder",
        {{"error", -.05, .05, .03}}},
       [](E e, P p, S) {
         e.rim_factor *= 1 + p[0];
         return e;
       }},
  };
}
// NOLINTEND(bugprone-easily-swappable-parameters, readability-function-size)

const std::vector<Definition>& all_definitions() {
  static const std::vector<Definition> all = definitions();
  return all;
}

std::size_t index_of(const Mechanism& mechanism) {
  const std::vector<MechanismForm>& forms = mechanism_forms();
  std::vector<std::string_view> ids, of_id;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (ids.empty() || ids.back() != forms[i].id) ids.push_back(forms[i].id);
    if (forms[i].id != mechanism.id) continue;
    if (mechanism.form.empty() || mechanism.form == forms[i].form) return i;
    of_id.push_back(forms[i].form);
  }
  if (of_id.empty()) {
    throw InputError(
        fmt::format("mechanism id: {} is none of {}", mechanism.id, fmt::join(ids, ", ")));
  }
  throw InputError(fmt::format("mechanism {}: form {} is none of {}", mechanism.id, mechanism.form,
                               fmt::join(of_id, ", ")));
}

}  // namespace

const std::vector<MechanismForm>& mechanism_forms() {
  static const std::vector<MechanismForm> forms = [] {
    std::vector<MechanismForm> all;
    for (const Definition& definition : all_definitions()) all.push_back(definition.form);
    return all;
  }();
  return forms;
}

const MechanismForm& form_of(const Mechanism& mechanism) {
  const MechanismForm& form = mechanism_forms()[index_of(mechanism)];
  for (const auto& parameter : mechanism.parameters) {
    const std::string& name = parameter.first;
    const double value = parameter.second;
    const bool known = std::ranges::any_of(
        form.parameters, [&](const MechanismParameter& p) { return p.name == name; });
    if (!known) {
      std::vector<std::string_view> names;
      for (const MechanismParameter& p : form.parameters) names.push_back(p.name);
      throw InputError(
          fmt::format("mechanism {}: parameter {} is none of {}", mechanism.id, name,
                      names.empty() ? "(none)" : fmt::format("{}", fmt::join(names, ", "))));
    }
    if (!std::isfinite(value)) throw ValueError(name, value, "a finite number");
  }
  return form;
}

BoundMechanism bind(const Mechanism& mechanism) {
  const MechanismForm& form = form_of(mechanism);
  BoundMechanism bound{.form = index_of(mechanism)};
  for (std::size_t i = 0; i < form.parameters.size(); ++i) {
    const auto given = mechanism.parameters.find(std::string(form.parameters[i].name));
    bound.parameters[i] =
        given == mechanism.parameters.end() ? form.parameters[i].typical : given->second;
  }
  return bound;
}

Effects apply(const std::vector<BoundMechanism>& mechanisms, Effects effects,
              const WheelState& state) {
  for (const BoundMechanism& mechanism : mechanisms) {
    effects = all_definitions()[mechanism.form].act(effects, mechanism.parameters, state);
  }
  return effects;
}

}  // namespace regoplan
