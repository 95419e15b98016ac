// What the numbers of mechanisms can be: a wheel is one for all of it, and beyond is an error.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "terramech/basics/input_error.h"
#include "terramech/mechanisms/mechanism.h"
#include "terramech/wheel/wheel_model.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

constexpr double kLoad_n = 60;

WheelModel with(const MechanismForm& form, const MechanismParameter& parameter, double value) {
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.mechanisms = {
      {std::string(form.id), std::string(form.form), {{std::string(parameter.name), value}}}};
  return WheelModel(spec);
}

/// Gravity may push sideways.
bool resists_sideways(const MechanismForm& form) {
  return form.id != "slope_tilt";
}

/// Loads and gravity are no friction; and where the rim is another than the one whose speed is
/// told, torque and speed are of two wheels.
bool takes_power_only(const MechanismForm& form) {
  constexpr std::array kOthers{"slope_tilt", "slip_scale", "load_transfer", "flexible_wheel",
                               "grousers"};
  return std::ranges::find(kOthers, form.id) == kOthers.end();
}

/// Forces of a wheel that stands are finite, and take power from wheel and drive together: none
/// pushes sideways with the motion.
void expect_a_wheel(const WheelModel& model, const MechanismForm& form, const std::string& where) {
  const WheelConditions late{
      .pass = 3, .speed_mps = 0.5, .position_m = 0.5, .time_s = 5e3, .wheel_angle_rad = 0.3};
  for (const double slip : {-1.0, -0.6, -0.2, 0.0, 0.1, 0.4, 0.85, 1.0}) {
    for (const double beta_deg : {0.0, 5.0, 25.0, 60.0, 89.0}) {
      const WheelMotion motion = motion_at(slip, beta_deg * kDegree);
      const WheelForces forces = model.channels(kLoad_n, motion, late).forces;
      if (!has_forces(forces.status)) continue;
      const std::string at = where + ", slip " + std::to_string(slip) + ", slip angle " +
                             std::to_string(beta_deg) + " deg";
      ASSERT_TRUE(std::isfinite(forces.fx_n) && std::isfinite(forces.fy_n) &&
                  std::isfinite(forces.torque_nm) && std::isfinite(forces.sinkage_m))
          << at;
      const double rim_rad_s = motion.rim_speed_mps / model.spec().wheel.radius_m;
      const double sideways_w = forces.fy_n * motion.vy_mps;
      const double lost_w = forces.torque_nm * rim_rad_s - forces.fx_n * motion.vx_mps + sideways_w;
      EXPECT_TRUE(!resists_sideways(form) || sideways_w >= -1e-9 * kLoad_n) << at;
      EXPECT_TRUE(!takes_power_only(form) || lost_w >= -1e-6 * kLoad_n) << at;
    }
  }
}

template <class Check>
void for_every_parameter(Check check) {
  for (const MechanismForm& form : mechanism_forms()) {
    for (const MechanismParameter& parameter : form.parameters) {
      check(
          form, parameter,
          std::string(form.id) + " " + std::string(form.form) + " " + std::string(parameter.name));
    }
  }
}

TEST(MechanismBounds, AreWiderThanWhatIsUsual) {
  for_every_parameter([](const MechanismForm&, const MechanismParameter& p, const auto& where) {
    EXPECT_LE(p.least, p.low) << where;
    EXPECT_LE(p.low, p.typical) << where;
    EXPECT_LE(p.typical, p.high) << where;
    EXPECT_LE(p.high, p.most) << where;
    EXPECT_TRUE(std::isfinite(p.least) && std::isfinite(p.most)) << where;
  });
}

TEST(MechanismBounds, WithinThemForcesAreFiniteAndTakePower) {
  for_every_parameter([](const MechanismForm& form, const MechanismParameter& p,
                         const std::string& where) {
    for (const double value : {p.least, p.low, (p.low + p.high) / 2, p.high, 3 * p.high, p.most}) {
      if (value > p.most) continue;
      expect_a_wheel(with(form, p, value), form, where + " = " + std::to_string(value));
    }
  });
}

TEST(MechanismBounds, BeyondThemIsAnErrorThatNamesThem) {
  for_every_parameter(
      [](const MechanismForm& form, const MechanismParameter& p, const std::string& where) {
        const double step = 1e-3 * (std::abs(p.least) + std::abs(p.most));
        for (const double value : {p.least - step, p.most + step, -1e300, 1e300,
                                   std::numeric_limits<double>::infinity(), std::nan("")}) {
          try {
            with(form, p, value);
            ADD_FAILURE() << where << " took " << value;
          } catch (const ValueError& refused) {
            EXPECT_EQ(refused.field(), p.name) << where;
            EXPECT_NE(refused.allowed().find(" to "), std::string::npos) << where;
          }
        }
      });
}

}  // namespace
}  // namespace regoplan
