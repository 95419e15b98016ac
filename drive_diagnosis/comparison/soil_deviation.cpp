#include "drive_diagnosis/comparison/soil_deviation.h"

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

/// Of strength and bearing, as far as tests of one soil scatter; 0 of all else.
double assumed_spread(const Soil& mean, std::size_t number) {
  constexpr double kStrength = 0.1, kBearing = 0.25;
  double Soil::*const member = soil_parameters().at(number).member;
  if (member == &Soil::cohesion_pa || member == &Soil::friction_angle_rad) {
    return kStrength * std::abs(mean.*member);
  }
  if (member == &Soil::kc || member == &Soil::kphi) return kBearing * std::abs(mean.*member);
  return 0;
}

}  // namespace

SoilNumbers told_spread(const UncertainSoil& soil) {
  SoilNumbers spread{};
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    spread.at(k) = soil.standard_deviation.*soil_parameters().at(k).member;
  }
  if (std::ranges::any_of(spread, [](double std) { return std > 0; })) return spread;
  for (std::size_t k = 0; k < kSoilNumbers; ++k) spread.at(k) = assumed_spread(soil.mean, k);
  return spread;
}

SoilNumbers soil_spread(const UncertainSoil& soil) {
  SoilNumbers spread = told_spread(soil);
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    if (!(spread.at(k) > 0)) spread.at(k) = assumed_spread(soil.mean, k);
  }
  return spread;
}

Soil deviating(const UncertainSoil& soil, const SoilNumbers& deviations) {
  const SoilNumbers spread = soil_spread(soil);
  const auto& parameters = soil_parameters();
  for (double share = 1; share > 0.01; share *= 0.7) {  // short of what no soil is
    Soil result = soil.mean;
    for (std::size_t k = 0; k < kSoilNumbers; ++k) {
      double& value = result.*parameters.at(k).member;
      const double off = share * deviations.at(k) * spread.at(k);
      if (off == 0) continue;
      value = value > 0 ? value * std::exp(off / value) : value + off;
    }
    if (is_valid(result)) return result;
  }
  return soil.mean;
}

SoilNumbers deviations_between(const UncertainSoil& soil, const Soil& other) {
  const SoilNumbers spread = soil_spread(soil);
  SoilNumbers numbers{};
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    if (!(spread.at(k) > 0)) continue;
    double Soil::*const member = soil_parameters().at(k).member;
    const double from = soil.mean.*member, to = other.*member;
    numbers.at(k) = (from > 0 && to > 0 ? from * std::log(to / from) : to - from) / spread.at(k);
  }
  return numbers;
}

SoilNumbers weaker_by(double deviations) {
  SoilNumbers numbers{};
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    double Soil::*const member = soil_parameters().at(k).member;
    const bool counts = member == &Soil::cohesion_pa || member == &Soil::friction_angle_rad ||
                        member == &Soil::kc || member == &Soil::kphi;
    if (counts) numbers.at(k) = -deviations;
  }
  return numbers;
}

SoilNumbers bearing_by(const UncertainSoil& soil, double log_factor) {
  Soil other = soil.mean;
  other.kc *= std::exp(log_factor);
  other.kphi *= std::exp(log_factor);
  return deviations_between(soil, other);
}

Soil weaker(const UncertainSoil& soil, double deviations) {
  return deviating(soil, weaker_by(deviations));
}

}  // namespace regoplan
