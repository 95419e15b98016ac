#include "terramech/mechanism_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "terramech/forward_motion.h"
#include "terramech/mechanism_contact.h"

namespace regoplan {
namespace {

using wheel_contact::Contact;
using wheel_contact::Ground;
using wheel_contact::Integrals;
using wheel_contact::Ratios;
using wheel_contact::Resultant;

Ground ground_of(const Effects& effects, double gravity_mps2) {
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
  return ground;
}

double theta_of(double h, double r) {
  return 2 * std::asin(std::sqrt(h / (2 * r)));
}
double sinkage_of(double theta_f, double r) {
  return 2 * r * std::pow(std::sin(theta_f / 2), 2);
}

/// The contact under a wheel whose soil may change with depth, whose shear may follow another law,
/// and whose rut may be deeper on one side.
class ModifiedContact {
 public:
  ModifiedContact(const Effects& effects, const Ground& ground, const Ratios& ratios,
                  WheelAccuracy accuracy)
      : effects_(effects), ground_(ground), ratios_(ratios), accuracy_(accuracy) {}

  /// Whether it is the base model's contact on another soil.
  bool is_plain() const { return is_base_law() && !strips_in_balance(); }

  /// The wheel's middle at an entry angle; the mean of all strips where they carry the load
  /// together.
  wheel_contact::LawIntegrals at(double theta_f) const {
    const double h = sinkage_of(theta_f, ground_.wheel.radius_m);
    if (!strips_in_balance()) return strip(h).integrals;
    wheel_contact::LawIntegrals mean;
    for (std::size_t i = 0; i < kStrips; ++i) {
      const double share = 1.0 / kStrips;
      const wheel_contact::LawIntegrals one = strip(depth_of(i, kStrips, h)).integrals;
      mean.plane.cohesion = mean.plane.cohesion + share * one.plane.cohesion;
      mean.plane.stress = mean.plane.stress + share * one.plane.stress;
      mean.fu_cohesion_n += share * one.fu_cohesion_n;
      mean.fu_stress_n += share * one.fu_stress_n;
    }
    return mean;
  }

  struct Sideways {
    double force_n = 0;  ///< |Fy|
    double roll_nm = 0;  ///< of the vertical force, positive: more on the inner side
  };

  /// Side force and roll moment from strips across the width, the inner ones (towards the centre of
  /// the turn) deeper; together they carry the load.
  Sideways sideways(double theta_f, double q, double load_n) const {
    const double h = sinkage_of(theta_f, ground_.wheel.radius_m);
    const std::size_t strips = effects_.rut_tilt_rad == 0 ? 1 : kStrips;
    const double share = 1.0 / static_cast<double>(strips);
    double fz = 0, fu = 0, fs = 0, roll = 0;
    for (std::size_t i = 0; i < strips; ++i) {
      const double inner = inner_of(i, strips);
      const Strip at = strip(depth_of(i, strips, h));
      const double strip_fz = share * at.integrals.plane.at(q).fz_n;
      fz += strip_fz;
      roll += strip_fz * inner;
      if (is_base_law()) {
        fu += share * wheel_contact::side_force_n(ground_, at.contact, ratios_, q, accuracy_);
        continue;
      }
      fu += share * (at.integrals.fu_cohesion_n + q * at.integrals.fu_stress_n);
      fs += share * wheel_contact::bulldozing_force_n(ground_, at.contact, ratios_);
    }
    return {.force_n = fu + fs, .roll_nm = roll * load_n / fz};
  }

  double fz_n(double theta_f) const { return at(theta_f).plane.at(1).fz_n; }

