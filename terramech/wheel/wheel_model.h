#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "terramech/mechanisms/generic_correction.h"
#include "terramech/mechanisms/mechanism.h"
#include "terramech/mechanisms/mechanism_effects.h"
#include "terramech/parameters/soil.h"
#include "terramech/parameters/wheel.h"
#include "terramech/wheel/sinkage_solver.h"
#include "terramech/wheel/wheel_contact.h"

namespace regoplan {

/// The two named variants of the wheel model of Yoshida & Ishigami (2004): `kIshigami2007` solves
/// the sinkage for the load at every slip; `kYoshida2004` is the paper's own, h = h0 + c0 s.
enum class WheelVariant { kIshigami2007, kYoshida2004 };

/// How far a wheel's forces may be trusted, or why there are none.
enum class WheelStatus {
  kOk,
  kUntrusted,            ///< slip outside [-0.9, 0.95] or |slip angle| above 60 deg
  kStandstill,           ///< neither rim nor axle moves: no shear
  kCounterRotating,      ///< rim and axle move against each other: the locked limit
  kSinksToAxle,          ///< no sinkage below the radius carries the load: no forces
  kCohesionCarriesLoad,  ///< yoshida2004: the stress scale would be negative: no forces
  kOutsideCorrection,    ///< outside the region a generic correction was learned in
  kLifted,               ///< no load: the wheel does not touch the soil, and all forces are 0
};

/// The status as it stands in files: `ok`, `untrusted`, ...
std::string_view name(WheelStatus status);

/// Whether the wheel has forces at all.
inline bool has_forces(WheelStatus status) {
  return status != WheelStatus::kSinksToAxle && status != WheelStatus::kCohesionCarriesLoad;
}

/// Motion of a wheel in its own frame: x along the heading, y left.
struct WheelMotion {
  double vx_mps = 0;         ///< of the axle along the heading
  double vy_mps = 0;         ///< of the axle to the left
  double rim_speed_mps = 0;  ///< r w, positive when it drives forward
};

/// The motion with the given slip ratio, eq. (1), and slip angle; the faster of rim and axle speed
/// is 1 m/s (forces depend on velocity ratios only).
/// \param slip_ratio in [-1, 1] \param slip_angle_rad in [-pi/2, pi/2]
/// \throws ValueError where either is outside
WheelMotion motion_at(double slip_ratio, double slip_angle_rad);

/// Slip ratio, eq. (1): (r w - Vx)/(r w) driving, (r w - Vx)/Vx braking; 0 at standstill, -1 where
/// rim and axle move against each other.
double slip_ratio(const WheelMotion& motion);

/// Slip angle atan2(Vy, |Vx|), positive when the wheel moves to the left of its heading. Radians.
double slip_angle_rad(const WheelMotion& motion);

/// Soil reaction on a wheel. The force on the wheel is (fx_n, -fy_n) in the wheel frame: `fy_n`
/// keeps the paper's sign, positive for a positive slip angle and opposing the lateral motion.
struct WheelForces {
  double fx_n = 0;         ///< drawbar pull, forward
  double fy_n = 0;         ///< side force, opposing
  double torque_nm = 0;    ///< driving torque at the axle
  double sinkage_m = 0;    ///< h
  double theta_f_rad = 0;  ///< entry angle
  double theta_r_rad = 0;  ///< exit angle, <= 0
  WheelStatus status = WheelStatus::kOk;
};

/// What a wheel model is made of.
struct WheelModelSpec {
  WheelVariant variant = WheelVariant::kIshigami2007;
  Wheel wheel;
  Soil soil;
  double gravity_mps2 = 9.80665;
  std::vector<Mechanism> mechanisms = {};                   ///< empty: the base model
  std::optional<GenericCorrection> generic = std::nullopt;  ///< added to all that the others give
};

/// All that a single wheel shows, ruts included.
struct WheelChannels {
  WheelForces forces;
  double rut_left_m = 0;  ///< depth at the left edge of the wheel
  double rut_right_m = 0;
  double roll_moment_nm = 0;  ///< of the normal stress about the wheel's x axis
};

/// The direct wheel model, immutable.
class WheelModel {
 public:
  /// \throws ValueError naming the first field out of range
  explicit WheelModel(const WheelModelSpec& spec, WheelAccuracy accuracy = WheelAccuracy::kExact);
  /// As above, made in a fraction of the time: sinkages are sought from where a model of the same
  /// wheel on another soil has its own. For slip ratios from -0.98 on the accuracy is the same
  /// (WheelAccuracy.StandsWhereverSinkagesAreSoughtFrom); a wheel that is all but locked may be
  /// three times as far off.
  WheelModel(const WheelModelSpec& spec, WheelAccuracy accuracy, const WheelModel& near);

  /// Forces on the wheel under the given vertical load.
  /// Mechanisms act as on a first pass at the motion's own speed.
  /// \param load_n 0 for a lifted wheel, which has no forces (`kLifted`)
  /// \throws ValueError for a load that is not finite or negative, or a motion
  /// that is not finite
  WheelForces forces(double load_n, const WheelMotion& motion) const;

  /// With ruts, and with what the mechanisms need to know of the conditions.
  /// \throws ValueError as `forces`, and for a pass below 1
  WheelChannels channels(double load_n, const WheelMotion& motion,
                         const WheelConditions& conditions = {}) const;

  const WheelModelSpec& spec() const { return spec_; }

 private:
  WheelModel(const WheelModelSpec& spec, WheelAccuracy accuracy, const WheelModel* near);
  WheelForces without_correction(double load_n, const WheelMotion& motion) const;
  friend WheelChannels mechanism_channels(const WheelModel& model, double load_n,
                                          const WheelMotion& motion,
                                          const WheelConditions& conditions);
  friend WheelChannels channels_under(const WheelModel& model, const Effects& effects,
                                      const WheelState& state, const WheelMotion& motion);

  WheelModelSpec spec_;
  WheelAccuracy accuracy_;
  wheel_contact::Ground ground_;
  wheel_contact::SinkageSolver solver_;
  std::vector<BoundMechanism> mechanisms_;
};

}  // namespace regoplan
