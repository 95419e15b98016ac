#include "terramech/margins/supply.h"

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

/// No steady lateral or forward force comes near this many times the load.
constexpr double kBeyondReach = 20;

/// From no lateral force to the given direction: 1 left, -1 right. p counts loads.
ForceLine sideways(const SteadyManoeuvre& manoeuvre, double forward_n, double direction) {
  return {.from = {.forward_n = forward_n, .left_n = 0},
          .per_unit = {.forward_n = 0, .left_n = direction * manoeuvre.normal_n()}};
}

SupplyEnd end_of(const SteadyManoeuvre& manoeuvre, const SteadyManoeuvre::Point& start,
                 double forward_n, double direction, const TrimLimits& limits, bool find_fold) {
  const ForceLine line = sideways(manoeuvre, forward_n, direction);
  const BranchEnd end = follow_branch(manoeuvre, start, line, kBeyondReach, limits, find_fold);
  SupplyEnd supply{.force_n = line.at(end.p).left_n, .limit = end.limit, .wheel = end.wheel};
  if (end.fold_p) supply.fold_n = line.at(*end.fold_p).left_n;
  if (end.wheel >= 0) {
    supply.axle_x_m = manoeuvre.vehicle().wheels[static_cast<std::size_t>(end.wheel)].x_m;
  }
  supply.understeer_1pm =
      direction * (manoeuvre.steer_curvature_1pm(end.point) - manoeuvre.curvature_1pm());
  return supply;
}

NoSupply reason_for(BranchLimit limit) {
  const bool of_drive = limit == BranchLimit::kSlip || limit == BranchLimit::kTorque;
  return of_drive ? NoSupply::kTraction : NoSupply::kYaw;
}

double deepest_sinkage_m(const Trim& trim) {
  double deepest_m = 0;
  for (const TrimmedWheel& wheel : trim.wheels) {
    deepest_m = std::max(deepest_m, wheel.forces.sinkage_m);
  }
  return deepest_m;
}

}  // namespace

std::string_view name(NoSupply reason) {
  switch (reason) {
    case NoSupply::kSinkage:
      return "sinkage";
    case NoSupply::kTraction:
      return "traction";
    case NoSupply::kYaw:
      return "yaw";
  }
  return "";
}

SupplyResult cornering_supply(const SteadyManoeuvre& manoeuvre, double forward_n,
                              const TrimLimits& limits, bool find_folds) {
  const ForceLine left = sideways(manoeuvre, forward_n, 1);
  const auto start = manoeuvre.solve_from_rolling(left);
  const std::optional<Trim> trim =
      start ? std::optional(manoeuvre.trim(*start, left)) : std::nullopt;
  const double deepest_m = trim ? deepest_sinkage_m(*trim) : manoeuvre.rolling_sinkage_m(left);
  const double allowed_m =
      std::min(limits.sinkage_max_m, manoeuvre.vehicle().wheel.radius_m);  // at most to the axle
  // No force mends that: it is told before all else.
  if (deepest_m >= allowed_m) {
    return {.supply = {},
            .reason = NoSupply::kSinkage,
            .too_deep = TooDeep{.sinkage_m = deepest_m, .allowed_m = allowed_m}};
  }
  if (!trim) return {.supply = {}, .reason = NoSupply::kTraction};
  const LimitUse use = limit_use(*trim, limits);
  if (use.used >= 1) return {.supply = {}, .reason = reason_for(use.limit)};
  return {.supply = Supply{.right = end_of(manoeuvre, *start, forward_n, -1, limits, find_folds),
                           .left = end_of(manoeuvre, *start, forward_n, 1, limits, find_folds)}};
}

std::optional<double> largest_traction_n(const SteadyManoeuvre& manoeuvre, const PathForce& force,
                                         const TrimLimits& limits) {
  const double normal = manoeuvre.normal_n();
  const ForceLine across{
      .from = {.forward_n = force.forward_n, .left_n = 0},
      .per_unit = {.forward_n = 0, .left_n = std::copysign(normal, force.left_n)}};
  const auto start = manoeuvre.solve_from_rolling(across);
  if (!start) return std::nullopt;
  const BranchEnd there =
      follow_branch(manoeuvre, *start, across, std::abs(force.left_n) / normal, limits);
  if (!there.reached_target) return std::nullopt;
  const PathForce ahead = manoeuvre.ahead();
  const ForceLine along{
      .from = force,
      .per_unit = {.forward_n = normal * ahead.forward_n, .yaw_nm = normal * ahead.yaw_nm}};
  SteadyManoeuvre::Point at = there.point;
  at[3] = 0;
  const BranchEnd end = follow_branch(manoeuvre, at, along, kBeyondReach, limits);
  return manoeuvre.ahead_n(force) + end.p * normal;
}

}  // namespace regoplan
