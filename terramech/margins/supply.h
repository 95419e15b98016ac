#pragma once

#include <optional>
#include <string_view>

#include "terramech/margins/trim_branch.h"

namespace regoplan {

/// One end of the supply interval.
struct SupplyEnd {
  double force_n = 0;  ///< signed, left positive
  BranchLimit limit = BranchLimit::kFold;
  int wheel = -1;  ///< which wheel reaches the limit, as index in the vehicle's wheels
  std::optional<double> fold_n = {};
  /// x of the axle that lets go first: that of the wheel that reaches its limit.
  double axle_x_m = 0;
  /// How the vehicle handles there: curvature that the steering is set for beyond that of the path,
  /// counted toward the force. Positive: it must be steered further in (understeer); negative: back
  /// (oversteer).
  double understeer_1pm = 0;
};

/// Why there is no supply at all.
enum class NoSupply {
  kSinkage,   ///< it takes no force, but a wheel sinks deeper than it may
  kTraction,  ///< the forward force cannot be had, or not within slip and motor torque
  kYaw,       ///< no balance of the yaw moment, or not within slip angle and steering range
};

/// As it stands in reports: `sinkage`, `traction`, `yaw`.
std::string_view name(NoSupply reason);

/// The lateral forces [A-, A+] that steady trims can give while curvature, load and forward force
/// are held: the ends of the branch of trims connected to zero lateral force, out to the first of
/// fold, slip angle, slip, sinkage, steering range and a lifted wheel.
struct Supply {
  SupplyEnd right;  ///< A-, normally negative
  SupplyEnd left;   ///< A+, normally positive
};

/// How deep a wheel sinks in a trim, or where it rolls slip-free if there is none, and how deep it
/// may. Of a wheel that nothing carries: its radius.
struct TooDeep {
  double sinkage_m = 0;
  double allowed_m = 0;
};

struct SupplyResult {
  std::optional<Supply> supply;
  NoSupply reason = NoSupply::kTraction;  ///< counts where there is none
  std::optional<TooDeep> too_deep = {};   ///< where the reason is sinkage
};

/// Of a turn on the spot: the forces to the vehicle's left.
/// \param forward_n sum of the wheels' forces along the path (vehicle's forward): acceleration and
/// slope \param find_folds also reports the folds beyond the limits
SupplyResult cornering_supply(const SteadyManoeuvre& manoeuvre, double forward_n,
                              const TrimLimits& limits, bool find_folds = false);

/// The largest force along the direction of travel that trims with the given lateral force can
/// give: along the branch connected to `force`, out to the first of fold and limits. Signed in the
/// direction of travel; nothing where the lateral force itself has no trim within the limits.
/// Of a turn on the spot: the largest moment beyond what scrub takes, with the given forces along
/// and across held, over the longest arm of a wheel.
std::optional<double> largest_traction_n(const SteadyManoeuvre& manoeuvre, const PathForce& force,
                                         const TrimLimits& limits);

}  // namespace regoplan
