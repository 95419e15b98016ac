#pragma once

#include <optional>
#include <span>
#include <vector>

#include "terramech/margins/margins.h"
#include "terramech/margins/supply_table.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// Demand, supply and margins of a moment, judged as the steady manoeuvre that it commands: its
/// speed, the commanded curvature and acceleration, the ground it stands on. The curvature that the
/// vehicle happens to follow plays no part: one that ploughs straight on at full lock is short of
/// cornering force.
///
/// Of a turn on the spot: forces are told along the heading and across it; demand is what holds the
/// vehicle on its slope and on the circle of its centre of gravity, and the traction margin is the
/// moment left beyond what scrub takes, over weight and the longest arm of a wheel.
struct StateMargins {
  double demand_n = 0;
  std::optional<SupplyInterval> supply;
  NoSupply no_supply = NoSupply::kTraction;  ///< why, where there is none
  std::optional<TooDeep> too_deep = {};      ///< where that is sinkage
  double tip_over = 0;  ///< at the demand, or the nearest lateral force that the soil can give
  std::optional<double> cornering;  ///< nothing without supply
  std::optional<double> traction;   ///< nothing where the lateral demand has no trim

  /// The smallest of the three; nothing where one of them is missing.
  std::optional<double> stability() const;

  /// The margins as numbers, for sums, charts and tables. Without supply cornering counts as -1.
  /// Beyond the supply no trim gives traction either; there the cornering margin tells by how much.
  double counted_cornering() const;
  double counted_traction() const;
};

/// Where supply and traction come from. One of: `SolvedSupply`, `TabledSupply`.
struct SupplyQuestion {
  double curvature_1pm = 0;
  double crab_rad = 0;
  PathForce force;      ///< demanded, forward and left
  double normal_n = 0;  ///< not above 0: off the ground
  bool reverse = false;
  int turn =
      0;  ///< on the spot: 1 to the left, -1 to the right; then the force is along the heading
  const GroundPatch* patch = nullptr;  ///< the soil under each wheel
};

/// The steady manoeuvre that a question is about. \param laws one for each wheel; all must outlive
/// it
SteadyManoeuvre manoeuvre_of(const Vehicle& vehicle, const LoadSharing& sharing,
                             std::span<const WheelLaw> laws, const SupplyQuestion& question);

struct SupplyAnswer {
  std::optional<SupplyInterval> supply;
  NoSupply no_supply = NoSupply::kTraction;
  std::optional<TooDeep> too_deep = {};
  std::optional<double> traction_n;
};

/// Solves each manoeuvre, every wheel on its own soil.
class SolvedSupply {
 public:
  /// All must outlive it.
  SolvedSupply(const Vehicle& vehicle, const LoadSharing& sharing,
               std::span<const WheelLaw> soil_laws, const TrimLimits& limits)
      : vehicle_(vehicle), sharing_(sharing), soil_laws_(soil_laws), limits_(limits) {}
  SupplyAnswer answer(const SupplyQuestion& question) const;

 private:
  const Vehicle& vehicle_;
  const LoadSharing& sharing_;
  std::span<const WheelLaw> soil_laws_;
  TrimLimits limits_;
};

/// Looks up the table of each soil under a wheel and takes the least. Forward along a path and
/// without crab: of other questions it knows nothing.
class TabledSupply {
 public:
  /// \param tables one for each soil; must outlive it
  explicit TabledSupply(std::span<const SupplyTable> tables) : tables_(tables) {}
  SupplyAnswer answer(const SupplyQuestion& question, std::size_t wheels) const;

 private:
  std::span<const SupplyTable> tables_;
};

/// What a state asks of the ground. It drives in reverse where its rims turn backwards; while they
/// stand still, as its direction at rest tells, so that a stop is judged as the limit of what led
/// to it; where that tells nothing, where it moves backwards or, at rest, is to speed up backwards.
SupplyQuestion question_of(const VehicleDynamics& dynamics, const VehicleState& state,
                           const GroundPatch& patch);

/// The margins of a state whose question was answered.
StateMargins margins_of(const VehicleDynamics& dynamics, const SupportPolygon& polygon,
                        const SupplyQuestion& question, const SupplyAnswer& answer);

}  // namespace regoplan