  /// The entry angle that carries the load with Q = 1, from one nearby outward.
  std::optional<double> solve(double load_n, double near_rad) const {
    constexpr double kQuarterTurn = std::numbers::pi / 2, kStep = 1.15, kShallowest = 1e-6;
    double low = near_rad, high = near_rad;
    while (fz_n(low) >= load_n) {
      high = low;
      low /= kStep;
      if (low < kShallowest) return std::nullopt;
    }
    while (high == low || fz_n(high) < load_n) {
      if (high >= kQuarterTurn) return std::nullopt;
      low = high;
      high = std::min(high * kStep, kQuarterTurn * (1 - 1e-12));
      if (low == high) return std::nullopt;
    }
    // Illinois: a secant that keeps its bracket
    double f_low = fz_n(low) - load_n, f_high = fz_n(high) - load_n;
    for (int i = 0; i < 60 && high - low > 1e-12 * high; ++i) {
      const double middle = high - f_high * (high - low) / (f_high - f_low);
      const double f = fz_n(middle) - load_n;
      if (std::abs(f) < 1e-10 * load_n) return middle;
      if (f < 0) {
        low = middle;
        f_low = f;
        f_high /= 2;
      } else {
        high = middle;
        f_high = f;
        f_low /= 2;
      }
    }
    return high;
  }

 private:
  static constexpr std::size_t kStrips = 7;

  /// The base model's integrals serve, strip by strip; theirs of the side force come as a whole.
  bool is_base_law() const {
    return effects_.shear == ShearLaw::kSeparate && effects_.layer_depth_m == 0;
  }

  bool strips_in_balance() const { return effects_.rut_in_balance && effects_.rut_tilt_rad != 0; }

  /// Distance of a strip from the wheel's middle, towards the centre of the turn.
  double inner_of(std::size_t i, std::size_t strips) const {
    return ground_.wheel.width_m *
           ((static_cast<double>(i) + 0.5) / static_cast<double>(strips) - 0.5);
  }

  double depth_of(std::size_t i, std::size_t strips, double h) const {
    const double r = ground_.wheel.radius_m;
    return std::clamp(h + inner_of(i, strips) * std::tan(effects_.rut_tilt_rad), 1e-9 * r, r);
  }

  struct Strip {
    Contact contact;
    wheel_contact::LawIntegrals integrals;
  };

  /// The full width at one depth.
  Strip strip(double depth_m) const {
    Ground ground = ground_;
    if (effects_.layer_depth_m > 0) {
      const double deep = 1 - std::exp(-std::pow(depth_m / effects_.layer_depth_m, 2));
      ground.stress_scale_pa *= 1 + (effects_.layer_stiffness - 1) * deep;
    }
    const Contact contact =
        wheel_contact::contact_at(ground, theta_of(depth_m, ground.wheel.radius_m), ratios_.slip);
    if (is_base_law()) {
      return {contact, {.plane = wheel_contact::integrate(ground, contact, ratios_, accuracy_)}};
    }
    return {contact, wheel_contact::integrate_with_law(ground, contact, ratios_, effects_.shear,
                                                       effects_.residual)};
  }

