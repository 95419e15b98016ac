#include "terramech/wheel/mechanism_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "terramech/wheel/forward_motion.h"
#include "terramech/wheel/mechanism_contact.h"
#include "terramech/wheel/rut_strips.h"

namespace regoplan {
namespace {

using wheel_contact::Contact;
using wheel_contact::Ground;
using wheel_contact::Integrals;
using wheel_contact::Ratios;
using wheel_contact::Resultant;

/// \param block share of what blocks between lugs have more than the soil's own
Ground ground_of(const Effects& effects, double gravity_mps2, double block = 1) {
  Soil soil = effects.soil;
  soil.cohesion_pa *= effects.limit;
  soil.friction_angle_rad = std::atan(effects.limit * std::tan(soil.friction_angle_rad));
  Ground ground(effects.wheel, soil, gravity_mps2);
  ground.stress_scale_pa *= effects.stiffness;
  const double xc = std::numbers::pi / 4 - soil.friction_angle_rad / 2;
  const double d1 = 1 / std::tan(xc) + std::tan(xc + soil.friction_angle_rad);
  const double height = effects.bulldoze_height;
  ground.bulldoze_cohesion_pa = height * (ground.bulldoze_cohesion_pa + d1 * effects.surcharge_pa);
  ground.bulldoze_weight *= height * height;
  // The rim bears no more shear than the soil (both at most 1); the soil beside keeps its own.
  ground.tan_phi = std::tan(effects.rim_friction_ratio * soil.friction_angle_rad);
  ground.soil.cohesion_pa *= effects.rim_adhesion_share;
  // Likewise lugs: stress on the larger surface is referred to the rim's.
  const auto share = [block](double factor) { return 1 + block * (factor - 1); };
  ground.tan_phi *= share(effects.shear_radius * effects.block_friction);
  ground.soil.cohesion_pa *= share(effects.shear_radius * effects.block_cohesion);
  return ground;
}

/// The law of the stress, and whether it is another than the base model's.
struct Law {
  wheel_contact::StressLaw stress;
  bool own = false;
};

Law law_of(const Effects& effects) {
  return {.stress = {.shear = effects.shear,
                     .residual = effects.residual,
                     .softening = effects.softening,
                     .coupling = effects.coupling,
                     .layering = effects.layering},
          .own = effects.shear != ShearLaw::kSeparate ||
                 effects.layering.kind != Layering::Kind::kNone};
}

/// Work of compacting a rut from one depth to another per metre, Bekker's resistance.
double compaction_n(const Ground& ground, double from_m, double to_m) {
  const double n = ground.soil.n, r = ground.wheel.radius_m;
  return ground.wheel.width_m * ground.stress_scale_pa * r / (n + 1) *
         (std::pow(to_m / r, n + 1) - std::pow(from_m / r, n + 1));
}

/// Area of a flank below the ground.
double segment_m2(double sinkage_m, double radius_m) {
  const double theta = wheel_contact::entry_angle_rad(sinkage_m, radius_m);
  return radius_m * radius_m * (theta - std::sin(theta) * std::cos(theta));
}

/// What acts on the wheel beside the stress under it.
struct Additions {
  double fx_n = 0, torque_nm = 0;
};

Additions additions(const Effects& effects, const Ground& ground, const WheelState& state,
                    const Contact& contact, double sinkage_m, double gravity_mps2) {
  Soil soil = effects.soil;  // not the rim's: these forces arise within the soil
  soil.cohesion_pa *= effects.limit;
  soil.friction_angle_rad = ground.soil.friction_angle_rad;
  const double r = ground.wheel.radius_m, b = ground.wheel.width_m, h = sinkage_m;
  const double gamma = soil.density_kgpm3 * gravity_mps2;
  const double root_kp = std::tan(std::numbers::pi / 4 + soil.friction_angle_rad / 2);  // sqrt(Kp)
  const auto passive_n = [&](double depth) {
    return b *
           (gamma * depth * depth * root_kp * root_kp / 2 + 2 * soil.cohesion_pa * depth * root_kp);
  };
  Additions sum;
  sum.fx_n -= effects.front_bulldozing * passive_n(h);
  sum.fx_n -= effects.inertia * soil.density_kgpm3 * state.speed_mps * state.speed_mps * b * h;
  const double lugs_in_soil = std::max(
      1.0, effects.lugs * (contact.theta_f_rad - contact.theta_r_rad) / (2 * std::numbers::pi));
  const double arc_m = r * (contact.theta_f_rad - contact.theta_r_rad);
  const double pressed_n = effects.lug_pressed * effects.lug_height_m * root_kp * root_kp *
                           effects.load_n / std::max(arc_m, effects.lug_height_m);
  const double lugs_n = lugs_in_soil * effects.lug_share *
                        (passive_n(effects.lug_height_m) + pressed_n) *
                        (1 + effects.lug_ripple * std::cos(effects.lug_phase_rad));
  sum.fx_n += lugs_n;
  sum.torque_nm += lugs_n * r;
  if (effects.flank_shear > 0) {
    const double limit_pa = soil.cohesion_pa + gamma * h / 2 * std::tan(soil.friction_angle_rad);
    const double turning = state.slip > -1 ? 1 : 0;
    sum.torque_nm += turning * effects.flank_shear * 2 * segment_m2(h, r) * limit_pa * r;
  }
  sum.torque_nm += effects.drag_torque_nm;
  return sum;
}

/// What bulldozing at the inner edge's depth adds to that at the wheel's middle.
double wall_n(const Effects& effects, const Ground& ground, const Ratios& ratios,
              const Contact& contact, double sinkage_m) {
  const double r = ground.wheel.radius_m;
  const double inner_m = std::min(sinkage_m * (1 + effects.wall_share), r);
  const Contact inner =
      wheel_contact::contact_at(ground, wheel_contact::entry_angle_rad(inner_m, r), ratios.slip);
  return wheel_contact::bulldozing_force_n(ground, inner, ratios) -
         wheel_contact::bulldozing_force_n(ground, contact, ratios);
}

}  // namespace

WheelChannels mechanism_channels(const WheelModel& model, double load_n, const WheelMotion& motion,
                                 const WheelConditions& conditions) {
  const ForwardMotion told = forward_motion(motion);
  const WheelState state{.load_n = load_n,
                         .slip = told.ratios.slip,
                         .beta_abs_rad = told.ratios.beta_abs_rad,
                         .beta_sign = told.y_sign,
                         .rim_speed_mps = motion.rim_speed_mps,
                         .speed_mps = conditions.speed_mps > 0
                                          ? conditions.speed_mps
                                          : std::hypot(motion.vx_mps, motion.vy_mps),
                         .conditions = conditions};
  Effects effects;
  effects.wheel = model.spec_.wheel;
  effects.soil = model.spec_.soil;
  effects.load_n = load_n;
  effects = apply(model.mechanisms_, effects, state);
  const double without_pull_n = effects.load_n;
  WheelChannels channels = channels_under(model, effects, state, motion);
  if (effects.load_per_drawbar == 0) return channels;
  // Drawbar pull changes by less than half of what the load does: a step leaves a sixth at most.
  constexpr int kSteps = 8;
  for (int step = 0; step < kSteps && has_forces(channels.forces.status); ++step) {
    effects.load_n = without_pull_n + effects.load_per_drawbar * channels.forces.fx_n;
    channels = channels_under(model, effects, state, motion);
  }
  return channels;
}

WheelChannels channels_under(const WheelModel& model, const Effects& effects,
                             const WheelState& state, const WheelMotion& motion) {
  if (!(effects.load_n > 0)) return {.forces = {.status = WheelStatus::kLifted}};
  const WheelModelSpec& spec = model.spec_;
  const WheelConditions& conditions = state.conditions;
  const ForwardMotion told = forward_motion(motion);
  WheelMotion moved = motion;
  moved.rim_speed_mps *= effects.rim_factor;
  const ForwardMotion forward = forward_motion(moved);
  const Ratios& ratios = forward.ratios;
  const Ground ground = ground_of(effects, spec.gravity_mps2);
  const Law law = law_of(effects);
  const double r = ground.wheel.radius_m;
  const WheelStatus sunk = WheelStatus::kSinksToAxle;

  // the sinkage that carries the load with Q = 1; yoshida2004: at rest
  const bool at_rest = spec.variant == WheelVariant::kYoshida2004;
  const Ratios reference = at_rest ? Ratios{} : ratios;
  const auto plain = model.solver_.solve(ground, effects.load_n, reference, model.accuracy_);
  const RutStrips strips(ground, ratios, law.stress, effects.rut_tilt_rad, model.accuracy_);
  const bool strips_in_balance = effects.rut_in_balance && effects.rut_tilt_rad != 0;
  constexpr double kSomewhere_rad = 0.5;
  std::optional<double> theta_f;
  if (plain) theta_f = plain->contact.theta_f_rad;
  if (strips_in_balance && !at_rest) {
    theta_f = strips.entry_angle(effects.load_n, theta_f.value_or(kSomewhere_rad));
  } else if (law.own) {
    theta_f =
        wheel_contact::entry_angle_with_law(ground, effects.load_n, reference, law.stress,
                                            model.accuracy_, theta_f.value_or(kSomewhere_rad));
  }
  if (!theta_f) return {.forces = {.status = sunk}};
  const double carried = wheel_contact::sinkage_at_m(*theta_f, r) + conditions.sinkage_offset_m;
  const double undug = carried + (at_rest ? spec.soil.c0_m * std::max(ratios.slip, 0.0) : 0.0);
  const double h = undug * effects.sinkage_factor + effects.sinkage_added_m;
  if (!(h < r && h > 0)) return {.forces = {.status = sunk}};
  const bool imposed = at_rest || h != undug || conditions.sinkage_offset_m != 0;
  if (imposed) theta_f = wheel_contact::entry_angle_rad(h, r);

  const Contact contact = wheel_contact::contact_at(ground, *theta_f, ratios.slip);
  const Integrals plane =
      strips_in_balance ? strips.together(h).plane
      : law.own
          ? wheel_contact::integrate_with_law(ground, contact, ratios, law.stress, model.accuracy_)
                .plane
          : wheel_contact::integrate(ground, contact, ratios, model.accuracy_);
  const double q = imposed ? plane.stress_scale(effects.load_n) : 1.0;
  if (!(q >= 0 && std::isfinite(q)))
    return {.forces = {.status = WheelStatus::kCohesionCarriesLoad}};
  Resultant resultant = plane.at(q);
  resultant.torque_nm *= effects.shear_radius;
  std::optional<Ground> less_held;  // sideways, where blocks hold less so than along
  if (effects.block_held != 1)
    less_held = ground_of(effects, spec.gravity_mps2, effects.block_held);
  const Ground& aside = less_held ? *less_held : ground;
  double side_n = 0, roll_nm = 0;
  if (effects.side_undisturbed) {
    const Ratios& as_told = told.ratios;
    const Contact before =
        wheel_contact::contact_at(ground, wheel_contact::entry_angle_rad(undug, r), as_told.slip);
    const Integrals under = wheel_contact::integrate(ground, before, as_told, model.accuracy_);
    const double carrying = (effects.load_n - under.cohesion.fz_n) / under.stress.fz_n;
    if (!(carrying >= 0)) return {.forces = {.status = WheelStatus::kCohesionCarriesLoad}};
    side_n = wheel_contact::side_force_n(aside, before, as_told, carrying, model.accuracy_);
  } else if (!law.own && effects.rut_tilt_rad == 0) {
    side_n = wheel_contact::side_force_n(aside, contact, ratios, q, model.accuracy_);
  } else {
    const RutStrips::Sideways sideways = strips.sideways(h, q, effects.load_n);
    side_n = sideways.force_n;
    if (less_held) {
      const RutStrips less(aside, ratios, law.stress, effects.rut_tilt_rad, model.accuracy_);
      side_n = less.sideways(h, q, effects.load_n).force_n;
    }
    // inner is right (-y) for a motion to the left: the moment about x is negative
    roll_nm = -forward.y_sign * sideways.roll_nm;
  }

  const double bulldozed_n = wheel_contact::bulldozing_force_n(ground, contact, ratios);
  side_n += effects.flank_pressure_pa * segment_m2(h, r);
  if (effects.wall_share != 0) side_n += wall_n(effects, ground, ratios, contact, h);

  Additions added = additions(effects, ground, state, contact, h, spec.gravity_mps2);
  added.fx_n -= effects.flank_friction * side_n + effects.flank_bulldozing * bulldozed_n;
  added.fx_n -= effects.dug_resistance * compaction_n(ground, undug, h);
  const double rut_m =
      ground.wheel.width_m / 2 * std::tan(effects.rut_tilt_rad) + h * effects.wall_share;
  return {.forces = {.fx_n = forward.x_sign * (resultant.fx_n + added.fx_n) +
                             effects.tilt_x * effects.load_n,
                     .fy_n = forward.y_sign * side_n - effects.tilt_y * effects.load_n,
                     .torque_nm = forward.x_sign * (resultant.torque_nm + added.torque_nm),
                     .sinkage_m = h,
                     .theta_f_rad = contact.theta_f_rad,
                     .theta_r_rad = contact.theta_r_rad,
                     .status = told.status},
          .rut_left_m = std::max(h - forward.y_sign * rut_m, 0.0),
          .rut_right_m = std::max(h + forward.y_sign * rut_m, 0.0),
          .roll_moment_nm = roll_nm};
}

}  // namespace regoplan
