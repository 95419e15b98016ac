#pragma once

#include <array>
#include <vector>

#include "terramech/mechanism.h"
#include "terramech/soil.h"
#include "terramech/wheel.h"

namespace regoplan {

/// How the shear stress follows the displacement of the soil.
enum class ShearLaw {
  kSeparate,           ///< base: along x and y apart, eqs. (7)(10)
  kAlongDisplacement,  ///< one Mohr-Coulomb limit, along the displacement
  kAlongSlipVelocity,  ///< one limit, along the velocity of the rim through the soil
  kHump,               ///< peak, then residual (Wong)
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
  double rim_factor = 1;  ///< true rim speed over the one told
  double stiffness = 1;   ///< factor on k
  double limit = 1;       ///< factor on cohesion and tan(phi)
  ShearLaw shear = ShearLaw::kSeparate;
  double residual = 1;        ///< shear hump: residual over peak
  double sinkage_factor = 1;  ///< h = h0 factor + added
  double sinkage_added_m = 0;
  double rut_tilt_rad = 0;  ///< psi, the inner side deeper
  bool rut_in_balance =
      false;  ///< the strips under a tilted rut find the depth that carries the load
  double bulldoze_height = 1;   ///< h_b/h beside the wheel
  double surcharge_pa = 0;      ///< on the soil beside the wheel
  double front_bulldozing = 0;  ///< eta
  double layer_depth_m = 0;     ///< 0: one layer
  double layer_stiffness = 1;   ///< of the layer below over the one above
  double inertia = 0;           ///< factor on rho v^2 b h
  double flank_shear = 0;       ///< share of mobilised shear on both flanks
  double lug_height_m = 0;      ///< passive pressure on a lug
  double lug_share = 0;         ///< of the lugs' pressure that is mobilised
  double lug_ripple = 0;        ///< of their thrust over a lug's passage
  double lugs = 0;              ///< around the wheel
  double lug_phase_rad = 0;
  double tilt_x = 0, tilt_y = 0;  ///< share of the load along x and y
  double drag_torque_nm = 0;
};

/// A mechanism looked up once: its form, and the parameters in the form's order.
struct BoundMechanism {
  std::size_t form = 0;  ///< index into mechanism_forms()
  std::array<double, 4> parameters{};
};

/// \throws InputError as form_of
BoundMechanism bind(const Mechanism& mechanism);

Effects apply(const std::vector<BoundMechanism>& mechanisms, Effects effects,
              const WheelState& state);

}  // namespace regoplan