  const Effects& effects_;
  const Ground& ground_;
  const Ratios& ratios_;
  WheelAccuracy accuracy_;
};

/// What acts on the wheel beside the stress under it.
struct Additions {
  double fx_n = 0, torque_nm = 0;
};

Additions additions(const Effects& effects, const Ground& ground, const WheelState& state,
                    const Contact& contact, double sinkage_m, double gravity_mps2) {
  const Soil& soil = ground.soil;
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
  const double lugs_n = lugs_in_soil * effects.lug_share * passive_n(effects.lug_height_m) *
                        (1 + effects.lug_ripple * std::cos(effects.lug_phase_rad));
  sum.fx_n += lugs_n;
  sum.torque_nm += lugs_n * r;
  if (effects.flank_shear > 0) {
    const double theta = theta_of(h, r);
    const double segment_m2 = r * r * (theta - std::sin(theta) * std::cos(theta));
    const double limit_pa = soil.cohesion_pa + gamma * h / 2 * ground.tan_phi;
    const double turning = state.slip > -1 ? 1 : 0;
    sum.torque_nm += turning * effects.flank_shear * 2 * segment_m2 * limit_pa * r;
  }
  sum.torque_nm += effects.drag_torque_nm;
  return sum;
}

}  // namespace

WheelChannels mechanism_channels(const WheelModel& model, double load_n, const WheelMotion& motion,
                                 const WheelConditions& conditions) {
  const WheelModelSpec& spec = model.spec_;
  const ForwardMotion told = forward_motion(motion);
  WheelState state{.load_n = load_n,
                   .slip = told.ratios.slip,
                   .beta_abs_rad = told.ratios.beta_abs_rad,
                   .beta_sign = told.y_sign,
                   .rim_speed_mps = motion.rim_speed_mps,
                   .speed_mps = conditions.speed_mps > 0 ? conditions.speed_mps
                                                         : std::hypot(motion.vx_mps, motion.vy_mps),
                   .conditions = conditions};
  Effects effects;
  effects.wheel = spec.wheel;
  effects.soil = spec.soil;
  effects.load_n = load_n;
  effects = apply(model.mechanisms_, effects, state);
  if (!(effects.load_n > 0)) return {.forces = {.status = WheelStatus::kSinksToAxle}};

  WheelMotion moved = motion;
  moved.rim_speed_mps *= effects.rim_factor;
  const ForwardMotion forward = forward_motion(moved);
  const Ratios& ratios = forward.ratios;
  const Ground ground = ground_of(effects, spec.gravity_mps2);
  const ModifiedContact modified(effects, ground, ratios, model.accuracy_);
  const double r = ground.wheel.radius_m;
  const WheelStatus sunk = WheelStatus::kSinksToAxle;

  // the sinkage that carries the load with Q = 1; yoshida2004: at rest
  const bool at_rest = spec.variant == WheelVariant::kYoshida2004;
  const Ratios reference = at_rest ? Ratios{} : ratios;
  const auto plain = model.solver_.solve(ground, effects.load_n, reference, model.accuracy_);
  std::optional<double> theta_f;
  if (modified.is_plain()) {
    if (plain) theta_f = plain->contact.theta_f_rad;
  } else {
    constexpr double kSomewhere_rad = 0.5;
    theta_f = ModifiedContact(effects, ground, reference, model.accuracy_)
                  .solve(effects.load_n, plain ? plain->contact.theta_f_rad : kSomewhere_rad);
  }
  if (!theta_f) return {.forces = {.status = sunk}};
  double h = sinkage_of(*theta_f, r);
  const double h0 = h;
  if (at_rest) h += spec.soil.c0_m * std::max(ratios.slip, 0.0);
  h = h * effects.sinkage_factor + effects.sinkage_added_m;
  if (!(h < r && h > 0)) return {.forces = {.status = sunk}};
  const bool imposed = at_rest || h != h0;
  if (h != h0) theta_f = theta_of(h, r);

  const Contact contact = wheel_contact::contact_at(ground, *theta_f, ratios.slip);
  const Integrals plane = modified.is_plain()
                              ? wheel_contact::integrate(ground, contact, ratios, model.accuracy_)
                              : modified.at(*theta_f).plane;
  const double q = imposed ? (effects.load_n - plane.cohesion.fz_n) / plane.stress.fz_n : 1.0;
  if (!(q >= 0)) return {.forces = {.status = WheelStatus::kCohesionCarriesLoad}};
  const Resultant resultant = plane.at(q);
  double side_n = 0, roll_nm = 0;
  if (modified.is_plain() && effects.rut_tilt_rad == 0) {
    side_n = wheel_contact::side_force_n(ground, contact, ratios, q, model.accuracy_);
  } else {
    const auto sideways = modified.sideways(*theta_f, q, effects.load_n);
    side_n = sideways.force_n;
    // inner is right (-y) for a motion to the left: the moment about x is negative
    roll_nm = -forward.y_sign * sideways.roll_nm;
  }

  const Additions added = additions(effects, ground, state, contact, h, spec.gravity_mps2);
  const double rut_m = ground.wheel.width_m / 2 * std::tan(effects.rut_tilt_rad);
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
