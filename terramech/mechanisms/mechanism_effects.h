#pragma once

#include <array>
#include <vector>

#include "terramech/mechanisms/mechanism.h"
#include "terramech/parameters/soil.h"
#include "terramech/parameters/wheel.h"

namespace regoplan {

/// How the shear stress follows the displacement of the soil.
enum class ShearLaw {
  kSeparate,           ///< base: along x and y apart, eqs. (7)(10)
  kAlongDisplacement,  ///< one Mohr-Coulomb limit, along the displacement
  kAlongSlipVelocity,  ///< one limit, along the velocity of the rim through the soil
  kWithinLimit,        ///< along x and y apart, cut back softly where the resultant nears the limit
  kHump,               ///< peak, then residual (Wong)
  kSoftening,          ///< as the base, along x and y apart, and strength lost with displacement
};

/// How the normal stress grows with depth where the soil lies in layers, z the depth of a point of
/// the contact.
struct Layering {
  enum class Kind {
    kNone,
    kHardBelow,  ///< sigma (1 + (ratio - 1)(1 - exp(-(z/depth)^2)))
    kCrust,      ///< sigma + crust (z/depth) exp(1 - z/depth)
  };
  Kind kind = Kind::kNone;
  double depth_m = 1;
  double ratio = 1;     ///< of the stiffness far below over that of the top
  double crust_pa = 0;  ///< what the crust bears at most, at its depth
};

/// The wheel and where it is, before its mechanisms act.
struct WheelState {
  double load_n = 0;
  double slip = 0;
  double beta_abs_rad = 0;
  double beta_sign = 0;
  double rim_speed_mps = 0;
  double speed_mps = 0;
  WheelConditions conditions;
};

/// What mechanisms change. They act one after the other on the result of those before.
struct Effects {
  Wheel wheel;
  Soil soil;
  double load_n = 0;
  double load_per_drawbar = 0;  ///< load gained a newton of drawbar pull
  double rim_factor = 1;        ///< true rim speed over the one told
  double stiffness = 1;         ///< factor on k
  double limit = 1;             ///< factor on cohesion and tan(phi)
  ShearLaw shear = ShearLaw::kSeparate;
  double residual = 1;        ///< kHump: residual over peak; kSoftening: over tau_max
  double softening = 1;       ///< kSoftening: displacement over kx, ky at which 1 - 1/e is lost
  double coupling = 1;        ///< kWithinLimit: how far shares are cut back, 1 at the limit
  double sinkage_factor = 1;  ///< h = h0 factor + added
  double sinkage_added_m = 0;
  double dug_resistance = 0;    ///< share of the work of compacting a dug rut that Fx pays
  double rut_tilt_rad = 0;      ///< psi, the inner side deeper
  bool rut_in_balance = false;  ///< the strips of a tilted rut find the depth that carries the load
  double wall_share = 0;        ///< edges of the rut at h (1 +- share), the inner wall felt
  double bulldoze_height = 1;   ///< h_b/h beside the wheel
  double surcharge_pa = 0;      ///< on the soil beside the wheel
  double front_bulldozing = 0;  ///< eta
  Layering layering;
  double inertia = 0;             ///< factor on rho v^2 b h
  double flank_shear = 0;         ///< share of mobilised shear on both flanks
  double flank_friction = 0;      ///< Fx lost a newton of |Fy|
  double flank_bulldozing = 0;    ///< Fx lost a newton of the bulldozing part of |Fy|
  double flank_pressure_pa = 0;   ///< on the buried segment of the flank that pushes the soil
  double rim_friction_ratio = 1;  ///< friction angle at the rim over the soil's, at most 1
  double rim_adhesion_share = 1;  ///< adhesion at the rim over the soil's cohesion, at most 1
  double shear_radius = 1;        ///< of the surface along which soil shears over the rim's
  double block_cohesion = 1;      ///< of the soil that shears with the wheel over the soil's own
  double block_friction = 1;      ///< its tan(phi) over the soil's own
  double block_held = 1;          ///< share of a block's strength that acts sideways too
  bool side_undisturbed = false;  ///< |Fy| as without digging and at the slip that was told
  double lug_height_m = 0;        ///< passive pressure on a lug
  double lug_share = 0;           ///< of the lugs' pressure that is mobilised
  double lug_pressed = 0;         ///< share of the ground pressure that the soil between lugs bears
  double lug_ripple = 0;          ///< of their thrust over a lug's passage
  double lugs = 0;                ///< around the wheel
  double lug_phase_rad = 0;
  double tilt_x = 0, tilt_y = 0;  ///< share of the load along x and y
  double drag_torque_nm = 0;
};

/// As many parameters as any form has, in the form's order.
using FormParameters = std::array<double, 5>;

/// A mechanism looked up once: its form, and the parameters in the form's order.
struct BoundMechanism {
  std::size_t form = 0;  ///< index into mechanism_forms()
  FormParameters parameters{};
};

/// \throws InputError as form_of
BoundMechanism bind(const Mechanism& mechanism);

Effects apply(const std::vector<BoundMechanism>& mechanisms, Effects effects,
              const WheelState& state);

}  // namespace regoplan
