#include "diagnosis/fit/coordinate.h"

#include <algorithm>
#include <cmath>

namespace regoplan {

double Coordinate::value(double x) const {
  const double y = centre + spread * x;
  switch (scale) {
    case Scale::kLinear:
      return std::clamp(y, min, max);
    case Scale::kLogarithmic:
      return std::clamp(std::exp(y), min, max);
    case Scale::kShare:
      break;
  }
  return max / (1 + std::exp(-y));
}

double Coordinate::at(double value) const {
  switch (scale) {
    case Scale::kLinear:
      return (value - centre) / spread;
    case Scale::kLogarithmic:
      return (std::log(value) - centre) / spread;
    case Scale::kShare:
      break;
  }
  return (std::log(value / (max - value)) - centre) / spread;
}

double Coordinate::slope(double x) const {
  switch (scale) {
    case Scale::kLinear:
      return spread;
    case Scale::kLogarithmic:
      return spread * value(x);
    case Scale::kShare:
      break;
  }
  return spread * value(x) * (1 - value(x) / max);
}

std::vector<SoilCoordinate> soil_coordinates(const UncertainSoil& soil, double widen) {
  std::vector<SoilCoordinate> all;
  for (std::size_t i = 0; i < soil_parameters().size(); ++i) {
    const SoilParameter& p = soil_parameters()[i];
    const double deviation = soil.standard_deviation.*p.member;
    if (!(deviation > 0)) continue;
    const double tiny = 1e-4 * (p.max - p.min > 1e5 ? std::abs(soil.mean.*p.member) : 1.0);
    all.push_back({i,
                   {.name = std::string(p.name),
                    .centre = soil.mean.*p.member,
                    .spread = widen * deviation,
                    .min = p.min * p.file_unit + (p.min_excluded ? tiny * p.file_unit : 0),
                    .max = p.max * p.file_unit}});
  }
  return all;
}

Soil soil_at(const UncertainSoil& soil, const std::vector<SoilCoordinate>& coordinates,
             const Eigen::VectorXd& x) {
  Soil at = soil.mean;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    at.*soil_parameters()[coordinates[i].parameter].member =
        coordinates[i].coordinate.value(x[static_cast<Eigen::Index>(i)]);
  }
  return at;
}

Eigen::VectorXd kept_inside(const UncertainSoil& soil,
                            const std::vector<SoilCoordinate>& coordinates, Eigen::VectorXd x) {
  constexpr double kEdge = 1e-3;
  const Soil at = soil_at(soil, coordinates, x);
  const double most = std::max(std::min(at.a0, 1 - at.a0) - kEdge, 0.0);
  const bool known = std::abs(soil.mean.a1) > most && !(soil.standard_deviation.a1 > 0);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const Coordinate& c = coordinates[i].coordinate;
    double& own = x[static_cast<Eigen::Index>(i)];
    if (c.name == "a1" && std::abs(at.a1) > most) own = c.at(std::clamp(at.a1, -most, most));
    if (c.name == "a0" && known) {
      const double least = std::abs(at.a1) + kEdge;
      own = c.at(std::clamp(at.a0, least, std::max(1 - least, least)));
    }
  }
  return x;
}

double maximum_stress_pull(const std::vector<SoilCoordinate>& coordinates,
                           const Eigen::VectorXd& x) {
  double most = 0;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const std::string& name = coordinates[i].coordinate.name;
    if (name != "a0" && name != "a1") continue;
    most = std::max(most, std::abs(x[static_cast<Eigen::Index>(i)]));
  }
  return most;
}

}  // namespace regoplan
