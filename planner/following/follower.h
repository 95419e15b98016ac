#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/following/braking_in_time.h"
#include "planner/following/reference_path.h"
#include "planner/problem/world.h"

namespace regoplan {

/// The feedback of every follower:
///   commanded curvature = curvature of the path a reaction length ahead
///                         - offset / L^2 - 2 damping (course - heading of the path) / L
/// (in reverse, what the vehicle is told has the other sign) with the offset to the left of the
/// nearest place of the path, the course that of the velocity, and L the longer of
/// `lookahead_wheelbases` wheelbases and the way of `lookahead_s`. Rim speed: the path's speed over
/// the ratio of speed and rim speed that the wheels have lately had, and no more than what the rims
/// still come down from in time.
struct SteeringLaw {
  double lookahead_wheelbases = 1;
  double lookahead_s = 0.8;
  double damping = 1;
  double reaction_s = 0.1;  ///< besides the vehicle's own rate of steering
  double slip_memory_s = 1;
};

/// How a path is followed.
enum class FollowerKind {
  kPursuit,      ///< nothing is known of the ground: the curvature that is commanded is the path's
  kCompensated,  ///< what the trims of the planner's model need there is commanded
  kOwn,          ///< what a function of the caller commands
};

/// As it stands in files: `pursuit`, `compensated`, `own`.
std::string_view name(FollowerKind kind);
/// Those that can be asked for by their name: all but `own`.
std::vector<std::string_view> follower_names();
/// \returns `compensated` where no name is given \throws InputError for a name that is none of them
FollowerKind follower_named(const std::optional<std::string>& name);

/// What a follower of the caller's own is told before each step.
struct FollowerView {
  double time_s = 0;
  VehicleState seen;              ///< where the vehicle seems to be, its motion, what it was told
  double s_m = 0;                 ///< nearest place of the path, from its start
  double length_m = 0;            ///< of the path
  double offset_m = 0;            ///< of the vehicle, to the left of the path
  double heading_error_rad = 0;   ///< of the vehicle, off that of slip-free driving there
  double path_speed_mps = 0;      ///< a step farther on; negative in reverse
  double path_curvature_1pm = 0;  ///< there, as the vehicle counts it
};

/// Commands speed of the rims, curvature and crab angle; between two legs of a path it is not
/// asked.
using OwnFollower = std::function<VehicleControl(const FollowerView&)>;

/// A follower and its gains.
struct FollowerChoice {
  FollowerKind kind = FollowerKind::kCompensated;
  SteeringLaw law;
  OwnFollower own = {};  ///< of `kOwn`, which has no use for the gains
};

/// What slip-free driving or a model of the ground has commanded at a place of a path.
struct FeedForward {
  double curvature_1pm = 0;
  double rim_per_speed = 1;  ///< rim speed over the speed of the vehicle
  double crab_rad = 0;
};

/// How a vehicle that keeps to its path is expected to move over the ground: what is left is for
/// its sensors to find.
struct ForeseenSlip {
  bool from_trims = false;    ///< else nothing is known of the ground, and none is foreseen
  double speed_ratio = 1;     ///< speed over the one that slip-free wheels would give
  double slip_angle_rad = 0;  ///< of the body, beyond that of slip-free steering
  double curvature_1pm = 0;   ///< yaw rate over speed, beyond the commanded curvature
};

/// Keeps a vehicle to a path. It is told where the vehicle seems to be, and answers with targets
/// within the vehicle's own range; that these are reached at its limited rates is the vehicle's
/// part.
///
/// Feedback by offset and course is the linear law of path following in its critically damped form
/// (A. De Luca, G. Oriolo, C. Samson, "Feedback control of a nonholonomic car-like robot", in
/// J.-P. Laumond (ed.), Robot Motion Planning and Control, 1998).
class Follower {
 public:
  /// All must outlive it.
  Follower(const Vehicle& vehicle, const ReferencePath& path, const SteeringLaw& law);
  virtual ~Follower() = default;
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  /// Told where the vehicle is after a step: pose, motion and what was commanded by then.
  void observe(const VehicleState& seen, double step_s);

  /// What to command in the next step.
  /// \throws InputError for what an own follower commands beyond the vehicle's range
  VehicleControl control(double step_s) const;

  /// From now on the rims brake early enough for what is fed forward, which a derived follower
  /// knows once it is constructed. A follower of the caller's own feeds nothing forward.
  void foresee_braking();

  /// At the place of the path where the vehicle is.
  ForeseenSlip foreseen() const { return foreseen_at(leg_, s_m_); }

  /// From the start of the path.
  double s_m() const { return path_.leg_start_m(leg_) + s_m_; }
  /// Of the path's legs, the one that is being followed.
  std::size_t leg() const { return leg_; }
  /// To the left of the path.
  double offset_m() const { return offset_m_; }
  /// Whether the end of the path is as near as the vehicle can tell.
  bool arrived(double step_s) const;

 protected:
  /// \param s_m along the leg
  virtual FeedForward ahead(std::size_t leg, double s_m) const = 0;
  virtual ForeseenSlip foreseen_at(std::size_t leg, double s_m) const = 0;
  /// Way over which the slip angle that was not foreseen is averaged. A vehicle takes up its slip
  /// angle late: feedback of each moment's course would swing on soft ground.
  virtual double slip_memory_m() const { return 0; }
  /// What to command while a leg is driven: the law above.
  virtual VehicleControl follow(double step_s) const;
  FollowerView view(double step_s) const;

  const Vehicle& vehicle() const { return vehicle_; }
  const ReferencePath& path() const { return path_; }

 private:
  const PathLeg& now() const { return path_.legs[leg_]; }
  double speed() const;
  double creep_mps(double step_s) const;
  /// From rest, the speed a little farther on: at rest itself the path says to stay.
  double path_speed_mps(double step_s) const;
  double foreseen_slip_angle_rad() const;
  bool at_end_of_leg(double step_s) const;
  /// Steering of the next leg's start, for which the vehicle waits at rest.
  FeedForward next_steering() const;
  bool ready_for_next_leg() const;

  const Vehicle& vehicle_;
  const ReferencePath& path_;
  SteeringLaw law_;
  double speed_top_mps_;
  std::vector<BrakingInTime> braking_;  ///< one a leg, once it is foreseen
  std::size_t leg_ = 0;
  bool changes_direction_ = false;  ///< brakes to rest at the end of a leg that another follows
  VehicleState seen_;
  double time_s_ = 0;
  double s_m_ = 0;  ///< along the leg
  double offset_m_ = 0;
  double unforeseen_rad_ = 0;  ///< slip angle of the body beyond that foreseen
  double slip_factor_ = 1;     ///< speed over the one that the rims should have given
};

/// \param planned the world as it is planned in: what `compensated` knows of the ground
/// \param planned, path must outlive it
std::unique_ptr<Follower> make_follower(const FollowerChoice& choice, const World& planned,
                                        const ReferencePath& path);

}  // namespace regoplan
