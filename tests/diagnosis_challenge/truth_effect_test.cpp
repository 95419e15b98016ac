#include <gtest/gtest.h>

// Every truth is a bundle of signs over the channels, where it acts and where it must not.
#include <cmath>
#include <string>

#include "benchmarks/diagnosis/truth_effect.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan::challenge {
namespace {

/// Dry sand whose shear is mobilised at moderate slip.
TruthPhysics sand(const TruthConditions& at) {
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.soil.cohesion_pa = 150;
  spec.soil.lambda = 0.3;
  spec.soil.kx0_m = 0.004;
  spec.soil.ky0_m = 0.010;
  spec.soil.kx1_m = spec.soil.ky1_m = 0;
  return {.wheel = spec.wheel, .soil = spec.soil, .at = at};
}

struct Signs {
  std::string id;
  TruthConditions at;
  std::string fx, fy, torque, sinkage;  ///< "+", "-", "0" (not at all), "~" (little), "?" (open)
};

const std::vector<Signs>& signs() {
  static const std::vector<Signs> all{
      {"slip_sinkage", {.load_n = 60, .slip_ratio = .5}, "-", "0", "?", "+"},
      {"slip_sinkage", {.load_n = 60, .slip_ratio = -.3}, "0", "0", "0", "0"},
      {"lateral_digging",
       {.load_n = 60, .slip_ratio = .2, .slip_angle_rad = 20 * kDegree},
       "?",
       "+",
       "?",
       "+"},
      {"lateral_digging", {.load_n = 60, .slip_ratio = .2}, "0", "0", "0", "0"},
      {"rut_asymmetry",
       {.load_n = 120, .slip_ratio = .2, .slip_angle_rad = 16 * kDegree},
       "~",
       "?",
       "~",
       "~"},
      {"rut_asymmetry", {.load_n = 120, .slip_ratio = .2}, "0", "0", "0", "0"},
      {"shear_modulus_slip_angle",
       {.load_n = 60, .slip_ratio = .4, .slip_angle_rad = 25 * kDegree},
       "-",
       "-",
       "-",
       "?"},
      {"shear_modulus_slip_angle", {.load_n = 60, .slip_ratio = .4}, "0", "0", "0", "0"},
      {"coupled_shear",
       {.load_n = 60, .slip_ratio = .5, .slip_angle_rad = 30 * kDegree},
       "-",
       "-",
       "-",
       "?"},
      {"coupled_shear", {.load_n = 60, .slip_ratio = .3}, "0", "0", "0", "0"},
      {"grousers", {.load_n = 60, .slip_ratio = .4}, "+", "0", "+", "+"},
      {"grousers", {.load_n = 60, .slip_ratio = -.3}, "0", "0", "0", "0"},
      {"side_pileup",
       {.load_n = 120, .slip_ratio = .2, .slip_angle_rad = 20 * kDegree},
       "0",
       "+",
       "0",
       "0"},
      {"side_pileup", {.load_n = 120, .slip_ratio = .2}, "0", "0", "0", "0"},
      {"front_bulldozing", {.load_n = 60, .slip_ratio = .3}, "-", "0", "0", "0"},
      {"front_bulldozing", {.load_n = 60, .slip_ratio = -.3}, "-", "0", "0", "0"},
      {"rear_contact", {.load_n = 60, .slip_ratio = .5}, "?", "0", "?", "-"},
      {"rear_contact", {.load_n = 60, .slip_ratio = 0}, "0", "0", "0", "0"},
      {"max_stress_angle", {.load_n = 60, .slip_ratio = .2}, "0", "0", "0", "0"},
      {"skid_branch", {.load_n = 60, .slip_ratio = -.5}, "?", "0", "?", "+"},
      {"skid_branch",
       {.load_n = 60, .slip_ratio = .3, .slip_angle_rad = 20 * kDegree},
       "0",
       "0",
       "0",
       "0"},
      {"multi_pass", {.load_n = 60, .slip_ratio = .3, .pass = 3}, "+", "0", "?", "-"},
      {"multi_pass", {.load_n = 60, .slip_ratio = .3, .pass = 1}, "0", "0", "0", "0"},
      {"rate_dependence", {.load_n = 60, .slip_ratio = .3, .speed_mps = 1e-9}, "~", "0", "~", "~"},
      {"rate_dependence", {.load_n = 60, .slip_ratio = .3, .speed_mps = .5}, "+", "0", "?", "-"},
      {"layered_soil", {.load_n = 150, .slip_ratio = .2}, "?", "0", "?", "-"},
      {"soil_zone", {.load_n = 60, .slip_ratio = .3, .position_m = 0}, "~", "0", "~", "~"},
      {"cohesion_drift", {.load_n = 5, .slip_ratio = .5, .time_s = 38000}, "-", "0", "-", "?"},
      {"flexible_wheel", {.load_n = 120, .slip_ratio = .2}, "?", "0", "?", "-"},
      {"sidewall_shear", {.load_n = 120, .slip_ratio = .3}, "0", "0", "+", "0"},
      {"bearing_drag", {.load_n = 60, .slip_ratio = .3}, "0", "0", "+", "0"},
      {"load_transfer",
       {.load_n = 60, .slip_ratio = .3, .slip_angle_rad = 10 * kDegree},
       "+",
       "+",
       "+",
       "+"},
  };
  return all;
}

/// Change of a channel against what is little: .1 % of its scale.
void expect_sign(double change, double scale, const std::string& sign, const std::string& where) {
  constexpr double kLittle = 0.001;
  if (sign == "+") {
    EXPECT_GT(change, kLittle * scale) << where;
  }
  if (sign == "-") {
    EXPECT_LT(change, -kLittle * scale) << where;
  }
  if (sign == "0") {
    EXPECT_NEAR(change, 0, 1e-9 * scale) << where;
  }
  if (sign == "~") {
    EXPECT_NEAR(change, 0, 0.06 * scale) << where;
  }
}

void expect_bundle(const TruthEffect& effect, const Signs& bundle) {
  const TruthPhysics physics = sand(bundle.at);
  const auto base = truth_channels(physics);
  const auto changed = channels_with({{&effect, (effect.low + effect.high) / 2, 0.5}}, physics);
  ASSERT_TRUE(base && changed) << effect.id << " " << effect.form;
  const std::string where = std::string(effect.id) + " " + std::string(effect.form) + " at slip " +
                            std::to_string(bundle.at.slip_ratio) + ": ";
  const double load = bundle.at.load_n;
  expect_sign(changed->fx_n - base->fx_n, load, bundle.fx, where + "fx");
  expect_sign(changed->fy_n - base->fy_n, load, bundle.fy, where + "fy");
  expect_sign(changed->torque_nm - base->torque_nm, load * physics.wheel.radius_m, bundle.torque,
              where + "torque");
  expect_sign(changed->sinkage_m - base->sinkage_m, base->sinkage_m, bundle.sinkage,
              where + "sinkage");
}

TEST(TruthEffect, IsTheBundleOfSignsOfItsName) {
  for (const TruthEffect& effect : listed_effects()) {
    for (const Signs& bundle : signs()) {
      if (bundle.id == effect.id) expect_bundle(effect, bundle);
    }
  }
}

TEST(TruthEffect, RutAsymmetryShowsInTheEdgesOfTheRut) {
  for (const TruthEffect& effect : listed_effects()) {
    if (effect.id != "rut_asymmetry") continue;
    const TruthPhysics p = sand({.load_n = 60, .slip_ratio = .2, .slip_angle_rad = 16 * kDegree});
    const auto c = channels_with({{&effect, effect.high, 0.5}}, p);
    ASSERT_TRUE(c);
    EXPECT_GT(c->rut_right_m - c->rut_left_m, 0.3 * c->sinkage_m) << effect.form;
  }
}

TEST(TruthEffect, DoesNothingAtZeroAmplitude) {
  for (const auto* list : {&listed_effects(), &unlisted_effects()}) {
    for (const TruthEffect& effect : *list) {
      const TruthPhysics p = sand({.load_n = 60,
                                   .slip_ratio = .3,
                                   .slip_angle_rad = 12 * kDegree,
                                   .pass = 2,
                                   .speed_mps = .1,
                                   .position_m = 1,
                                   .time_s = 9000});
      const auto base = truth_channels(p), same = channels_with({{&effect, 1e-20, 0.5}}, p);
      ASSERT_TRUE(base && same);
      EXPECT_NEAR(same->fx_n, base->fx_n, 1e-6) << effect.id << " " << effect.form;
      EXPECT_NEAR(same->fy_n, base->fy_n, 1e-6) << effect.id << " " << effect.form;
      EXPECT_NEAR(same->torque_nm, base->torque_nm, 1e-6) << effect.id << " " << effect.form;
      EXPECT_NEAR(same->sinkage_m, base->sinkage_m, 1e-8) << effect.id << " " << effect.form;
    }
  }
}

TEST(TruthEffect, IsNoFormThatTheMechanismsCarry) {
  for (const TruthEffect& effect : listed_effects()) {
    bool known = false;
    for (const MechanismForm& form : mechanism_forms()) {
      known = known || form.id == effect.id;
      EXPECT_FALSE(form.id == effect.id && form.form == effect.form) << effect.id << effect.form;
    }
    EXPECT_TRUE(known) << effect.id << " is no name of the vocabulary";
  }
  for (const TruthEffect& effect : unlisted_effects()) {
    for (const MechanismForm& form : mechanism_forms()) EXPECT_NE(form.id, effect.id);
  }
}

}  // namespace
}  // namespace regoplan::challenge
