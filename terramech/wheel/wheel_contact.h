#pragma once

#include "terramech/parameters/soil.h"
#include "terramech/parameters/wheel.h"

namespace regoplan {

/// How closely the direct model is integrated and solved, up to 95 % of the largest load that the
/// soil carries: `kFast` to 1.5e-4 of the load, `kExact` to 3e-6 (WheelAccuracy tests). Beyond, Fz
/// hardly rises with the sinkage, and both may be several times that.
enum class WheelAccuracy { kFast, kExact };

}  // namespace regoplan

/// The stress integrals of the wheel model under a wheel whose entry angle is given.
namespace regoplan::wheel_contact {

/// Constants of a wheel on a soil, bound once.
struct Ground {
  Wheel wheel;
  Soil soil;
  double tan_phi = 0;
  double sqrt_lambda = 0;
  double stress_scale_pa = 0;       ///< r^n (kc/b + kphi), eq. (5)
  double bulldoze_cohesion_pa = 0;  ///< D1 c with D1 = cot Xc + tan(Xc + phi), eq. (16)
  double bulldoze_weight = 0;       ///< D1 D2 rho g / 2, eq. (16), N/m^3

  Ground(const Wheel& wheel, const Soil& soil, double gravity_mps2);
};

/// Velocity ratios of a wheel that rolls forward or is dragged forward locked. Shear displacement
/// along x is r [rim (theta_f - theta) - axle (sin theta_f - sin theta)], along y
/// r lateral (theta_f - theta): rim = 1, axle = q_v and lateral = u of a rolling wheel; a locked
/// wheel has rim = 0 and the others 0 or so large that the shear is fully mobilised.
struct Ratios {
  double rim = 1;
  double axle = 1;
  double lateral = 0;
  double slip = 0;
  double beta_abs_rad = 0;
};

/// Where the wheel touches the soil. Angles from the downward vertical, forward positive.
struct Contact {
  double theta_f_rad = 0;
  double theta_r_rad = 0;
  double theta_m_rad = 0;
  double sin_f = 0, cos_f = 1;
  double sin_r = 0, cos_r = 1;
};

/// theta_f of a wheel that has sunk by h, in [0, 2 r]: acos(1 - h/r), without its cancellation.
double entry_angle_rad(double sinkage_m, double radius_m);
/// The sinkage that goes with an entry angle: r (1 - cos theta_f).
double sinkage_at_m(double theta_f_rad, double radius_m);

/// theta_r and theta_m that go with an entry angle at a slip ratio, eq. (6).
Contact contact_at(const Ground& ground, double theta_f_rad, double slip);

/// Fx, Fz and T of one part of the stress.
struct Resultant {
  double fx_n = 0, fz_n = 0, torque_nm = 0;
};

inline Resultant operator+(const Resultant& a, const Resultant& b) {
  return {a.fx_n + b.fx_n, a.fz_n + b.fz_n, a.torque_nm + b.torque_nm};
}
inline Resultant operator*(double q, const Resultant& a) {
  return {q * a.fx_n, q * a.fz_n, q * a.torque_nm};
}

/// Integrals over the contact. With the normal stress scaled by Q the resultant is
/// cohesion + Q stress.
struct Integrals {
  Resultant cohesion, stress;

  Resultant at(double q) const { return cohesion + q * stress; }
  /// The q at which the load is carried: below 0 where cohesion alone carries more.
  double stress_scale(double load_n) const { return (load_n - cohesion.fz_n) / stress.fz_n; }
};

/// Fx, Fz and T by Gauss-Legendre quadrature on either side of theta_m, eqs. (2)-(8).
Integrals integrate(const Ground& ground, const Contact& contact, const Ratios& ratios,
                    WheelAccuracy accuracy);

/// |Fy| = Fu + Fs, eqs. (9)-(17), with the mobilisation factor M of the bulldozing force.
double side_force_n(const Ground& ground, const Contact& contact, const Ratios& ratios,
                    double stress_scale_q, WheelAccuracy accuracy);

/// M Fs alone, eqs. (16)(17).
double bulldozing_force_n(const Ground& ground, const Contact& contact, const Ratios& ratios);

}  // namespace regoplan::wheel_contact
