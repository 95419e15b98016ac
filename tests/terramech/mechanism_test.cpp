// Mechanisms: each is a bundle of signs over the channels, in conditions where it acts and in
// conditions where it must not.
#include "terramech/mechanisms/mechanism.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terramech/basics/input_error.h"
#include "terramech/force_table/force_table.h"
#include "terramech/wheel/wheel_model.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

WheelModel with(WheelModelSpec spec, const std::string& id, const std::string& form = "",
                std::map<std::string, double> parameters = {}) {
  spec.mechanisms.push_back({id, form, std::move(parameters)});
  return WheelModel(spec);
}

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
  const WheelForces changed =
      with(spec, at.id, at.form).channels(at.load_n, motion, at.conditions).forces;
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
    {"slip_sinkage", "dug_rut", 0.5, 0, 60, "-", "0", "+", "+"},
    {"slip_sinkage", "dug_rut", -0.3, 10, 60, "0", "0", "0", "0"},
    {"lateral_digging", "sine", 0.2, 20, 60, "?", "+", "?", "+"},
    {"lateral_digging", "sine", 0.2, 0, 60, "0", "0", "0", "0"},
    {"rut_asymmetry", "tilt", 0.2, 20, 60, "~", "?", "~", "~"},
    {"rut_asymmetry", "tilt", 0.2, 4, 60, "0", "0", "0", "0"},
    {"rut_asymmetry", "tilt_in_balance", 0.2, 20, 60, "?", "?", "?", "?"},
    {"rut_asymmetry", "inner_wall", 0.2, 20, 60, "0", "+", "0", "0"},
    {"rut_asymmetry", "inner_wall", 0.2, 0, 60, "0", "0", "0", "0"},
    {"rut_asymmetry", "tilt_in_balance", 0.2, 4, 60, "0", "0", "0", "0"},
    {"shear_modulus_slip_angle", "linear", 0.4, 30, 60, "-", "-", "-", "?"},
    {"shear_modulus_slip_angle", "linear", 0.4, 0, 60, "0", "0", "0", "0"},
    {"coupled_shear", "displacement", 0.5, 30, 60, "-", "-", "-", "?"},
    {"coupled_shear", "slip_velocity", 0.5, 30, 60, "-", "-", "-", "?"},
    {"coupled_shear", "within_limit", 0.5, 30, 60, "-", "-", "-", "?"},
    {"coupled_shear", "within_limit", 0.3, 0, 60, "0", "0", "0", "0"},
    {"coupled_shear", "displacement", 0.3, 0, 60, "0", "0", "0", "0"},
    {"grousers", "passive_pressure", 0.4, 0, 60, "+", "0", "+", "+"},
    {"grousers", "passive_pressure", -0.3, 0, 60, "0", "0", "0", "0"},
    {"grousers", "effective_radius", 0.4, 0, 60, "+", "0", "+", "+"},
    {"grousers", "effective_radius", -0.3, 0, 60, "0", "0", "0", "0"},
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
    {"side_pileup", "raised", 0.2, 20, 120, "0", "+", "0", "0"},
    {"side_pileup", "raised", 0.2, 0, 120, "0", "0", "0", "0"},
    {"side_pileup", "surcharge", 0.2, 20, 120, "0", "+", "0", "0"},
    {"front_bulldozing", "passive", 0.3, 0, 60, "-", "0", "0", "0"},
    {"front_bulldozing", "passive", -0.3, 0, 60, "-", "0", "0", "0"},
    {"rear_contact", "linear", 0.5, 0, 60, "?", "0", "?", "-"},
    {"rear_contact", "linear", 0, 0, 60, "0", "0", "0", "0"},
    {"max_stress_angle", "linear", 0.2, 30, 60, "-", "?", "?", "?"},
    {"max_stress_angle", "linear", 0.2, 0, 60, "0", "0", "0", "0"},
    {"skid_branch", "reversal", -0.5, 0, 60, "?", "0", "?", "+"},
    {"skid_branch", "reversal", 0.3, 20, 60, "0", "0", "0", "0"},
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
    {"shear_hump", "wong", 0.6, 0, 60, "?", "0", "?", "?"},
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
    {"load_transfer", "drawbar", 0.3, 10, 60, "+", "+", "+", "+"},
    {"load_transfer", "drawbar", -0.3, 10, 60, "+", "-", "?", "-"},
    {"slip_scale", "rim_speed", 0.05, 0, 60, "+", "0", "+", "?"},
};

}  // namespace

