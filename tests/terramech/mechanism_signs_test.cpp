// Mechanisms: each is a bundle of signs over the channels, in conditions where it acts and in
// conditions where it must not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terramech/basics/input_error.h"
#include "terramech/force_table/force_table.h"
#include "terramech/mechanisms/mechanism.h"
#include "terramech/wheel/wheel_model.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

struct Case {
  std::string id, form;
  double slip, beta_deg, load_n;
  std::string fx, fy, torque, sinkage;  ///< "+", "-", "0" (not at all), "~" (little), "?" (open)
  WheelConditions conditions = {};
};

/// Change of a channel against what is little: .15 % of the load.
void expect_sign(double change, double scale, const std::string& sign, const std::string& where) {
  constexpr double kLittle = 0.0015;
  if (sign == "+") {
    EXPECT_GT(change, kLittle * scale) << where;
  }
  if (sign == "-") {
    EXPECT_LT(change, -kLittle * scale) << where;
  }
  if (sign == "0") {
    EXPECT_NEAR(change, 0, 1e-6 * scale) << where;
  }
  if (sign == "~") {
    EXPECT_NEAR(change, 0, 5 * kLittle * scale) << where;
  }
}

/// Dry sand whose shear is mobilised at moderate slip. Where it is not (the simulant's kx is 40 %
/// of that wheel's radius) or where cohesion counts, a longer contact pulls more, and Fx rises with
/// sinkage.
WheelModelSpec mobilised() {
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.soil.cohesion_pa = 150;
  spec.soil.lambda = 0;
  spec.soil.kx0_m = 0.004;
  spec.soil.ky0_m = 0.010;
  spec.soil.kx1_m = spec.soil.ky1_m = 0;
  return spec;
}

void expect_bundle(const Case& at) {
  const WheelModelSpec spec = mobilised();
  const WheelMotion motion = motion_at(at.slip, at.beta_deg * kDegree);
  const WheelForces base = WheelModel(spec).forces(at.load_n, motion);
  WheelModelSpec with = spec;
  with.mechanisms.push_back({at.id, at.form, {}});
  const WheelForces changed = WheelModel(with).channels(at.load_n, motion, at.conditions).forces;
  ASSERT_TRUE(has_forces(changed.status)) << at.id;
  const std::string where = at.id + " " + at.form + " at slip " + std::to_string(at.slip) +
                            ", slip angle " + std::to_string(at.beta_deg);
  expect_sign(changed.fx_n - base.fx_n, at.load_n, at.fx, where + ": fx");
  expect_sign(changed.fy_n - base.fy_n, at.load_n, at.fy, where + ": fy");
  expect_sign(changed.torque_nm - base.torque_nm, at.load_n * spec.wheel.radius_m, at.torque,
              where + ": torque");
  expect_sign(changed.sinkage_m - base.sinkage_m, base.sinkage_m, at.sinkage, where + ": sinkage");
}

