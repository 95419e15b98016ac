#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "terramech/parameters/soil.h"

namespace regoplan {

/// How an unknown number follows from y = centre + spread x.
enum class Scale {
  kLinear,       ///< y
  kLogarithmic,  ///< exp(y): positive
  kShare,        ///< max/(1 + exp(-y)): positive, and no more than max
};

/// One unknown number in units of its prior: x is standard normal beforehand.
struct Coordinate {
  std::string name;
  Scale scale = Scale::kLinear;
  double centre = 0, spread = 1;
  double min = -1e300, max = 1e300;  ///< valid range of the number

  bool is_positive() const { return scale != Scale::kLinear; }
  /// A factor that is as likely above 1 as below, 1 being no change.
  bool is_factor() const { return scale == Scale::kLogarithmic && centre == 0; }

  double value(double x) const;
  double at(double value) const;  ///< the x of a number
  double slope(double x) const;   ///< d value/dx
};

/// A soil number that is not known exactly; held in SI.
struct SoilCoordinate {
  std::size_t parameter = 0;  ///< index into soil_parameters()
  Coordinate coordinate;
};

/// The uncertain numbers of a soil.
/// \param widen factor on the prior standard deviations
std::vector<SoilCoordinate> soil_coordinates(const UncertainSoil& soil, double widen = 1);

/// The soil at x (one entry a coordinate; further entries are not read).
Soil soil_at(const UncertainSoil& soil, const std::vector<SoilCoordinate>& coordinates,
             const Eigen::VectorXd& x);

/// The same x with a1 (a0 where a1 is known) at the edge at which the maximum stress leaves the
/// contact, a0 + a1 s = 0 or 1 at some slip, if x lies beyond it: what a fit's step is cut to.
Eigen::VectorXd kept_inside(const UncertainSoil& soil,
                            const std::vector<SoilCoordinate>& coordinates, Eigen::VectorXd x);

/// Prior standard deviations by which a0 or a1 lies from its test, the larger. Where an edge is met
/// far from the tests other physics is missing, and no fit is made to go along it.
double maximum_stress_pull(const std::vector<SoilCoordinate>& coordinates,
                           const Eigen::VectorXd& x);

}  // namespace regoplan