TEST(Mechanism, HasItsBundleOfSigns) {
  for (const Case& at : kBundles) expect_bundle(at);
}

TEST(Mechanism, ACarriagesArmAddsItsShareOfTheDrawbarPullThatTheWheelThenHas) {
  const auto pair = named_soils::shipped_pairs().front();
  for (const double slip : {-0.3, 0.1, 0.6}) {
    for (const double share : {-0.3, 0.3}) {
      const WheelForces on_arm = with(pair.spec, "load_transfer", "drawbar", {{"share", share}})
                                     .forces(pair.nominal_load_n, motion_at(slip, 0.2));
      const WheelForces alone = WheelModel(pair.spec).forces(
          pair.nominal_load_n + share * on_arm.fx_n, motion_at(slip, 0.2));
      EXPECT_NEAR(on_arm.fx_n, alone.fx_n, 1e-4 * pair.nominal_load_n) << slip << " " << share;
      EXPECT_NEAR(on_arm.sinkage_m, alone.sinkage_m, 1e-4 * alone.sinkage_m);
    }
  }
}

TEST(Mechanism, SlipSinkageDeepensTheRutAndCostsTorqueOnEverySoil) {
  for (const auto& pair : named_soils::shipped_pairs()) {
    const double load_n = pair.nominal_load_n, r = pair.spec.wheel.radius_m;
    for (const double slip : {0.35, 0.6}) {
      const WheelForces base = WheelModel(pair.spec).forces(load_n, motion_at(slip, 0));
      const std::vector<Mechanism> forms{{"slip_sinkage", "exponent", {}},
                                         {"slip_sinkage", "lyasko", {}},
                                         {"slip_sinkage", "linear", {{"c0_m", 0.15 * r}}},
                                         {"slip_sinkage", "hyperbolic", {{"hj_m", 0.04 * r}}},
                                         {"slip_sinkage", "dug_rut", {}}};
      for (const Mechanism& form : forms) {
        const WheelForces dug =
            with(pair.spec, form.id, form.form, form.parameters).forces(load_n, motion_at(slip, 0));
        const std::string where = pair.name + " " + form.form + " " + std::to_string(slip);
        EXPECT_GT(dug.sinkage_m, 1.1 * base.sinkage_m) << where;
        EXPECT_GT(dug.torque_nm, base.torque_nm + 0.005 * load_n * r) << where;
      }
      // what the rut costs outweighs what the longer contact pulls
      EXPECT_LT(with(pair.spec, "slip_sinkage", "dug_rut").forces(load_n, motion_at(slip, 0)).fx_n,
                base.fx_n - 0.02 * load_n)
          << pair.name;
    }
  }
}

TEST(Mechanism, WithoutTheCostOfTheRutFxFallsOnlyWhereShearIsMobilisedAndCohesionSmall) {
  for (const auto& pair : named_soils::shipped_pairs()) {
    const WheelMotion motion = motion_at(0.5, 0);
    const auto change_n = [&](const WheelModelSpec& spec) {
      return with(spec, "slip_sinkage", "lyasko").forces(pair.nominal_load_n, motion).fx_n -
             WheelModel(spec).forces(pair.nominal_load_n, motion).fx_n;
    };
    WheelModelSpec dry_sand = pair.spec;
    dry_sand.soil.cohesion_pa = 0;
    dry_sand.soil.lambda = 0;
    dry_sand.soil.kx1_m = 0;
    const WheelForces base = WheelModel(dry_sand).forces(pair.nominal_load_n, motion);
    dry_sand.soil.kx0_m = dry_sand.wheel.radius_m * base.theta_f_rad * 0.5 / 10;
    EXPECT_LT(change_n(dry_sand), 0) << pair.name;
    if (pair.name.starts_with("tohoku")) {
      EXPECT_GT(change_n(pair.spec), 0) << pair.name;
    }
  }
}

