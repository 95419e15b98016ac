#pragma once

#include <limits>
#include <optional>

#include "terramech/wheel/wheel_model.h"

/// Challenges for the diagnosis: recordings whose missing physics is known to the generator alone.
namespace regoplan::challenge {

/// What a wheel on a test bed goes through in one run.
struct TruthConditions {
  double load_n = 0;         ///< that the soil really carries
  double middle_load_n = 0;  ///< of the series
  double slip_ratio = 0;
  double slip_angle_rad = 0;
  int pass = 1;
  double speed_mps = 0.05;
  double position_m = 0;
  double time_s = 0;
  double series_s = 1;  ///< how long the whole series of runs takes
  int day = 0;          ///< from 0
  double wheel_angle_rad = 0;
  double previous_slip_ratio = 0;  ///< of the run before
};

/// How the rut's depth differs across the width, over e = -1/2 (outer edge) to 1/2 (inner edge).
enum class RutProfile {
  kCubic,      ///< (2 e)^3: the edges alone
  kParabolic,  ///< (e + 1/2)^2 - 1/3: dug on the inner side, heaped nowhere
  kStep,       ///< tanh(6 e): a terrace
};

/// One wheel in one run with everything that truths change. As it stands: the base model.
struct TruthPhysics {
  WheelVariant variant = WheelVariant::kIshigami2007;
  Wheel wheel;
  Soil soil;
  double gravity_mps2 = 9.80665;
  TruthConditions at;

  double stiffness = 1;  ///< factor on kc/b + kphi
  double limit = 1;      ///< factor on cohesion and tan(phi)
  double break_depth_m = std::numeric_limits<double>::infinity();
  double deep_ratio = 1;      ///< stiffness of the soil below break_depth_m over that above
  double crust = 0;           ///< pressure of a crust over that of the soil at crust_depth_m
  double crust_depth_m = 1;   ///< in which the crust's resistance builds up
  double excavated_x = 0;     ///< share of the normal stress lost to shear along x,
  double excavated_y = 0;     ///< and along y,
  double excavation_m = 0.1;  ///< with this displacement
  double sinkage_factor = 1;  ///< h = h0 factor + added, and the stress scaled to carry the load
  double sinkage_added_m = 0;

  double circle = 0;          ///< how far shares beyond the friction circle are cut back to it
  double product = 0;         ///< how far shares fall as 1/sqrt(1 + (ex ey)^2)
  double sech_peak = 0;       ///< A of Kacigin & Guskov: 1 + A/cosh(j/k)
  double softening = 0;       ///< share of the shear strength lost far beyond
  double softening_m = 0.05;  ///< this displacement
  double brittle = 0;         ///< share of the soil that shears after Bekker's brittle law
  double lug_m = 0;           ///< shear surface outside the rim by this

  RutProfile profile = RutProfile::kCubic;
  double rut = 0;            ///< amplitude of the profile over the sinkage
  bool inner_flank = false;  ///< bulldozing at the inner edge's depth; else at that of each strip
  double berm_m = 0;         ///< soil heaped beside the deepest point of the wheel
  double flank = 0;          ///< share of mobilised shear on both flanks

  double added_fx_n = 0, added_fy_n = 0, added_torque_nm = 0, added_sinkage_m = 0;
};

/// What the test bed would show without noise. Signs as in WheelForces.
struct TruthChannels {
  double fx_n = 0, fy_n = 0, torque_nm = 0, sinkage_m = 0, rut_left_m = 0, rut_right_m = 0;
};

/// Forces by a scheme of its own (strips across the width, midpoint rule after Sidi's sine
/// transformation, false position for the sinkage) that shares no code with terramech.
/// Unchanged physics agree with WheelModel to 1e-4 of the load
/// (TruthWheel.AgreesWithTheWheelModel). Slip ratio from -0.95 to 0.95, slip angle up to 60 deg.
/// \returns nothing where no sinkage below the radius carries the load
std::optional<TruthChannels> truth_channels(const TruthPhysics& physics);

}  // namespace regoplan::challenge
