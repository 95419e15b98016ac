#include "terramech/margins/margin_judge.h"

#include <cmath>
#include <limits>

#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/value_range.h"
#include "terramech/parameters/trusted_range.h"

namespace regoplan {
namespace {

const StrainLimits& checked(const StrainLimits& strain, std::span<const WheelLaw> soil_laws) {
  validate(strain);
  if (soil_laws.empty()) throw InputError("soil_laws: none; one for each soil of the ground");
  return strain;
}

}  // namespace

void validate(const StrainLimits& strain) {
  require("slip_angle_max_deg", rounded_degrees(strain.slip_angle_max_rad),
          {.min = 0, .max = rounded_degrees(kTrustedSlipAngle_rad), .min_excluded = true});
  require("slip_max", strain.slip_max, {.min = 0, .max = kTrustedSlip_max, .min_excluded = true});
  require("sinkage_max_m", strain.sinkage_max_m, kAbove0);
}

TrimLimits trim_limits(const Vehicle& vehicle, const StrainLimits& strain) {
  return {.slip_angle_max_rad = strain.slip_angle_max_rad,
          .slip_max = strain.slip_max,
          .sinkage_max_m = strain.sinkage_max_m,
          .steer_angle_max_rad = vehicle.steer_angle_max_rad,
          .torque_max_nm = vehicle.torque_max_nm.value_or(std::numeric_limits<double>::infinity())};
}

MarginJudge::MarginJudge(const VehicleDynamics& dynamics, std::span<const WheelLaw> soil_laws,
                         const StrainLimits& strain)
    : dynamics_(dynamics),
      soil_laws_(soil_laws),
      limits_(trim_limits(dynamics.vehicle(), checked(strain, soil_laws))),
      polygon_(dynamics.vehicle()) {}

void MarginJudge::use_tables(double slope_max_rad, int threads) {
  const Vehicle& vehicle = dynamics_.vehicle();
  tables_.clear();
  for (const WheelLaw& law : soil_laws_) {
    tables_.emplace_back(vehicle, law, limits_, vehicle.mass_kg * dynamics_.gravity_mps2(),
                         slope_max_rad, threads);
  }
}

StateMargins MarginJudge::margins(const VehicleState& state, const GroundPatch& patch) const {
  const SupplyQuestion question = question_of(dynamics_, state, patch);
  const bool tabled = !tables_.empty() && !question.reverse && question.crab_rad == 0;
  const SupplyAnswer answer =
      tabled ? TabledSupply(tables_).answer(question, dynamics_.vehicle().wheels.size())
             : SolvedSupply(dynamics_.vehicle(), dynamics_.sharing(), soil_laws_, limits_)
                   .answer(question);
  return margins_of(dynamics_, polygon_, question, answer);
}

SupplyResult MarginJudge::supply(const SupplyQuestion& question) const {
  std::vector<WheelLaw> laws;
  for (std::size_t i = 0; i < dynamics_.vehicle().wheels.size(); ++i) {
    laws.push_back(soil_laws_[static_cast<std::size_t>(question.patch->soil.at(i))]);
  }
  const SteadyManoeuvre manoeuvre =
      manoeuvre_of(dynamics_.vehicle(), dynamics_.sharing(), laws, question);
  return cornering_supply(manoeuvre, question.force.forward_n, limits_, true);
}

}  // namespace regoplan
