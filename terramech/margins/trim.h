#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "terramech/parameters/vehicle.h"
#include "terramech/vehicle/steered_wheel.h"
#include "terramech/vehicle/wheel_loads.h"
#include "terramech/wheel/wheel_law.h"

namespace regoplan {

/// What the wheels' forces sum to, in the directions of the path: along the velocity (of a vehicle
/// that drives forward; against it in reverse) and to the left of that; in a turn on the spot along
/// the vehicle's heading and to its left.
struct PathForce {
  double forward_n = 0;
  double left_n = 0;
  double yaw_nm = 0;  ///< moment about the vehicle's origin, beside balance
};

/// A straight line of path forces, from + p per_unit.
struct ForceLine {
  PathForce from;
  PathForce per_unit;

  PathForce at(double p) const {
    return {.forward_n = from.forward_n + p * per_unit.forward_n,
            .left_n = from.left_n + p * per_unit.left_n,
            .yaw_nm = from.yaw_nm + p * per_unit.yaw_nm};
  }
};

/// A wheel in a trim.
struct TrimmedWheel {
  double load_n = 0;
  double steer_rad = 0;
  double slip = 0;
  double slip_angle_rad = 0;
  WheelMotion motion;  ///< at 1 m/s of the vehicle, or of its outermost wheel on the spot
  WheelForces forces;
};

/// A steady manoeuvre in balance: constant speed, path curvature and body slip angle.
struct Trim {
  PathForce force;
  double body_slip_angle_rad = 0;  ///< of the vehicle's origin, left positive; 0 on the spot
  double steer_curvature_1pm = 0;  ///< curvature that the steering is set for; 0 on the spot
  /// Rim speeds of driven wheels over the slip-free kinematic ones; under equal torque their mean.
  double drive_factor = 1;
  std::vector<TrimmedWheel> wheels;
};

/// The balance of the steady manoeuvres of one vehicle along one path curvature, with a given load
/// on the ground and each wheel on its own soil.
///
/// Unknowns: body slip angle; the curvature the steering is set for (with skid steering it sets how
/// much faster the rims of one side turn); and one for the drive: the factor of the slip-free
/// kinematic rim speeds, their common value under equal speed, the torque under equal torque.
/// Wheels that are not driven turn as fast as no torque has them turn. Equations: the wheels'
/// forces (fx, -fy), summed in the body frame and turned into the directions of the path, give the
/// path force; their yaw moment about the vehicle's origin vanishes, so that what a virtual side
/// force adds acts at the centre of gravity. Wheel forces depend on velocity ratios only: the
/// balance holds at any speed.
///
/// In a turn on the spot the body slip angle and the steering are no unknowns, because the wheels
/// are set; the velocity of the origin, forward and to the left, takes their place. Wheels that do
/// not steer are dragged sideways: the drive factor is what their scrub takes.
class SteadyManoeuvre {
 public:
  /// The unknowns and the position p on a line of path forces, each scaled to order one.
  using Point = Eigen::Vector4d;
  using Residual = Eigen::Vector3d;
  using Slopes = Eigen::Matrix<double, 3, 4>;

  /// \param vehicle, sharing, laws must outlive this; `laws` one for each wheel
  /// \param curvature_1pm commanded path curvature, left positive
  /// \param normal_n sum of the wheels' loads, above 0 \param reverse drives backwards
  /// \param crab_rad commanded crab angle
  SteadyManoeuvre(const Vehicle& vehicle, const LoadSharing& sharing,
                  std::span<const WheelLaw> laws, double curvature_1pm, double normal_n,
                  bool reverse = false, double crab_rad = 0);

  /// Turning on the spot. \pre `can_turn_on_the_spot(vehicle)`
  static SteadyManoeuvre turn_on_the_spot(const Vehicle& vehicle, const LoadSharing& sharing,
                                          std::span<const WheelLaw> laws, double normal_n,
                                          bool to_the_left);

  /// Missing path force along and across, over the normal load, and yaw moment, over load and
  /// length; nothing where a wheel has no load or no forces.
  std::optional<Residual> residual(const Point& at, const ForceLine& line) const;
  /// Slopes of the residual over the point; from the laws' own slopes where all have them and all
  /// rims turn at commanded speeds, else by differences.
  /// \param residual at the point, where known
  std::optional<Slopes> slopes(const Point& at, const ForceLine& line,
                               std::optional<Residual> residual = {}) const;

  /// The trim on the line at p nearest to a guess; nothing where Newton's method finds none.
  std::optional<Point> solve(const Point& guess, const ForceLine& line) const;

  /// The trim at line.from nearest to slip-free rolling, from a scan over the drive factor; nothing
  /// where the forward force or the yaw moment cannot be balanced.
  std::optional<Point> solve_from_rolling(const ForceLine& line) const;

  /// The deepest that a wheel sinks while all roll slip-free on the path, or its radius where it
  /// sinks to its axle, which no trim has.
  double rolling_sinkage_m(const ForceLine& line) const;

  /// What a point stands for.
  Trim trim(const Point& at, const ForceLine& line) const;

  double steer_curvature_1pm(const Point& at) const { return steering(at).curvature_1pm; }

  /// What one newton of drive beyond the trim does: pulls along the travel; in a turn on the spot
  /// it turns on the longest arm of a wheel.
  PathForce ahead() const;
  /// How much of that there is in a force.
  double ahead_n(const PathForce& force) const;

  const Vehicle& vehicle() const { return vehicle_; }
  double normal_n() const { return normal_n_; }
  double curvature_1pm() const { return curvature_1pm_; }

 private:
  BodyMotion body_motion(const Point& at) const;
  double rim_pace() const;
  SteeringCommand steering(const Point& at) const;
  Point rolling(double drive = 0) const;
  std::array<SteeredWheel, kMaxWheels> wheels(const Point& at) const;
  double rim_speed_mps(std::size_t wheel, const Point& at, const SteeredWheel& steered,
                       double load_n, const WheelMotion& motion) const;
  Slopes slopes_by_law(const Point& at, const ForceLine& line) const;
  GroundReaction reaction(const Point& at, const ForceLine& line) const;

  const Vehicle& vehicle_;
  const LoadSharing& sharing_;
  std::span<const WheelLaw> laws_;
  double curvature_1pm_;
  double normal_n_;
  double direction_;  ///< 1 forward or to the left, -1 in reverse or to the right
  double crab_rad_;
  bool on_the_spot_ = false;
  double length_m_;          ///< scale of steering and of the yaw moment
  bool rims_follow_ = true;  ///< every rim turns at the factor times its kinematic speed
  bool laws_have_slopes_ = true;
};

}  // namespace regoplan
