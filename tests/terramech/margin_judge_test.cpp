#include "terramech/margins/margin_judge.h"

#include <gtest/gtest.h>

#include <limits>

#include "terramech/basics/angles.h"
#include "tests/error_text.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

TEST(MarginJudge, RefusesLimitsThatAreNone) {
  const VehicleOnSoil on("lrv");
  const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{}, on.gravity_mps2);
  const StrainLimits sound{.slip_angle_max_rad = on.vehicle.slip_angle_max_rad,
                           .slip_max = on.vehicle.slip_max,
                           .sinkage_max_m = on.vehicle.sinkage_max_m};
  const auto refused = [&](const StrainLimits& strain) {
    const std::string text =
        error_text([&] { const MarginJudge no(dynamics, on.soil_laws, strain); });
    return text.substr(0, text.find_first_of(" :"));
  };
  EXPECT_EQ(refused(sound), "");
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  // The last as a limit in degrees that was taken for radians.
  for (const double nonsense : {kNaN, -0.1, 0.0, 16.0}) {
    StrainLimits strain = sound;
    strain.slip_angle_max_rad = nonsense;
    EXPECT_EQ(refused(strain), "slip_angle_max_deg");
    strain = sound;
    strain.slip_max = nonsense;
    EXPECT_EQ(refused(strain), "slip_max");
    if (nonsense > 0) continue;
    strain = sound;
    strain.sinkage_max_m = nonsense;
    EXPECT_EQ(refused(strain), "sinkage_max_m");
  }
  StrainLimits widest = sound;
  widest.slip_angle_max_rad = 60 * kDegree;
  EXPECT_EQ(refused(widest), "");
  EXPECT_NE(error_text([&] { const MarginJudge no(dynamics, std::span<const WheelLaw>(), sound); }),
            "");
}

}  // namespace
}  // namespace regoplan