const std::vector<Case> kBundles{
    // id, form, slip, slip angle, load: fx, fy, torque, sinkage
    {"slip_sinkage", "exponent", 0.5, 0, 60, "-", "0", "?", "+"},
    {"slip_sinkage", "exponent", -0.3, 0, 60, "0", "0", "0", "0"},
    {"slip_sinkage", "lyasko", 0.5, 0, 60, "-", "0", "+", "+"},
    {"slip_sinkage", "lyasko", -0.3, 10, 60, "0", "0", "0", "0"},
    {"slip_sinkage", "linear", 0.5, 0, 60, "-", "0", "+", "+"},
    {"slip_sinkage", "hyperbolic", 0.5, 0, 60, "-", "0", "?", "+"},
    {"slip_sinkage", "power", 0.5, 0, 60, "-", "0", "?", "+"},
    {"slip_sinkage", "power", -0.3, 10, 60, "0", "0", "0", "0"},
    {"slip_sinkage", "dug_rut", 0.5, 0, 60, "-", "0", "+", "+"},
    {"slip_sinkage", "dug_rut", -0.3, 10, 60, "0", "0", "0", "0"},
    {"lateral_digging", "sine", 0.2, 20, 60, "?", "+", "?", "+"},
    {"lateral_digging", "sine", 0.2, 0, 60, "0", "0", "0", "0"},
    {"lateral_digging", "power", 0.2, 20, 60, "?", "+", "?", "+"},
    {"lateral_digging", "power", 0.2, 0, 60, "0", "0", "0", "0"},
    {"rut_asymmetry", "tilt", 0.2, 20, 60, "~", "?", "~", "~"},
    {"rut_asymmetry", "tilt", 0.2, 4, 60, "0", "0", "0", "0"},
    {"rut_asymmetry", "tilt_in_balance", 0.2, 20, 60, "?", "?", "?", "?"},
    {"rut_asymmetry", "inner_wall", 0.2, 20, 60, "0", "+", "0", "0"},
    {"rut_asymmetry", "inner_wall", 0.2, 0, 60, "0", "0", "0", "0"},
    {"rut_asymmetry", "tilt_in_balance", 0.2, 4, 60, "0", "0", "0", "0"},
    {"shear_modulus_slip_angle", "linear", 0.4, 30, 60, "-", "-", "-", "?"},
    {"shear_modulus_slip_angle", "linear", 0.4, 0, 60, "0", "0", "0", "0"},
    {"shear_modulus_slip_angle", "power", 0.4, 30, 60, "-", "-", "-", "?"},
    {"shear_modulus_slip_angle", "power", 0.4, 0, 60, "0", "0", "0", "0"},
    {"coupled_shear", "displacement", 0.5, 30, 60, "-", "-", "-", "?"},
    {"coupled_shear", "slip_velocity", 0.5, 30, 60, "-", "-", "-", "?"},
    {"coupled_shear", "within_limit", 0.5, 30, 60, "-", "-", "-", "?"},
    {"coupled_shear", "within_limit", 0.3, 0, 60, "0", "0", "0", "0"},
    {"coupled_shear", "displacement", 0.3, 0, 60, "0", "0", "0", "0"},
    {"grousers", "passive_pressure", 0.4, 0, 60, "+", "0", "+", "+"},
    {"grousers", "passive_pressure", -0.3, 0, 60, "0", "0", "0", "0"},
    {"grousers", "effective_radius", 0.4, 0, 60, "+", "0", "+", "+"},
    {"grousers", "effective_radius", -0.3, 0, 60, "0", "0", "0", "0"},
    {"grousers", "soil_block", 0.4, 0, 60, "+", "0", "+", "+"},
    {"grousers", "soil_block", 0.4, 20, 60, "+", "+", "+", "+"},
    {"grousers", "carried_soil", 0.4, 0, 60, "+", "0", "+", "+"},
    {"sliding_sinkage", "power", 0.5, 0, 60, "-", "0", "?", "+"},
    {"sliding_sinkage", "power", -0.4, 0, 60, "?", "0", "?", "+"},
    {"sliding_sinkage", "power", 0, 30, 60, "?", "+", "?", "+"},
    {"sliding_sinkage", "power", 0, 0, 60, "0", "0", "0", "0"},
    {"sliding_sinkage", "added", 0.5, 0, 60, "-", "0", "?", "+"},
    {"sliding_sinkage", "added", 0, 0, 60, "0", "0", "0", "0"},
    {"flank_friction", "side_force", 0.2, 20, 60, "-", "0", "0", "0"},
    {"flank_friction", "side_force", 0.2, 0, 60, "0", "0", "0", "0"},
    {"flank_friction", "bulldozing", 0.2, 20, 60, "-", "0", "0", "0"},
    {"flank_friction", "bulldozing", 0.2, 0, 60, "0", "0", "0", "0"},
    {"side_surcharge", "heap", 0.2, 20, 60, "0", "+", "0", "0"},
    {"side_surcharge", "heap", 0.2, 0, 60, "0", "0", "0", "0"},
    {"side_surcharge", "flank", 0.2, 20, 60, "0", "+", "0", "0"},
    {"side_surcharge", "flank", 0.2, 0, 60, "0", "0", "0", "0"},
    {"rim_friction", "ratio", 0.5, 0, 60, "-", "0", "-", "?"},
    {"rim_friction", "no_adhesion", 0.5, 20, 60, "-", "?", "-", "?"},
    {"soil_change", "strength", 0.3, 0, 60, "0", "0", "0", "0"},
    {"soil_change", "state", 0.3, 0, 60, "0", "0", "0", "0"},
    {"soil_change", "for_a_time", 0.3, 0, 60, "-", "0", "?", "+", {.time_s = 80000}},
    {"soil_change", "for_a_time", 0.3, 0, 60, "0", "0", "0", "0", {.time_s = 90000}},
    {"side_pileup", "raised", 0.2, 20, 120, "0", "+", "0", "0"},
    {"side_pileup", "raised", 0.2, 0, 120, "0", "0", "0", "0"},
    {"side_pileup", "surcharge", 0.2, 20, 120, "0", "+", "0", "0"},
    {"front_bulldozing", "passive", 0.3, 0, 60, "-", "0", "0", "0"},
    {"front_bulldozing", "passive", -0.3, 0, 60, "-", "0", "0", "0"},
    {"rear_contact", "linear", 0.5, 0, 60, "?", "0", "?", "-"},
    {"rear_contact", "linear", 0, 0, 60, "0", "0", "0", "0"},
    {"rear_contact", "power", 0.5, 0, 60, "?", "0", "?", "-"},
    {"rear_contact", "power", 0, 0, 60, "0", "0", "0", "0"},
    {"max_stress_angle", "linear", 0.2, 30, 60, "-", "?", "?", "?"},
    {"max_stress_angle", "linear", 0.2, 0, 60, "0", "0", "0", "0"},
    {"max_stress_angle", "power", 0.2, 30, 60, "-", "?", "?", "?"},
    {"max_stress_angle", "power", 0.2, 0, 60, "0", "0", "0", "0"},
    {"skid_branch", "reversal", -0.5, 0, 60, "?", "0", "?", "+"},
    {"skid_branch", "reversal", 0.3, 20, 60, "0", "0", "0", "0"},
    {"skid_branch", "weakened", -0.5, 0, 60, "?", "0", "?", "+"},
    {"skid_branch", "weakened", 0.3, 20, 60, "0", "0", "0", "0"},
    {"skid_branch", "heap_ahead", -0.5, 0, 60, "-", "0", "?", "+"},
    {"skid_branch", "heap_ahead", 0.3, 20, 60, "0", "0", "0", "0"},
    {"multi_pass", "stiffening", 0.3, 0, 60, "+", "0", "?", "-", {.pass = 2}},
    {"multi_pass", "stiffening", 0.3, 0, 60, "0", "0", "0", "0", {.pass = 1}},
    {"multi_pass", "compaction", 0.3, 0, 60, "+", "0", "+", "-", {.pass = 2}},
    {"multi_pass", "compaction", 0.3, 0, 60, "0", "0", "0", "0", {.pass = 1}},
    {"rate_dependence", "stiffness", 0.2, 0, 60, "?", "0", "?", "-", {.speed_mps = 0.5}},
    {"rate_dependence", "stiffness", 0.2, 0, 60, "0", "0", "0", "0", {.speed_mps = 0.05}},
    {"rate_dependence", "shear_limit", 0.4, 0, 60, "+", "0", "+", "?", {.speed_mps = 0.5}},
    {"rate_dependence", "inertia", 0.4, 0, 60, "-", "0", "0", "0", {.speed_mps = 1}},
    {"rate_dependence", "inertia", 0.4, 0, 60, "~", "0", "0", "0", {.speed_mps = 0.01}},
    {"layered_soil", "hard_below", 0.2, 0, 120, "?", "0", "?", "-"},
    {"layered_soil", "crust", 0.2, 0, 60, "?", "0", "?", "-"},
    {"soil_zone", "factors", 0.3, 0, 60, "-", "0", "?", "+", {.position_m = 0.5}},
    {"soil_zone", "factors", 0.3, 0, 60, "0", "0", "0", "0", {.position_m = 2}},
    {"cohesion_drift", "linear", 0.5, 0, 5, "-", "0", "-", "?", {.time_s = 20000}},
    {"cohesion_drift", "linear", 0.5, 0, 5, "0", "0", "0", "0", {.time_s = 0}},
    {"cohesion_drift", "drying", 0.5, 0, 5, "-", "0", "-", "?", {.time_s = 30000}},
    {"cohesion_drift", "for_a_time", 0.5, 0, 5, "-", "0", "-", "?", {.time_s = 80000}},
    {"cohesion_drift", "for_a_time", 0.5, 0, 5, "0", "0", "0", "0", {.time_s = 90000}},
    {"shear_hump", "wong", 0.6, 0, 60, "?", "0", "?", "?"},
    {"shear_hump", "softening", 0.6, 0, 60, "-", "0", "-", "+"},
    {"slope_tilt", "gravity", 0.2, 10, 60, "-", "0", "0", "0"},
    {"slope_tilt", "gravity", 0.2, 10, 60, "+", "0", "0", "0", {.heading_rad = std::numbers::pi}},
    {"slope_tilt",
     "gravity",
     0.2,
     0,
     60,
     "~",
     "+",
     "0",
     "0",
     {.heading_rad = std::numbers::pi / 2}},
    {"flexible_wheel", "substitute_circle", 0.2, 0, 120, "?", "0", "?", "-"},
    {"sidewall_shear", "segment", 0.3, 0, 120, "0", "0", "+", "0"},
    {"bearing_drag", "linear", 0.3, 10, 60, "0", "0", "+", "0"},
    {"load_transfer", "proportional", 0.3, 10, 60, "+", "+", "+", "+"},
    {"load_transfer", "offset", 0.3, 10, 60, "+", "+", "+", "+"},
    {"load_transfer", "affine", 0.3, 10, 60, "+", "+", "+", "+"},
    {"load_transfer", "drifting", 0.3, 10, 60, "+", "+", "+", "+", {.time_s = 80000}},
    {"load_transfer", "drifting", 0.3, 10, 60, "0", "0", "0", "0", {.time_s = 0}},
    {"load_transfer", "for_a_time", 0.3, 10, 60, "+", "+", "+", "+", {.time_s = 80000}},
    {"load_transfer", "for_a_time", 0.3, 10, 60, "0", "0", "0", "0", {.time_s = 90000}},
    {"load_transfer", "drawbar", 0.3, 10, 60, "+", "+", "+", "+"},
    {"load_transfer", "drawbar", -0.3, 10, 60, "+", "-", "?", "-"},
    {"slip_scale", "rim_speed", 0.05, 0, 60, "+", "0", "+", "?"},
};

}  // namespace

TEST(MechanismSigns, AreThoseOfItsBundle) {
  for (const Case& at : kBundles) expect_bundle(at);
}

TEST(MechanismSigns, EveryFormHasABundle) {
  for (const MechanismForm& form : mechanism_forms()) {
    EXPECT_TRUE(std::ranges::any_of(
        kBundles, [&](const Case& at) { return at.id == form.id && at.form == form.form; }))
        << form.id << " " << form.form;
    EXPECT_FALSE(form.source.empty());
    EXPECT_FALSE(form.formula.empty());
    for (const MechanismParameter& parameter : form.parameters) {
      EXPECT_LT(parameter.low, parameter.high) << form.id << " " << parameter.name;
      EXPECT_GE(parameter.typical, parameter.low) << form.id << " " << parameter.name;
      EXPECT_LE(parameter.typical, parameter.high) << form.id << " " << parameter.name;
    }
  }
}

}  // namespace regoplan
