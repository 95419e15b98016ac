#include "terramech/parameters/vehicle.h"

#include <cmath>
#include <functional>
#include <limits>

#include "gtest/gtest.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

const WheelMount& wheel_named(const Vehicle& vehicle, const std::string& name) {
  for (const WheelMount& wheel : vehicle.wheels) {
    if (wheel.name == name) return wheel;
  }
  throw InputError("no wheel " + name);
}

/// What `validate` says of a preset that someone spoiled; empty where it is content.
std::string complaint(const std::string& preset, const std::function<void(Vehicle&)>& spoil) {
  Vehicle vehicle = preset_vehicle(preset);
  spoil(vehicle);
  try {
    validate(vehicle);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(VehiclePresets, AreValidAndNameTheirSource) {
  for (const std::string& name : preset_vehicle_names()) {
    const Vehicle vehicle = preset_vehicle(name);
    EXPECT_NO_THROW(validate(vehicle)) << name;
    EXPECT_EQ(vehicle.name, name);
    EXPECT_GT(vehicle.source.size(), 20u) << name;
  }
}

TEST(VehiclePresets, AnotherNameIsAnErrorThatListsThem) {
  try {
    preset_vehicle("lunokhod");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "vehicle: 'lunokhod' is no preset (presets: tohoku, lrv, curiosity)");
  }
}

TEST(VehiclePresets, TohokuHasTheWheelAndWheelLoadOfThePapers) {
  const Vehicle vehicle = preset_vehicle("tohoku");
  EXPECT_EQ(vehicle.wheel.radius_m, 0.09);
  EXPECT_EQ(vehicle.wheel.width_m, 0.10);
  EXPECT_NEAR(vehicle.mass_kg * 9.80665 / 4, 64.7, 0.05);
  for (const WheelMount& wheel : vehicle.wheels) EXPECT_TRUE(wheel.steered && wheel.driven);
}

TEST(VehiclePresets, LrvMatchesThePressKit) {
  const Vehicle vehicle = preset_vehicle("lrv");
  constexpr double kInch_m = 0.0254;
  const WheelMount& front = wheel_named(vehicle, "front_left");
  const WheelMount& rear = wheel_named(vehicle, "rear_left");
  EXPECT_NEAR(front.x_m - rear.x_m, 90 * kInch_m, 1e-3);
  EXPECT_NEAR(2 * front.y_m, 72 * kInch_m, 1e-3);
  EXPECT_NEAR(vehicle.mass_kg, (460 + 1080) * 0.45359237, 2);
  EXPECT_NEAR(vehicle.body.clearance_m, 14 * kInch_m, 1e-3);
  EXPECT_NEAR(vehicle.slope_max_rad, 25 * kDegree, 1e-12);
  EXPECT_GE(std::atan2(front.y_m, vehicle.cg_height_m), 45 * kDegree);
  EXPECT_GE(std::atan2(front.x_m, vehicle.cg_height_m), 45 * kDegree);
}

TEST(VehiclePresets, LrvTurnsItsOuterWheelsOnTenFeetWithTheTravelOfTheHandbook) {
  const Vehicle vehicle = preset_vehicle("lrv");
  const WheelMount& inner = wheel_named(vehicle, "front_left");
  const WheelMount& outer = wheel_named(vehicle, "front_right");
  const double lock_1pm = vehicle.curvature_max_1pm;
  EXPECT_NEAR(std::hypot(outer.x_m, 1 / lock_1pm - outer.y_m), 10 * 0.3048, 0.01);
  EXPECT_NEAR(steer_angle_rad(vehicle, inner, lock_1pm), 50 * kDegree, 1.5 * kDegree);
  EXPECT_NEAR(steer_angle_rad(vehicle, outer, lock_1pm), 22 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(2 * lock_1pm / vehicle.curvature_rate_max_1pms, 5.5, 1e-9);  // lock to lock, s
}

TEST(VehiclePresets, CuriosityMatchesThePressKit) {
  const Vehicle vehicle = preset_vehicle("curiosity");
  const WheelMount& front = wheel_named(vehicle, "front_left");
  const WheelMount& middle = wheel_named(vehicle, "middle_left");
  const WheelMount& rear = wheel_named(vehicle, "rear_left");
  EXPECT_EQ(vehicle.mass_kg, 899);
  EXPECT_NEAR(front.x_m - rear.x_m, 2.2, 0.1);
  EXPECT_NEAR(2 * middle.y_m + vehicle.wheel.width_m, 2.7, 0.1);
  EXPECT_FALSE(middle.steered);
  EXPECT_GE(std::atan2(front.y_m, vehicle.cg_height_m), 45 * kDegree);
  EXPECT_GE(std::atan2(front.x_m, vehicle.cg_height_m), 45 * kDegree);
}

TEST(VehiclePresets, CuriosityCouldTurnInPlace) {
  const Vehicle vehicle = preset_vehicle("curiosity");
  for (const WheelMount& wheel : vehicle.wheels) {
    if (!wheel.steered) continue;
    EXPECT_LT(std::atan2(std::abs(wheel.x_m - vehicle.turn_centre_x_m), std::abs(wheel.y_m)),
              vehicle.steer_angle_max_rad);
  }
}

TEST(SteerAngle, AllSteeredAxlesMeetInOnePointOnTheLineOfTurnCentres) {
  for (const std::string& name : preset_vehicle_names()) {
    const Vehicle vehicle = preset_vehicle(name);
    for (const double share : {-1.0, -0.5, -0.01, 0.01, 0.5, 1.0}) {
      const double k = share * vehicle.curvature_max_1pm;
      const double x_c = vehicle.turn_centre_x_m;
      const double y_c = std::copysign(std::sqrt(1 / (k * k) - x_c * x_c), k);
      EXPECT_NEAR(std::hypot(x_c, y_c), 1 / std::abs(k), 1e-9 / std::abs(k));
      for (const WheelMount& wheel : vehicle.wheels) {
        if (!wheel.steered) continue;
        const double angle_rad = steer_angle_rad(vehicle, wheel, k);
        // The axle is perpendicular to the heading, so the heading has no part along it.
        const double along_heading_m =
            (x_c - wheel.x_m) * std::cos(angle_rad) + (y_c - wheel.y_m) * std::sin(angle_rad);
        EXPECT_NEAR(along_heading_m, 0, 1e-12 / std::abs(k)) << name << " " << wheel.name;
      }
    }
  }
}

TEST(SteerAngle, LeftTurnSteersWheelsAheadToTheLeftAndWheelsBehindToTheRight) {
  for (const std::string& name : preset_vehicle_names()) {
    const Vehicle vehicle = preset_vehicle(name);
    for (const WheelMount& wheel : vehicle.wheels) {
      const double angle_rad = steer_angle_rad(vehicle, wheel, vehicle.curvature_max_1pm);
      if (!wheel.steered) {
        EXPECT_EQ(angle_rad, 0);
      } else {
        EXPECT_GT(angle_rad * (wheel.x_m - vehicle.turn_centre_x_m), 0);
      }
    }
  }
}

TEST(SteerAngle, IsExactlyOddUnderReflection) {
  Vehicle vehicle = preset_vehicle("curiosity");
  for (const double k : {1e-300, 1e-9, 0.013, 0.37, 0.5}) {
    for (const WheelMount& wheel : vehicle.wheels) {
      WheelMount mirrored = wheel;
      mirrored.y_m = -wheel.y_m;
      EXPECT_EQ(steer_angle_rad(vehicle, mirrored, -k), -steer_angle_rad(vehicle, wheel, k));
    }
    EXPECT_EQ(kinematic_body_slip_angle_rad(vehicle, -k),
              -kinematic_body_slip_angle_rad(vehicle, k));
  }
}

TEST(SteerAngle, ApproachesWheelbaseTimesCurvatureForFaintTurns) {
  const Vehicle vehicle = preset_vehicle("curiosity");
  for (const WheelMount& wheel : vehicle.wheels) {
    if (!wheel.steered) continue;
    EXPECT_EQ(steer_angle_rad(vehicle, wheel, 0), 0);
    for (const double k : {1e-300, 1e-20, 1e-12}) {
      EXPECT_NEAR(steer_angle_rad(vehicle, wheel, k) / k, wheel.x_m - vehicle.turn_centre_x_m,
                  1e-10);
    }
  }
}

TEST(SteerAngle, IsNotANumberWhereNoSuchTurnExists) {
  Vehicle vehicle = preset_vehicle("curiosity");
  vehicle.turn_centre_x_m = -1;
  EXPECT_TRUE(std::isnan(steer_angle_rad(vehicle, vehicle.wheels.front(), 1.01)));
  EXPECT_TRUE(std::isnan(kinematic_body_slip_angle_rad(vehicle, 1.01)));
}

TEST(KinematicBodySlipAngle, IsTheDirectionInWhichTheOriginMovesAboutTheTurnCentre) {
  Vehicle vehicle = preset_vehicle("curiosity");
  for (const double x_c : {-1.1, 0.0, 0.7}) {
    vehicle.turn_centre_x_m = x_c;
    for (const double k : {-0.5, -0.02, 0.02, 0.5}) {
      const double y_c = std::copysign(std::sqrt(1 / (k * k) - x_c * x_c), k);
      const double yaw_rate_rad_s = std::copysign(1, k);  // forward, so with the turn
      const double vx_mps = yaw_rate_rad_s * y_c;
      const double vy_mps = -yaw_rate_rad_s * x_c;
      EXPECT_NEAR(kinematic_body_slip_angle_rad(vehicle, k), std::atan2(vy_mps, vx_mps), 1e-14);
    }
  }
}

struct Spoiled {
  const char* what;
  const char* preset;
  std::function<void(Vehicle&)> spoil;
  const char* says;
};

TEST(ValidateVehicle, NamesTheFieldThatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Spoiled> cases{
      {"no name", "lrv", [](Vehicle& v) { v.name.clear(); }, "name:"},
      {"negative mass", "lrv", [](Vehicle& v) { v.mass_kg = -1; }, "mass_kg: -1"},
      {"lighter than any rover", "lrv", [](Vehicle& v) { v.mass_kg = 0.01; }, "mass_kg: 0.01"},
      {"mass not a number", "lrv", [=](Vehicle& v) { v.mass_kg = nan; }, "mass_kg: nan"},
      {"no inertia", "lrv", [](Vehicle& v) { v.yaw_inertia_kgm2 = 0; }, "yaw_inertia_kgm2: 0"},
      {"flat", "lrv", [](Vehicle& v) { v.cg_height_m = 0; }, "cg_height_m: 0"},
      {"no wheel radius", "lrv", [](Vehicle& v) { v.wheel.radius_m = 0; }, "wheel.radius_m: 0"},
      {"two wheels", "lrv", [](Vehicle& v) { v.wheels.resize(2); }, "wheels: 2"},
      {"nine wheels", "lrv",
       [](Vehicle& v) {
         for (char extra = 'a'; extra <= 'e'; ++extra) v.wheels.push_back({{extra}, 0.5, 0.5});
       },
       "wheels: 9"},
      {"wheel nowhere", "lrv", [=](Vehicle& v) { v.wheels[1].y_m = nan; },
       "wheels.front_right.y_m: nan"},
      {"nameless wheel", "lrv", [](Vehicle& v) { v.wheels[1].name.clear(); }, "no name"},
      {"same names", "lrv", [](Vehicle& v) { v.wheels[1].name = "rear_left"; },
       "2 wheels are named 'rear_left'"},
      {"on a line", "lrv",
       [](Vehicle& v) {
         for (WheelMount& w : v.wheels) w.y_m = 0;
       },
       "one line"},
      {"heavy nose", "lrv",
       [](Vehicle& v) {
         for (WheelMount& w : v.wheels) w.x_m -= 2;
       },
       "centre of gravity"},
      {"nothing driven", "lrv",
       [](Vehicle& v) {
         for (WheelMount& w : v.wheels) w.driven = false;
       },
       "none is driven"},
      {"pivots unused", "lrv", [](Vehicle& v) { v.rocker_bogie = RockerBogie{}; },
       "rocker_bogie: given"},
      {"pivots missing", "curiosity", [](Vehicle& v) { v.rocker_bogie.reset(); },
       "rocker_bogie: missing"},
      {"five wheels", "curiosity", [](Vehicle& v) { v.wheels.pop_back(); }, "wheels: 5"},
      {"no axles", "curiosity", [](Vehicle& v) { v.wheels[2].x_m += 0.2; }, "one axle"},
      {"one-sided axle", "curiosity", [](Vehicle& v) { v.wheels[3].y_m = 1.0; }, "one axle"},
      {"bogie pivot ahead", "curiosity", [](Vehicle& v) { v.rocker_bogie->bogie_pivot_x_m = 0.1; },
       "rocker_bogie.bogie_pivot_x_m"},
      {"rocker pivot behind", "curiosity",
       [](Vehicle& v) { v.rocker_bogie->rocker_pivot_x_m = -0.6; },
       "rocker_bogie.rocker_pivot_x_m"},
      {"body inside out", "lrv", [](Vehicle& v) { v.body.x_max_m = -2; }, "body.x_max_m: -2"},
      {"body without width", "lrv", [](Vehicle& v) { v.body.y_max_m = v.body.y_min_m; },
       "body.y_max_m"},
      {"no clearance", "lrv", [](Vehicle& v) { v.body.clearance_m = 0; }, "body.clearance_m: 0"},
      {"no height", "lrv", [](Vehicle& v) { v.body.height_m = 0; }, "body.height_m: 0"},
      {"no speed", "lrv", [](Vehicle& v) { v.speed_max_mps = 0; }, "speed_max_mps: 0"},
      {"no acceleration", "lrv", [](Vehicle& v) { v.acceleration_max_mps2 = 0; },
       "acceleration_max_mps2: 0"},
      {"no curvature", "lrv", [](Vehicle& v) { v.curvature_max_1pm = 0; }, "curvature_max_1pm: 0"},
      {"no steering rate", "lrv", [](Vehicle& v) { v.curvature_rate_max_1pms = 0; },
       "curvature_rate_max_1pms: 0"},
      {"no steering range", "lrv", [](Vehicle& v) { v.steer_angle_max_rad = 0; },
       "steer_angle_max_deg: 0"},
      {"tighter than it steers", "lrv", [](Vehicle& v) { v.curvature_max_1pm = 0.55; },
       "curvature_max_1pm: 0.55"},
      {"no room to steer against slip", "lrv",
       [](Vehicle& v) { v.steer_angle_max_rad = 49 * kDegree; }, "curvature_max_1pm"},
      {"turn centre between the wheels", "lrv", [](Vehicle& v) { v.curvature_max_1pm = 1.5; },
       "curvature_max_1pm: 1.5"},
      {"turn centre too far back", "curiosity", [](Vehicle& v) { v.turn_centre_x_m = -3; },
       "curvature_max_1pm: 0.5"},
      {"steered wheel on the turn-centre line", "curiosity",
       [](Vehicle& v) { v.wheels[2].steered = true; }, "wheels.middle_left.x_m"},
      {"slip angle not trusted", "lrv", [](Vehicle& v) { v.slip_angle_max_rad = 61 * kDegree; },
       "slip_angle_max_deg: 61"},
      {"slip not trusted", "lrv", [](Vehicle& v) { v.slip_max = 1; }, "slip_max: 1"},
      {"sunk to the axle", "lrv", [](Vehicle& v) { v.sinkage_max_m = 0.41; },
       "sinkage_max_m: 0.41"},
      {"no slope", "lrv", [](Vehicle& v) { v.slope_max_rad = 0; }, "slope_max_deg: 0"},
      {"step into the body", "lrv", [](Vehicle& v) { v.step_max_m = 0.4; }, "step_max_m: 0.4"},
  };
  for (const Spoiled& spoiled : cases) {
    const std::string said = complaint(spoiled.preset, spoiled.spoil);
    EXPECT_NE(said.find(spoiled.says), std::string::npos) << spoiled.what << ": '" << said << "'";
  }
}

TEST(ValidateVehicle, AcceptsASkidSteeredVehicle) {
  EXPECT_EQ(complaint("tohoku",
                      [](Vehicle& v) {
                        for (WheelMount& wheel : v.wheels) wheel.steered = false;
                        v.steer_angle_max_rad = 0;
                        v.steering = Steering::kSkid;
                      }),
            "");
}

TEST(ValidateVehicle, HoldsSteeringToItsWheels) {
  const auto skid = [](Vehicle& v) { v.steering = Steering::kSkid; };
  EXPECT_NE(complaint("tohoku", skid).find("steering: skid"), std::string::npos);
  const auto crab = [](Vehicle& v) { v.steering = Steering::kCrab; };
  EXPECT_EQ(complaint("tohoku", crab), "");
  EXPECT_NE(complaint("curiosity", crab).find("steering: crab"), std::string::npos);
  const auto unsteered = [](Vehicle& v) {
    for (WheelMount& wheel : v.wheels) wheel.steered = false;
  };
  EXPECT_NE(complaint("tohoku", unsteered).find("steering: no wheel"), std::string::npos);
  const auto weak = [](Vehicle& v) { v.torque_max_nm = 0; };
  EXPECT_NE(complaint("lrv", weak).find("torque_max_nm: 0"), std::string::npos);
}

}  // namespace
}  // namespace regoplan
