#include "diagnosis/findings/gain_unit.h"

#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace regoplan {
namespace {

/// What one of the recording's unit (N, N m or m) is in another one.
struct OtherUnit {
  std::string_view name;
  double factor = 1;
};

constexpr std::array kForces{OtherUnit{"kgf", 0.101972}, OtherUnit{"lbf", 0.224809},
                             OtherUnit{"kN", 1e-3}};
constexpr std::array kTorques{OtherUnit{"kgf m", 0.101972}, OtherUnit{"lbf ft", 0.737562},
                              OtherUnit{"lbf in", 8.85075}, OtherUnit{"N cm", 100}};
constexpr std::array kLengths{OtherUnit{"ft", 3.28084}, OtherUnit{"in", 39.3701},
                              OtherUnit{"cm", 100}};

std::span<const OtherUnit> units_of(std::string_view channel) {
  if (channel == "torque_nm") return kTorques;
  if (channel.ends_with("_n")) return kForces;
  return kLengths;
}

}  // namespace

std::string unit_of_gain(const Claim& claim) {
  const auto gain = claim.parameters.find("gain");
  if (claim.id != "sensor_gain" || gain == claim.parameters.end()) return "";
  constexpr double kNear = 0.03, kWellKnown = 0.05;
  const double factor = 1 + gain->second.value;
  if (gain->second.standard_deviation > kWellKnown * factor) return "";
  for (const OtherUnit& unit : units_of(claim.form)) {
    if (std::abs(factor - unit.factor) < kNear * unit.factor) return std::string(unit.name);
  }
  return "";
}

}  // namespace regoplan
