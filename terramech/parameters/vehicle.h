#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terramech/basics/value_range.h"
#include "terramech/parameters/wheel.h"

namespace regoplan {

/// A wheel on the vehicle. Vehicle frame: origin in the ground plane below the centre of gravity,
/// x forward, y left, z up along the normal of the ground plane.
struct WheelMount {
  std::string name;
  double x_m = 0;
  double y_m = 0;
  bool steered = false;
  bool driven = true;
};

enum class Suspension {
  kEqualSprings,  ///< rigid body on springs of equal stiffness at the wheels: rigid or independent
  kRockerBogie,   ///< six wheels: rocker to the front wheel, bogie with middle and rear wheels
};

/// Pivots of a rocker-bogie, along x from the vehicle's origin; the differential shares the
/// body's pitch moment equally between the sides.
struct RockerBogie {
  double rocker_pivot_x_m = 0;
  double bogie_pivot_x_m = 0;
};

enum class Steering {
  kAckermann,  ///< wheels steer about a turn centre on the line x = `turn_centre_x_m`: front,
               ///< double (front and rear) or all-wheel Ackermann, by which wheels are steered
  kCrab,       ///< the same with every wheel steered; a crab angle turns the direction of travel
  kSkid,       ///< no wheel steers; the rims of one side turn faster than those of the other
};

/// How driven wheels share the drive. Wheels that are not driven roll freely: no torque.
enum class DriveLaw {
  kKinematic,    ///< rim speeds are the slip-free kinematic ones times one common factor
  kEqualTorque,  ///< every driven wheel has the same torque (open differentials): their rim speeds
                 ///< keep the mean of the slip-free kinematic ones
  kEqualSpeed,   ///< every driven wheel has the same rim speed (locked differentials), the mean of
                 ///< the slip-free kinematic ones
};

/// The box that must stay clear of rocks and terrain, in the vehicle frame.
struct BodyBox {
  double x_min_m = 0, x_max_m = 0;
  double y_min_m = 0, y_max_m = 0;
  double clearance_m = 0;  ///< height of its underside
  double height_m = 0;     ///< from its underside to its top
};

/// A wheeled vehicle with equal rigid wheels.
struct Vehicle {
  std::string name;
  std::string source;
  double mass_kg = 0;
  double yaw_inertia_kgm2 = 0;
  double cg_height_m = 0;
  Wheel wheel;
  std::vector<WheelMount> wheels;
  Suspension suspension = Suspension::kEqualSprings;
  std::optional<RockerBogie> rocker_bogie;
  DriveLaw drive_law = DriveLaw::kKinematic;
  /// What each driven wheel can be given, either way; nothing: as much as it takes.
  std::optional<double> torque_max_nm = {};
  Steering steering = Steering::kAckermann;
  double turn_centre_x_m = 0;
  BodyBox body;

  double speed_max_mps = 0;
  double acceleration_max_mps2 = 0;    ///< of the commanded rim speed, driving and braking
  double curvature_max_1pm = 0;        ///< commanded path curvature, either side
  double curvature_rate_max_1pms = 0;  ///< how fast the steering changes it
  double steer_angle_max_rad = 0;      ///< mechanical range of each steered wheel, either side
  double slip_angle_max_rad = 0;
  double slip_max = 0.6;
  double sinkage_max_m = 0;
  double slope_max_rad = 0;
  double step_max_m = 0;  ///< rocks up to this height are driven over
};

/// What numbers of a vehicle may be. The lightest rovers weigh a quarter of a kilogram.
inline constexpr ValueRange kVehicleMass_kg{.min = 0.1, .max = 1e6};
inline constexpr ValueRange kVehicleYawInertia_kgm2{.min = 0, .max = 1e8, .min_excluded = true};
inline constexpr ValueRange kVehicleSpeed_mps{.min = 0, .max = 100, .min_excluded = true};
inline constexpr ValueRange kVehicleAcceleration_mps2{.min = 0, .max = 100, .min_excluded = true};

/// Checks every field, and what only fields together decide:
/// - three to `kMaxWheels` wheels with names of their own, not all on a line, the centre of gravity
///   within the polygon of their contacts, one of them driven;
/// - each steered wheel off the line of turn centres, its angle at `curvature_max_1pm`, either
///   side, at least 1 deg within `steer_angle_max_rad` (trim needs room to steer against slip);
/// - steering: some wheel steered for Ackermann, every one for crab, none for skid steering, whose
///   drive law is kinematic (rims of one speed or torque cannot steer);
/// - rocker-bogie: six wheels in three axles, each pivot between what it carries;
/// - rocks that are driven over pass below the body; the sinkage limit is below the axle.
/// \throws ValueError or InputError naming the field, as it stands in files, that cannot be
void validate(const Vehicle& vehicle);

/// Ackermann angle of a wheel, left positive, for slip-free rotation about the point
/// (x_c, y_c) of the vehicle frame, x_c = `turn_centre_x_m`, y_c = sign(k) sqrt(1/k^2 - x_c^2):
///   tan(angle) = (x - x_c) / (y_c - y) = k (x - x_c) / (sqrt(1 - k^2 x_c^2) - k y).
/// The second form is used: exact to rounding down to k = 0 and exactly odd under reflection
/// (k -> -k, y -> -y). Zero for a wheel that does not steer.
/// \param curvature_1pm k, signed curvature of the path of the vehicle's origin, left positive
/// \returns radians; beyond +-pi/2 where the turn centre lies between the wheels (no valid vehicle
/// commands that), NaN where |k x_c| > 1 (no such turn)
double steer_angle_rad(const Vehicle& vehicle, const WheelMount& wheel, double curvature_1pm);

/// Body slip angle of the origin, atan2(v_y, v_x), in the slip-free rotation of
/// `steer_angle_rad`: -asin(k x_c). Radians, odd in k, NaN where |k x_c| > 1.
double kinematic_body_slip_angle_rad(const Vehicle& vehicle, double curvature_1pm);

/// The largest curvature up to `curvature_max_1pm`, either side, at which every steered wheel stays
/// 1 deg within `steer_angle_max_rad`, as `validate` asks of the maximum itself. \returns 1/m, to
/// 1e-9 of the maximum
double steerable_curvature_1pm(const Vehicle& vehicle);

/// The vehicle told from another centre of gravity: wheels, turn centre, pivots and body stay where
/// they are and lie so much farther back, right and down from it. Its curvatures stay as they were,
/// though told of another point: `steerable_curvature_1pm` says whether it can still steer them.
Vehicle with_centre_moved(Vehicle vehicle, double forward_m, double left_m, double up_m);

/// Whether its centre of gravity is above the polygon of its wheels' contacts.
bool stands_on_wheels(const Vehicle& vehicle);

/// Distance of the outermost wheel from the vehicle's origin.
double longest_arm_m(const Vehicle& vehicle);

/// The vehicles that regoplan brings: `tohoku`, `lrv`, `curiosity`.
/// \throws InputError for another name, listing these
Vehicle preset_vehicle(const std::string& name);
std::vector<std::string> preset_vehicle_names();

}  // namespace regoplan
