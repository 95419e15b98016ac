#pragma once

#include <optional>
#include <span>
#include <vector>

#include "terramech/margins/state_margins.h"
#include "terramech/margins/supply.h"

namespace regoplan {

/// What a manoeuvre may strain its wheels to, as a vehicle or a scenario limits it.
struct StrainLimits {
  double slip_angle_max_rad = 0;
  double slip_max = 0;
  double sinkage_max_m = 0;
};

/// \throws ValueError for a limit that is not above 0, or beyond where wheel forces are trusted
void validate(const StrainLimits& strain);

/// The limits of steady trims: those of the strain, and what the vehicle's steering and motors can.
TrimLimits trim_limits(const Vehicle& vehicle, const StrainLimits& strain);

/// Demand, supply and stability margins of a vehicle's moments on known ground: the one place where
/// vehicle, limits, supply and support polygon come together, for searches, verdicts, charts,
/// rasters and draws of soils alike. Margins are shares of the weight (reference: the seed paper's
/// equations 11 to 13 for the forces; `state_margins.h` for their definitions).
class MarginJudge {
 public:
  /// Solves every manoeuvre with the wheels' laws. \param dynamics \param soil_laws must outlive it
  /// \throws ValueError as `validate(strain)`, InputError for no soil law
  MarginJudge(const VehicleDynamics& dynamics, std::span<const WheelLaw> soil_laws,
              const StrainLimits& strain);
  MarginJudge(VehicleDynamics&& gone, std::span<const WheelLaw> soil_laws,
              const StrainLimits& strain) = delete;
  MarginJudge(const VehicleDynamics& dynamics, std::vector<WheelLaw>&& gone,
              const StrainLimits& strain) = delete;

  /// From now on looks supply up in tables where they know the manoeuvre (forward, without crab):
  /// as fast as searches need it, within the bound that `SupplyTable` documents.
  /// \param slope_max_rad steepest ground that will be asked for
  void use_tables(double slope_max_rad, int threads);

  StateMargins margins(const VehicleState& state, const GroundPatch& patch) const;

  /// The whole supply with what ends it to either side, always solved.
  SupplyResult supply(const SupplyQuestion& question) const;

  const TrimLimits& limits() const { return limits_; }

 private:
  const VehicleDynamics& dynamics_;
  std::span<const WheelLaw> soil_laws_;
  TrimLimits limits_;
  SupportPolygon polygon_;
  std::vector<SupplyTable> tables_;  ///< by soil
};

}  // namespace regoplan