TEST(Mechanism, LayersAreFeltWhereTheyLie) {
  // A crust bears most at its depth and nothing far below; a hard base is felt only by deep wheels.
  const WheelModelSpec spec = wheel_specs::ishigami2007();
  const auto share = [&](const std::string& form, double load_n) {
    const WheelMotion motion = motion_at(0.2, 0);
    return with(spec, "layered_soil", form, {{"depth_m", 0.005}}).forces(load_n, motion).sinkage_m /
           WheelModel(spec).forces(load_n, motion).sinkage_m;
  };
  EXPECT_LT(share("crust", 20), 0.8 * share("crust", 150));
  const WheelMotion motion = motion_at(0.2, 0);
  const auto hard = [&](double load_n) {
    return with(spec, "layered_soil", "hard_below", {{"depth_m", 0.05}})
               .forces(load_n, motion)
               .sinkage_m /
           WheelModel(spec).forces(load_n, motion).sinkage_m;
  };
  EXPECT_GT(hard(5), 0.95);
  EXPECT_LT(hard(150), 0.85);
}

TEST(Mechanism, EveryFormHasABundle) {
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

TEST(Mechanism, EveryFormIsFiniteAndSymmetricOverTheDomain) {
  for (const auto& named : wheel_specs::all()) {
    for (const MechanismForm& form : mechanism_forms()) {
      const WheelModel model = with(named.spec, std::string(form.id), std::string(form.form));
      for (const double slip : {-1.0, -0.5, 0.0, 0.4, 1.0}) {
        for (const double beta_deg : {0.0, 10.0, 60.0}) {
          const WheelForces left =
              model.forces(named.nominal_load_n, motion_at(slip, beta_deg * kDegree));
          const WheelForces right =
              model.forces(named.nominal_load_n, motion_at(slip, -beta_deg * kDegree));
          const std::string where = named.name + " " + std::string(form.id) + " " +
                                    std::string(form.form) + " " + std::to_string(slip);
          EXPECT_TRUE(std::isfinite(left.fx_n + left.fy_n + left.torque_nm + left.sinkage_m))
              << where;
          EXPECT_EQ(left.status, right.status) << where;
          EXPECT_EQ(left.fx_n, right.fx_n) << where;
          EXPECT_EQ(left.fy_n, -right.fy_n) << where;
        }
      }
    }
  }
}

TEST(Mechanism, WithoutMechanismsTheChannelsAreTheBaseModel) {
  for (const auto& named : wheel_specs::all()) {
    const WheelModel model(named.spec);
    const WheelMotion motion = motion_at(0.3, 0.2);
    const WheelForces forces = model.forces(named.nominal_load_n, motion);
    const WheelForces channels = model.channels(named.nominal_load_n, motion).forces;
    EXPECT_NEAR(channels.fx_n, forces.fx_n, 1e-6 * named.nominal_load_n);
    EXPECT_NEAR(channels.fy_n, forces.fy_n, 1e-6 * named.nominal_load_n);
  }
}

TEST(Mechanism, OwnIntegralsAgreeWithTheBaseModelWhereTheMechanismIsIdle) {
  for (const auto& named : wheel_specs::all()) {
    const WheelModel base(named.spec);
    const WheelModel layered = with(named.spec, "layered_soil", "hard_below", {{"ratio", 1}});
    for (const double share : {0.1, 1.0, 2.0}) {
      for (const double slip : {-0.9, -0.7, -0.05, 0.0, 0.5, 0.95}) {
        const double load_n = share * named.nominal_load_n;
        const WheelMotion motion = motion_at(slip, 0.3);
        const WheelForces a = base.forces(load_n, motion), b = layered.forces(load_n, motion);
        EXPECT_NEAR(b.fx_n, a.fx_n, 2e-5 * load_n) << named.name << " " << slip << " " << share;
        EXPECT_NEAR(b.fy_n, a.fy_n, 2e-5 * load_n) << named.name << " " << slip << " " << share;
      }
    }
  }
}

TEST(Mechanism, CoupledShearStaysWithinOneMohrCoulombLimit) {
  const WheelModelSpec spec = wheel_specs::ishigami2007();
  const WheelModel base(spec), coupled = with(spec, "coupled_shear");
  // Dragged sideways and spinning at once, the base model counts the limit twice.
  const WheelMotion motion{0.5, 2, 3};
  const WheelForces a = base.forces(60, motion), b = coupled.forces(60, motion);
  EXPECT_LT(std::hypot(b.fx_n, b.fy_n), std::hypot(a.fx_n, a.fy_n));
  EXPECT_LT(b.torque_nm, 0.9 * a.torque_nm);
}

TEST(Mechanism, TheInnerSideOfTheRutIsDeeper) {
  const WheelModel model = with(wheel_specs::ishigami2007(), "rut_asymmetry");
  const WheelChannels left = model.channels(60, motion_at(0.2, 20 * kDegree));
  EXPECT_GT(left.rut_right_m, left.rut_left_m + 0.001);
  EXPECT_NE(left.roll_moment_nm, 0);
  const WheelChannels right = model.channels(60, motion_at(0.2, -20 * kDegree));
  EXPECT_EQ(right.rut_left_m, left.rut_right_m);
  EXPECT_EQ(right.roll_moment_nm, -left.roll_moment_nm);
}

TEST(Mechanism, FlanksRubAlikeOnBothSides) {
  const WheelModelSpec spec = wheel_specs::ishigami2007();
  for (const double slip : {-0.3, 0.0, 0.4}) {
    const WheelMotion motion = motion_at(slip, 25 * kDegree);
    const WheelForces smooth =
        with(spec, "flank_friction", "side_force", {{"mu", 0}}).forces(60, motion);
    const WheelForces rubbed =
        with(spec, "flank_friction", "side_force", {{"mu", 0.3}}).forces(60, motion);
    EXPECT_NEAR(rubbed.fx_n, smooth.fx_n - 0.3 * std::abs(smooth.fy_n), 1e-9) << slip;
    EXPECT_EQ(rubbed.torque_nm, smooth.torque_nm);
  }
}

TEST(Mechanism, ARimAsRoughAsTheSoilIsTheBaseModel) {
  const WheelModelSpec spec = wheel_specs::ishigami2007();
  const WheelMotion motion = motion_at(0.4, 10 * kDegree);
  const WheelForces base = WheelModel(spec).forces(60, motion);
  const WheelForces rough = with(spec, "rim_friction", "ratio", {{"ratio", 1}}).forces(60, motion);
  // Model and mechanisms integrate by different rules, each far closer than its promised accuracy.
  EXPECT_NEAR(rough.fx_n, base.fx_n, 2e-9 * 60);
  EXPECT_NEAR(rough.fy_n, base.fy_n, 2e-9 * 60);
  const WheelForces smooth =
      with(spec, "rim_friction", "ratio", {{"ratio", 0.6}}).forces(60, motion);
  EXPECT_LT(smooth.fx_n, base.fx_n);
}

TEST(Mechanism, AnImposedSinkageIsTheModelsAndTheOffset) {
  const WheelModel model(wheel_specs::ishigami2007());
  const WheelMotion motion = motion_at(0.3, 5 * kDegree);
  const WheelChannels base = model.channels(60, motion, {});
  const WheelChannels deeper = model.channels(60, motion, {.sinkage_offset_m = 0.004});
  EXPECT_NEAR(deeper.forces.sinkage_m, base.forces.sinkage_m + 0.004, 1e-12);
  EXPECT_GT(deeper.forces.fy_n, base.forces.fy_n);
}

TEST(Mechanism, LugsRippleWithTheWheelAngle) {
  const WheelModel model = with(wheel_specs::ishigami2007(), "grousers", "passive_pressure",
                                {{"ripple", 0.4}, {"lugs", 24}});
  const auto fx = [&](double wheel_angle_rad) {
    return model.channels(60, motion_at(0.4, 0), {.wheel_angle_rad = wheel_angle_rad}).forces.fx_n;
  };
  EXPECT_GT(fx(0), fx(std::numbers::pi / 24));
  EXPECT_NEAR(fx(0), fx(2 * std::numbers::pi / 24), 1e-9);
}

TEST(Mechanism, TheHumpPeaksAtItsModulusAndFallsToItsResidual) {
  WheelModelSpec spec = wheel_specs::yoshida2004();
  spec.soil.c0_m = 0;
  const WheelModel base(spec), hump = with(spec, "shear_hump", "", {{"residual", 0.5}});
  EXPECT_GT(hump.forces(60, motion_at(0.1, 0)).torque_nm,
            base.forces(60, motion_at(0.1, 0)).torque_nm);
  EXPECT_LT(hump.forces(60, motion_at(0.95, 0)).torque_nm,
            0.9 * base.forces(60, motion_at(0.95, 0)).torque_nm);
}

TEST(Mechanism, SeveralActTogether) {
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.mechanisms = {{"slip_sinkage", "linear", {}}, {"bearing_drag", "", {{"t0_nm", 0.1}}}};
  const WheelMotion motion = motion_at(0.5, 0.1);
  const WheelForces both = WheelModel(spec).forces(60, motion);
  const WheelForces digging =
      with(wheel_specs::ishigami2007(), "slip_sinkage", "linear").forces(60, motion);
  EXPECT_EQ(both.sinkage_m, digging.sinkage_m);
  EXPECT_GT(both.torque_nm, digging.torque_nm + 0.09);
}

TEST(Mechanism, CanBeTabulatedUnlessItDependsOnTheSpeed) {
  for (const char* id : {"lateral_digging", "coupled_shear", "grousers", "skid_branch"}) {
    WheelModelSpec spec = wheel_specs::ishigami2007();
    spec.mechanisms = {{id, "", {}}};
    const ForceTable table({.model = spec, .nominal_load_n = 60});
    const TableError error = table.check(5000, 2000, 3);
    EXPECT_LE(error.at_999_permille, 1e-3) << id;
    EXPECT_LE(error.at_worst, 5e-3) << id;
  }
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.mechanisms = {{"rate_dependence", "", {}}};
  EXPECT_THROW(ForceTable({.model = spec, .nominal_load_n = 60}), InputError);
}

TEST(Mechanism, OfATiltedBedPullsTheSameWayAtEveryHeadingOfTheWheelInItsTable) {
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.mechanisms = {{"slope_tilt", "", {{"tilt_rad", 0.05}, {"direction_rad", 0.4}}}};
  const ForceTable table({.model = spec, .nominal_load_n = 60});
  for (const WheelMotion& motion : {WheelMotion{0.8, 0.2, 1}, WheelMotion{-0.8, 0.2, -1},
                                    WheelMotion{0.8, -0.2, 1}, WheelMotion{-1, -0.2, -0.9}}) {
    const WheelForces looked_up = table.forces(60, motion);
    const WheelForces direct = table.direct().forces(60, motion);
    const SlopedForces sloped = table.forces_with_slopes(60, motion);
    EXPECT_NEAR(looked_up.fx_n, direct.fx_n, 0.06);
    EXPECT_NEAR(looked_up.fy_n, direct.fy_n, 0.06);
    EXPECT_NEAR(sloped.fx.value_n, direct.fx_n, 0.06);
    EXPECT_NEAR(sloped.fy.value_n, direct.fy_n, 0.06);
  }
}

TEST(Mechanism, NamesWhatItDoesNotKnow) {
  const auto message = [](const Mechanism& mechanism) -> std::string {
    try {
      form_of(mechanism);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({"magic", "", {}}).find("slip_sinkage"), std::string::npos);
  EXPECT_NE(message({"slip_sinkage", "magic", {}}).find("lyasko"), std::string::npos);
  EXPECT_NE(message({"slip_sinkage", "exponent", {{"n3", 1}}}).find("n1"), std::string::npos);
  EXPECT_NE(message({"slip_sinkage", "exponent", {{"n1", std::nan("")}}}), "");
  EXPECT_EQ(message({"slip_sinkage", "", {{"n1", 0.2}}}), "");
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.mechanisms = {{"magic", "", {}}};
  EXPECT_THROW(WheelModel{spec}, InputError);
  EXPECT_THROW(WheelModel(wheel_specs::ishigami2007()).channels(60, motion_at(0, 0), {.pass = 0}),
               ValueError);
}

}  // namespace regoplan
