// The vehicles that regoplan brings. Every number is either cited - [n] refers to the list above
// its vehicle - or marked as an estimate, with the reasoning.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {
namespace {

/// Slip angles of the single-wheel tests that the wheel model was validated with reach 16 deg
/// (Yoshida & Ishigami 2004, Sec. V.A): the limit of every steered vehicle here.
constexpr double kTestedSlipAngle_rad = 16 * kDegree;

/// The share of the wheel radius that a wheel may sink: a convention of this program, for vehicles
/// whose sources give no limit.
constexpr double kSinkageShareOfRadius = 0.35;

/// Yaw inertia of a homogeneous box, the stand-in where no inertia is published.
constexpr double box_yaw_inertia_kgm2(double mass_kg, double length_m, double width_m) {
  return mass_kg * (length_m * length_m + width_m * width_m) / 12;
}

/// The four-wheel rover test bed of the Space Robotics Laboratory, Tohoku University.
/// [1] K. Yoshida, G. Ishigami, "Steering Characteristics of a Rigid Wheel for Exploration on Loose
///     Soil", IROS 2004: wheel r 0.09 m, b 0.10 m.
/// [2] G. Ishigami, A. Miwa, K. Nagatani, K. Yoshida, "Terramechanics-based Model for Steering
///     Maneuver of Planetary Exploration Rovers on Loose Soil", J. Field Robotics 24 (2007)
///     233-250: four wheels, each driven and steered; speeds of centimetres a second; the single
///     wheel is tested under 64.7 N (6.6 kg).
/// What [1] and [2] do not give is estimated for a test bed on such wheels.
Vehicle tohoku() {
  constexpr double kMass_kg = 26.4;          // four times the wheel load of 6.6 kg [2]
  constexpr double kHalfWheelbase_m = 0.30;  // estimate: room for four steered 0.18 m wheels
  constexpr double kHalfTread_m = 0.20;      // estimate: wheelbase to tread 3 to 2
  const Wheel wheel{.radius_m = 0.09, .width_m = 0.10};  // [1]
  return {
      .name = "tohoku",
      .source =
          "four-wheel rover test bed, Tohoku University: Yoshida & Ishigami 2004 (wheel), "
          "Ishigami et al. 2007, J. Field Robotics 24 (layout, wheel load); dimensions, "
          "centre of gravity, inertia and limits estimated",
      .mass_kg = kMass_kg,
      .yaw_inertia_kgm2 = box_yaw_inertia_kgm2(kMass_kg, 0.78, 0.50),  // estimate: over its wheels
      .cg_height_m = 0.20,  // estimate: electronics box just above the wheels
      .wheel = wheel,
      .wheels = {{"front_left", kHalfWheelbase_m, kHalfTread_m, true},
                 {"front_right", kHalfWheelbase_m, -kHalfTread_m, true},
                 {"rear_left", -kHalfWheelbase_m, kHalfTread_m, true},
                 {"rear_right", -kHalfWheelbase_m, -kHalfTread_m, true}},  // all steered [2]
      .suspension = Suspension::kEqualSprings,  // estimate: the body rests on its four wheels alike
      .rocker_bogie = {},
      .drive_law = DriveLaw::kKinematic,  // a motor in each wheel [2]
      .turn_centre_x_m = 0,               // front and rear steer alike
      .body = {.x_min_m = -0.39,          // estimate: over its wheels
               .x_max_m = 0.39,
               .y_min_m = -0.25,
               .y_max_m = 0.25,
               .clearance_m = 0.12,            // estimate
               .height_m = 0.25},              // estimate
      .speed_max_mps = 0.05,                   // centimetres a second [2]
      .acceleration_max_mps2 = 0.05,           // estimate: full speed within a second
      .curvature_max_1pm = 1 / 0.6,            // estimate: inner wheels at 37 deg
      .curvature_rate_max_1pms = 2 / 0.6 / 5,  // estimate: lock to lock in 5 s
      .steer_angle_max_rad = 45 * kDegree,     // estimate
      .slip_angle_max_rad = kTestedSlipAngle_rad,
      .slip_max = 0.6,  // lateral force falls fast beyond (Sec. IV.D of [1])
      .sinkage_max_m = kSinkageShareOfRadius * wheel.radius_m,
      .slope_max_rad = 20 * kDegree,  // estimate: loose simulant gives way beyond
      .step_max_m = 0.045,            // estimate: half a wheel radius
  };
}

/// The Apollo Lunar Roving Vehicle, loaded, and vehicles of its class.
/// [1] Boeing, "Lunar Roving Vehicle Operations Handbook", LS006-002-2H, 1971.
/// [2] NASA, "Apollo 15 Press Kit", release 71-119K, 1971: LRV 210 kg (460 lb), payload 490 kg
///     (1080 lb); 3.10 m (122 in) long; wheelbase 2.286 m (90 in); tread 1.829 m (72 in); clearance
///     0.356 m (14 in) loaded; turning radius 3.05 m (10 ft); 0.25 hp motor in each wheel;
///     obstacles 0.3 m (12 in); slopes 25 deg; stable to 45 deg in pitch and roll, loaded.
/// [3] V. Asnani, D. Delap, C. Creager, "The Development of Wheels for the Lunar Roving Vehicle",
///     NASA/TM-2009-215798: wheel 0.818 m x 0.23 m.
/// A rigid wheel of that size stands in for the wire mesh wheel, which flattens under load: the
/// real one has a longer contact, sinks less and pulls more.
Vehicle lrv() {
  constexpr double kMass_kg = 700;            // 210 + 490 [2]
  constexpr double kHalfWheelbase_m = 1.143;  // [2]
  constexpr double kHalfTread_m = 0.9145;     // [2]
  // The 3.05 m of [2] is the circle of the outer wheels: with it, double Ackermann steering needs
  // 48.9 deg at the inner and 22.0 deg at the outer wheels, the travel of 50 and 22 deg of [1].
  // The middle of the vehicle then turns on sqrt(3.05^2 - 1.143^2) - 0.9145 = 1.913 m.
  constexpr double kCurvatureMax_1pm = 1 / 1.9132;
  const Wheel wheel{.radius_m = 0.409, .width_m = 0.23};  // [3]
  return {
      .name = "lrv",
      .source =
          "Apollo Lunar Roving Vehicle, loaded, on rigid wheels: Boeing LRV Operations "
          "Handbook LS006-002-2H (1971), NASA Apollo 15 Press Kit (1971), NASA/TM-2009-215798 "
          "(wheels); centre of gravity, inertia and acceleration estimated",
      .mass_kg = kMass_kg,
      // Estimate: the box that the loaded vehicle fills.
      .yaw_inertia_kgm2 = box_yaw_inertia_kgm2(kMass_kg, 3.10, 2.06),
      // Estimate: 210 kg of chassis at 0.5 m, two astronauts with life support of 363 kg at 1.0 m,
      // 127 kg of load at 0.7 m. It topples sideways at 49 deg; [2] asks for 45.
      .cg_height_m = 0.80,
      .wheel = wheel,
      // Estimate: the seats stand amidships, so the centre of gravity is taken halfway.
      .wheels = {{"front_left", kHalfWheelbase_m, kHalfTread_m, true},
                 {"front_right", kHalfWheelbase_m, -kHalfTread_m, true},
                 {"rear_left", -kHalfWheelbase_m, kHalfTread_m, true},
                 {"rear_right", -kHalfWheelbase_m, -kHalfTread_m, true}},
      .suspension = Suspension::kEqualSprings,  // equal torsion bars at every wheel [1]
      .rocker_bogie = {},
      // Four motors on one command [1]: between equal speed and equal torque.
      .drive_law = DriveLaw::kKinematic,
      .turn_centre_x_m = 0,       // front and rear steer alike [1]
      .body = {.x_min_m = -1.55,  // [2]
               .x_max_m = 1.55,   // [2]
               .y_min_m = -1.03,  // over its wheels [2] [3]
               .y_max_m = 1.03,
               .clearance_m = 0.356,  // [2]
               .height_m = 1.64},     // estimate: seated astronauts reach 2.0 m
      // 13 km/h (3.6 m/s) by design [2], 18 km/h (5.0 m/s) reached on Apollo 17.
      .speed_max_mps = 5.0,
      // What four motors of 186 W [2] give 700 kg at 3.6 m/s: 0.3 m/s2, less than a fifth of the
      // weight on the Moon; lunar soil gives half of it. Brakes do more; not used.
      .acceleration_max_mps2 = 0.3,
      .curvature_max_1pm = kCurvatureMax_1pm,
      .curvature_rate_max_1pms = 2 * kCurvatureMax_1pm / 5.5,  // lock to lock in 5.5 s [1]
      .steer_angle_max_rad = 50 * kDegree,                     // inner wheel [1]
      .slip_angle_max_rad = kTestedSlipAngle_rad,
      .slip_max = 0.6,  // lateral force falls fast beyond (Yoshida & Ishigami 2004)
      .sinkage_max_m = kSinkageShareOfRadius * wheel.radius_m,
      .slope_max_rad = 25 * kDegree,  // [2]
      .step_max_m = 0.30,             // [2]
  };
}

/// The Mars Science Laboratory rover Curiosity, and rovers of its class.
/// [1] NASA, "Mars Science Laboratory Landing Press Kit", 2012: 899 kg; 3.0 m long without arm,
///     2.7 m wide, 2.2 m tall; wheels 0.50 m across; six driven, four corner wheels steered; top
///     speed on flat hard ground 4 cm/s (1.5 in/s); rolls over obstacles of 0.5 m (20 in); stable
///     to 45 deg in any direction, kept below 30 deg by tilt limits.
/// [2] NASA/JPL image release "Next NASA Mars Rover Gets Its Wheels", February 2009: ground
///     clearance 0.60 m, wheelbase 2.2 m.
/// [3] Project Chrono, model of the Curiosity rover (src/chrono_models/robot/curiosity): axles at
///     x = 1.095, -0.089, -1.163 m, wheels at y = 1.063 m (corners), 1.194 m (middle), bogie pivot
///     at x = -0.54 m, rocker pivot at x = 0.214 m; agrees with [1] and [2] within 0.1 m.
/// [4] R. Arvidson et al., "Mars Science Laboratory Curiosity Rover Megaripple Crossings up to Sol
///     710 in Gale Crater", J. Field Robotics 34 (2017): wheels 0.50 m x 0.40 m; sinkage to 30 % of
///     the diameter, slip to 77 %, at the worst crossings.
Vehicle curiosity() {
  constexpr double kMass_kg = 899;      // [1]
  constexpr double kFront_x_m = 1.095;  // [3], as is what follows
  constexpr double kMiddle_x_m = -0.089;
  constexpr double kRear_x_m = -1.163;
  constexpr double kCorner_y_m = 1.063;
  constexpr double kMiddle_y_m = 1.194;
  // Estimate: it turns in place, but driving arcs are planned no tighter than 2 m.
  constexpr double kCurvatureMax_1pm = 0.5;
  const Wheel wheel{.radius_m = 0.25, .width_m = 0.40};  // [1] [4]
  return {
      .name = "curiosity",
      .source =
          "Mars Science Laboratory rover Curiosity: NASA MSL Landing Press Kit (2012), JPL "
          "release of February 2009 (wheelbase, clearance), Project Chrono model (axles, "
          "pivots), Arvidson et al. 2017, J. Field Robotics 34 (wheels); centre of gravity, "
          "inertia, steering range and rates estimated",
      .mass_kg = kMass_kg,
      .yaw_inertia_kgm2 = box_yaw_inertia_kgm2(kMass_kg, 3.0, 2.7),  // estimate: box of [1]
      // Estimate: two thirds of the mass in a body from 0.66 to 1.1 m, a quarter in suspension and
      // wheels around 0.45 m, a tenth in mast, arm and power source around 1.3 m. It topples
      // sideways at 53 deg; [1] says at 45 or more.
      .cg_height_m = 0.80,
      .wheel = wheel,
      // Estimate: centre of gravity at the reference point of [3], so that the front wheels carry a
      // third of the weight; the geometry then puts 39 % on the middle and 28 % on the rear.
      .wheels = {{"front_left", kFront_x_m, kCorner_y_m, true},
                 {"front_right", kFront_x_m, -kCorner_y_m, true},
                 {"middle_left", kMiddle_x_m, kMiddle_y_m, false},
                 {"middle_right", kMiddle_x_m, -kMiddle_y_m, false},
                 {"rear_left", kRear_x_m, kCorner_y_m, true},
                 {"rear_right", kRear_x_m, -kCorner_y_m, true}},                         // [1]
      .suspension = Suspension::kRockerBogie,                                            // [1]
      .rocker_bogie = RockerBogie{.rocker_pivot_x_m = 0.214, .bogie_pivot_x_m = -0.54},  // [3]
      .drive_law = DriveLaw::kKinematic,  // each wheel is driven at its Ackermann speed
      .turn_centre_x_m = kMiddle_x_m,     // where the wheels that do not steer roll true
      .body = {.x_min_m = -1.5,           // [1]
               .x_max_m = 1.5,
               .y_min_m = -1.39,  // over its wheels [3] [4]
               .y_max_m = 1.39,
               .clearance_m = 0.60,   // [2]
               .height_m = 1.60},     // to the 2.2 m of [1]
      .speed_max_mps = 0.04,          // [1]
      .acceleration_max_mps2 = 0.02,  // estimate: full speed within 2 s
      .curvature_max_1pm = kCurvatureMax_1pm,
      .curvature_rate_max_1pms = kCurvatureMax_1pm / 15,  // estimate: about 3.5 deg/s at the wheels
      // Estimate: turning in place [1] needs 48 deg, an arc of 2 m 52 deg.
      .steer_angle_max_rad = 60 * kDegree,
      .slip_angle_max_rad = kTestedSlipAngle_rad,
      .slip_max = 0.6,  // estimate: well below the 77 % of the worst crossings [4]
      .sinkage_max_m = kSinkageShareOfRadius * wheel.radius_m,
      .slope_max_rad = 30 * kDegree,  // tilt limit [1]
      .step_max_m = 0.50,             // [1]
  };
}

}  // namespace

std::vector<std::string> preset_vehicle_names() {
  return {"tohoku", "lrv", "curiosity"};
}

Vehicle preset_vehicle(const std::string& name) {
  if (name == "tohoku") return tohoku();
  if (name == "lrv") return lrv();
  if (name == "curiosity") return curiosity();
  throw InputError(fmt::format("vehicle: '{}' is no preset (presets: {})", name,
                               fmt::join(preset_vehicle_names(), ", ")));
}

}  // namespace regoplan
