#pragma once

#include <limits>
#include <optional>
#include <string_view>

#include "terramech/margins/trim.h"

namespace regoplan {

/// How far trims may go.
struct TrimLimits {
  double slip_angle_max_rad = 0;
  double slip_max = 0;
  double sinkage_max_m = 0;
  double steer_angle_max_rad = 0;  ///< without meaning where no wheel is steered
  double torque_max_nm = std::numeric_limits<double>::infinity();  ///< of each driven wheel
};

/// What ends a branch of steady trims.
enum class BranchLimit {
  kFold,  ///< no trim beyond
  kSlipAngle,
  kSlip,
  kSinkage,
  kSteering,
  kTorque,       ///< of a motor
  kLiftedWheel,  ///< a wheel's load falls to 2 % of the mean
};

/// As it stands in reports: `fold`, `slip angle`, ...
std::string_view name(BranchLimit limit);

/// How much of its limits a trim uses: the limit nearest to being reached (1: reached) and where.
struct LimitUse {
  double used = 0;
  BranchLimit limit = BranchLimit::kFold;
  int wheel = -1;  ///< index in the vehicle's wheels
};
LimitUse limit_use(const Trim& trim, const TrimLimits& limits);

/// How far a branch of steady trims goes along a line of path forces.
struct BranchEnd {
  double p = 0;  ///< position on the line
  SteadyManoeuvre::Point point = SteadyManoeuvre::Point::Zero();
  bool reached_target = false;  ///< else the limit stopped it
  BranchLimit limit = BranchLimit::kFold;
  int wheel = -1;
  std::optional<double> fold_p = {};  ///< where it would fold, limits aside; on request
};

/// Follows the branch of trims from p = 0 toward growing p, by pseudo-arclength continuation, to
/// the first of its limits, its fold, or p = target.
/// \param start a trim at p = 0 \param find_fold goes on beyond the limit to report the fold
BranchEnd follow_branch(const SteadyManoeuvre& manoeuvre, const SteadyManoeuvre::Point& start,
                        const ForceLine& line, double target_p, const TrimLimits& limits,
                        bool find_fold = false);

}  // namespace regoplan
