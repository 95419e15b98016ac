#pragma once

#include <array>
#include <random>
#include <string_view>

namespace regoplan {

/// Soil under a wheel: the numbers of the wheel model of Yoshida & Ishigami (2004). SI units.
/// Which values are valid is stated once, in `soil_parameters()`.
struct Soil {
  double cohesion_pa = 0;         ///< c
  double friction_angle_rad = 0;  ///< phi
  double kc = 0;                  ///< pressure-sinkage modulus, N/m^(n+1)
  double kphi = 0;                ///< pressure-sinkage modulus, N/m^(n+2)
  double n = 1;                   ///< sinkage exponent
  double a0 = 0.4;                ///< theta_m / theta_f at zero slip
  double a1 = 0.15;               ///< growth of theta_m / theta_f with slip
  double lambda = 0;              ///< rear contact height over sinkage
  double density_kgpm3 = 0;       ///< rho
  double kx0_m = 0;               ///< shear deformation modulus along x at beta = 0
  double kx1_m = 0;               ///< its growth per radian of |beta|
  double ky0_m = 0;               ///< shear deformation modulus along y at beta = 0
  double ky1_m = 0;               ///< its growth per radian of |beta|
  double c0_m = 0;                ///< slip sinkage coefficient, eq. (14); yoshida2004 only
};

/// One soil number: its name in files, how it is held, and where it is valid.
struct SoilParameter {
  std::string_view name;  ///< key in every file, unit included
  double Soil::*member;   ///< where it is held, SI and radians
  double file_unit;       ///< SI value of one unit of the file (pi/180 for degrees, else 1)
  double min, max;        ///< valid range in the file's unit
  bool min_excluded;      ///< the lower end itself is not valid
  bool optional;          ///< 0 where a file does not give it
};

/// All soil numbers, in the order in which they are drawn, written and listed.
const std::array<SoilParameter, 14>& soil_parameters();

/// \throws ValueError naming the first number that is not finite or out of its range, or `a1` where
/// theta_m would leave the contact for some slip in [-1, 1].
void validate(const Soil& soil);

/// Whether `validate` finds nothing wrong.
bool is_valid(const Soil& soil);

/// What independent tests say of a soil: mean and standard deviation of every number, independent
/// of each other. A standard deviation of 0 is a number that is known.
struct UncertainSoil {
  Soil mean;
  Soil standard_deviation{.n = 0, .a0 = 0, .a1 = 0};
};

/// Whether the pressure below a plate as wide as the wheel grows with its depth: Bekker's modulus
/// kc/b + kphi is above 0.
bool resists_sinkage(const Soil& soil, double wheel_width_m);

/// A soil drawn from independent normal distributions truncated to the valid ranges, that resists
/// the sinkage of such a wheel. \throws InputError when 1000 draws in a row are all invalid
Soil draw(const UncertainSoil& soil, double wheel_width_m, std::mt19937_64& random);

}  // namespace regoplan
