#include "terramech/vehicle/wheel_loads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

std::vector<Vehicle> every_vehicle() {
  std::vector<Vehicle> vehicles{tricycle()};
  for (const std::string& name : preset_vehicle_names()) vehicles.push_back(preset_vehicle(name));
  return vehicles;
}

TEST(WheelLoads, BalanceForceAndBothMomentsForEveryVehicle) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  for (const Vehicle& vehicle : every_vehicle()) {
    const LoadSharing sharing(vehicle);
    const double h = vehicle.cg_height_m;
    for (int i = 0; i < 20; ++i) {
      const GroundReaction reaction{
          .normal_n = 1000, .forward_n = 1000 * share(random), .left_n = 1000 * share(random)};
      const std::vector<double> loads = sharing.loads_n(reaction);
      double sum = 0, sum_x = 0, sum_y = 0;
      for (std::size_t k = 0; k < loads.size(); ++k) {
        EXPECT_EQ(loads[k], sharing.load_n(k, reaction));
        sum += loads[k];
        sum_x += loads[k] * vehicle.wheels[k].x_m;
        sum_y += loads[k] * vehicle.wheels[k].y_m;
      }
      EXPECT_NEAR(sum, reaction.normal_n, 1e-9) << vehicle.name;
      EXPECT_NEAR(sum_x, -h * reaction.forward_n, 1e-9) << vehicle.name;
      EXPECT_NEAR(sum_y, -h * reaction.left_n, 1e-9) << vehicle.name;
    }
  }
}

TEST(WheelLoads, FourWheelsOnASlopeTransferByHeightOverWheelbase) {
  const Vehicle lrv = preset_vehicle("lrv");
  const double weight = lrv.mass_kg * kMoon_mps2, slope = 15 * kDegree;
  // Up the slope the wheels push forward against gravity.
  const std::vector<double> loads = LoadSharing(lrv).loads_n(
      {.normal_n = weight * std::cos(slope), .forward_n = weight * std::sin(slope), .left_n = 0});
  const double quarter = weight * std::cos(slope) / 4;
  const double transfer = weight * std::sin(slope) * lrv.cg_height_m / (2 * 1.143) / 2;
  EXPECT_NEAR(loads[0], quarter - transfer, 1e-9);
  EXPECT_NEAR(loads[1], quarter - transfer, 1e-9);
  EXPECT_NEAR(loads[2], quarter + transfer, 1e-9);
  EXPECT_NEAR(loads[3], quarter + transfer, 1e-9);
}

TEST(WheelLoads, ALeftTurnLoadsTheRightWheels) {
  const Vehicle lrv = preset_vehicle("lrv");
  const double weight = lrv.mass_kg * kMoon_mps2, centripetal = 0.3 * weight;
  const std::vector<double> loads =
      LoadSharing(lrv).loads_n({.normal_n = weight, .forward_n = 0, .left_n = centripetal});
  const double transfer = centripetal * lrv.cg_height_m / (2 * 0.9145) / 2;
  EXPECT_NEAR(loads[0], weight / 4 - transfer, 1e-9);
  EXPECT_NEAR(loads[1], weight / 4 + transfer, 1e-9);
}

TEST(WheelLoads, ThreeWheelsAreStaticallyDeterminate) {
  const Vehicle vehicle = tricycle();
  const std::vector<double> loads =
      LoadSharing(vehicle).loads_n({.normal_n = 900, .forward_n = 90, .left_n = 45});
  const double h = vehicle.cg_height_m;
  const double front = (900 * 0.7 - h * 90) / 2.1;
  const double roll = h * 45 / 0.9 / 2;
  EXPECT_NEAR(loads[0], front, 1e-9);
  EXPECT_NEAR(loads[1], (900 - front) / 2 - roll, 1e-9);
  EXPECT_NEAR(loads[2], (900 - front) / 2 + roll, 1e-9);
}

TEST(WheelLoads, ABogieSharesByItsLeversWhateverTheReaction) {
  const Vehicle vehicle = preset_vehicle("curiosity");
  const LoadSharing sharing(vehicle);
  const double pivot = vehicle.rocker_bogie->bogie_pivot_x_m;
  for (const GroundReaction& reaction : {GroundReaction{3000, 0, 0}, GroundReaction{3000, 500, 0},
                                         GroundReaction{3000, -300, 700}}) {
    const std::vector<double> loads = sharing.loads_n(reaction);
    for (const std::size_t side : {0u, 1u}) {
      EXPECT_NEAR(loads[2 + side] * (vehicle.wheels[2].x_m - pivot),
                  loads[4 + side] * (pivot - vehicle.wheels[4].x_m), 1e-9);
    }
  }
}

TEST(WheelLoads, TheDifferentialGivesBothRockersTheSameMoment) {
  const Vehicle vehicle = preset_vehicle("curiosity");
  const std::vector<double> loads =
      LoadSharing(vehicle).loads_n({.normal_n = 3000, .forward_n = 400, .left_n = 600});
  double left = 0, right = 0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    (vehicle.wheels[i].y_m > 0 ? left : right) +=
        loads[i] * (vehicle.wheels[i].x_m - vehicle.rocker_bogie->rocker_pivot_x_m);
  }
  EXPECT_NEAR(left, right, 1e-9);
}

TEST(WheelLoads, ARigidVehicleOnSixWheelsStandsOnAPlaneOfLoads) {
  Vehicle vehicle = preset_vehicle("curiosity");
  vehicle.suspension = Suspension::kEqualSprings;
  vehicle.rocker_bogie.reset();
  const std::vector<double> loads =
      LoadSharing(vehicle).loads_n({.normal_n = 3000, .forward_n = 100, .left_n = -200});
  // Springs of a rigid body: linear in position, so opposite differences over the track agree.
  const double per_metre = (loads[0] - loads[1]) / (2 * vehicle.wheels[0].y_m);
  EXPECT_NEAR((loads[2] - loads[3]) / (2 * vehicle.wheels[2].y_m), per_metre, 1e-9);
  EXPECT_NEAR((loads[4] - loads[5]) / (2 * vehicle.wheels[4].y_m), per_metre, 1e-9);
}

}  // namespace
}  // namespace regoplan
