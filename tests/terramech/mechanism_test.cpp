// Laws of single mechanisms, and of all of them over the domain.
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

}  // namespace

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

TEST(Mechanism, ALoadCellOffByGainAndZeroIsTheLoadThatTheWheelHas) {
  const auto pair = named_soils::shipped_pairs().front();
  const double load_n = pair.nominal_load_n, added_n = -0.05 * load_n;
  const WheelForces off =
      with(pair.spec, "load_transfer", "affine", {{"share", 0.2}, {"added_n", added_n}})
          .forces(load_n, motion_at(0.3, 0.2));
  const WheelForces alone =
      WheelModel(pair.spec).forces(1.2 * load_n + added_n, motion_at(0.3, 0.2));
  EXPECT_NEAR(off.fx_n, alone.fx_n, 1e-4 * load_n);
  EXPECT_NEAR(off.sinkage_m, alone.sinkage_m, 1e-4 * alone.sinkage_m);
}

TEST(Mechanism, SoilThatABrakedWheelHasWeakenedHoldsLess) {
  for (const auto& pair : named_soils::shipped_pairs()) {
    const WheelMotion braked = motion_at(-0.5, 0);
    const WheelForces base = WheelModel(pair.spec).forces(pair.nominal_load_n, braked);
    const WheelForces weak =
        with(pair.spec, "skid_branch", "weakened", {{"weakening", 0.8}, {"sinkage", 0}})
            .forces(pair.nominal_load_n, braked);
    EXPECT_LT(std::abs(weak.torque_nm), 0.9 * std::abs(base.torque_nm)) << pair.name;
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
                                         {"slip_sinkage", "power", {}},
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

TEST(Mechanism, LugsDigAsTheyAreToldAndByHalfTheirHeightAtFullSlipElse) {
  const WheelMotion motion = motion_at(0.4, 0);
  for (const char* form : {"passive_pressure", "effective_radius", "soil_block"}) {
    const auto sinkage_m = [&](std::map<std::string, double> parameters) {
      parameters["lug_height_m"] = 0.01;
      return with(wheel_specs::ishigami2007(), "grousers", form, parameters)
          .forces(60, motion)
          .sinkage_m;
    };
    EXPECT_EQ(sinkage_m({}), sinkage_m({{"digging", 0.5}})) << form;
    EXPECT_NEAR(sinkage_m({{"digging", 1}}) - sinkage_m({{"digging", 0}}), 0.4 * 0.01, 1e-9)
        << form;
  }
}

TEST(Mechanism, SoilBetweenLugsGripsTheSoilBelowMoreThanASmoothRimDoes) {
  const WheelMotion motion = motion_at(0.4, 10 * kDegree);
  const auto forces = [&](double grip) {
    return with(wheel_specs::ishigami2007(), "grousers", "soil_block", {{"grip", grip}})
        .forces(60, motion);
  };
  EXPECT_GT(forces(0.3).fx_n, forces(0).fx_n);
  EXPECT_GT(forces(0.3).torque_nm, forces(0).torque_nm);
}

TEST(Mechanism, SoilBetweenLugsSlipsByTheCircleThatItShearsOn) {
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.soil.cohesion_pa = 0;
  constexpr double kHeight_m = 0.01, kShare = 0.8;
  const double circle = 1 + kShare * kHeight_m / spec.wheel.radius_m,
               slender = kHeight_m / spec.wheel.width_m,
               friction = 1 + 0.64 * slender * std::atan2(1, slender);
  const WheelModel block = with(spec, "grousers", "soil_block",
                                {{"lug_height_m", kHeight_m}, {"share", kShare}, {"digging", 0}});
  WheelModelSpec smooth = spec;
  smooth.soil.kx0_m /= circle;  // along a larger circle soil goes farther
  smooth.soil.kx1_m /= circle;
  for (const double slip : {0.1, 0.3, 0.6}) {
    const double of_rim = 1 - (1 - slip) * circle;
    const double smooth_nm = WheelModel(smooth).forces(60, motion_at(slip, 0)).torque_nm;
    // arc and arm are larger alike
    EXPECT_NEAR(block.forces(60, motion_at(of_rim, 0)).torque_nm,
                circle * circle * friction * smooth_nm, 0.05 * smooth_nm)
        << slip;
  }
}

TEST(Mechanism, SoilThatLugsHoldRoundAloneAddsNothingSideways) {
  const WheelModelSpec spec = wheel_specs::ishigami2007();
  const WheelMotion motion = motion_at(0.4, 20 * kDegree);
  const auto forces = [&](double held) {
    return with(spec, "grousers", "soil_block", {{"grip", 0.3}, {"held", held}}).forces(60, motion);
  };
  EXPECT_GT(forces(1).fy_n, forces(0.3).fy_n);
  EXPECT_GT(forces(0.3).fy_n, forces(0).fy_n);
  EXPECT_EQ(forces(1).fx_n, forces(0).fx_n);
  EXPECT_EQ(forces(1).sinkage_m, forces(0).sinkage_m);
}

TEST(Mechanism, SoilThatLugsHoldRoundAloneAddsNothingSidewaysUnderAnyLawOfShear) {
  const WheelMotion motion = motion_at(0.4, 20 * kDegree);
  for (const Mechanism& law :
       {Mechanism{"shear_hump", "wong", {}}, Mechanism{"layered_soil", "", {}},
        Mechanism{"rut_asymmetry", "", {}}, Mechanism{"coupled_shear", "within_limit", {}}}) {
    const auto fy_n = [&](double held) {
      WheelModelSpec spec = wheel_specs::ishigami2007();
      spec.mechanisms = {law, {"grousers", "soil_block", {{"grip", 0.3}, {"held", held}}}};
      return WheelModel(spec).forces(60, motion).fy_n;
    };
    EXPECT_GT(fy_n(1), fy_n(0)) << law.id;
  }
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
  EXPECT_NE(message({"rear_contact", "power", {{"p", -1}}}).find("0.4 to 10"), std::string::npos);
  EXPECT_EQ(message({"rear_contact", "power", {{"p", 0.4}}}), "");
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.mechanisms = {{"magic", "", {}}};
  EXPECT_THROW(WheelModel{spec}, InputError);
  EXPECT_THROW(WheelModel(wheel_specs::ishigami2007()).channels(60, motion_at(0, 0), {.pass = 0}),
               ValueError);
}

}  // namespace regoplan
