#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/problem/margin_spread.h"
#include "planner/problem/planning_problem.h"
#include "planner/problem/rejection.h"
#include "planner/problem/terrain_rasters.h"

namespace regoplan {

/// A vehicle on its way, with everything that decides about it. Demand, supply and margins as
/// defined for a steady manoeuvre with the commanded curvature of this moment.
struct TrajectoryPoint {
  double time_s = 0;
  double x_m = 0;  ///< ground point below the centre of gravity, map frame
  double y_m = 0;
  double z_m = 0;
  double yaw_rad = 0;
  double speed_mps = 0;  ///< forward, negative in reverse
  double yaw_rate_rad_s = 0;
  double steer_rad = 0;          ///< largest steering angle of a wheel, signed, left positive
  double curvature_1pm = 0;      ///< commanded
  double acceleration_mps2 = 0;  ///< commanded, of the rim speed
  double slip_max = 0;           ///< of the wheels, by magnitude, signed
  double slip_angle_max_rad = 0;
  double sinkage_max_m = 0;
  double torque_max_nm = 0;  ///< of the wheels, by magnitude, signed, driving positive
  /// That the drives have given since the start; NaN of a point that nobody has driven.
  double energy_j = std::numeric_limits<double>::quiet_NaN();
  int soil = -1;  ///< index in the map's soils, below the centre of gravity
  double demand_n = 0;
  double supply_min_n = 0;
  double supply_max_n = 0;
  double cornering_margin = 0;
  double tip_over_margin = 0;
  double traction_margin = 0;
  double margin = 0;  ///< the smallest of the three
};

/// One piece of a control history: targets that rim speed and steering move to at the vehicle's
/// limited rates.
struct ControlSegment {
  double duration_s = 0;
  double speed_target_mps = 0;
  double curvature_target_1pm = 0;
};

enum class MarginKind { kCornering, kTipOver, kTraction };
std::string_view name(MarginKind kind);  ///< `cornering`, `tip_over`, `traction`

/// The place along a candidate with the smallest stability margin.
struct LimitingPlace {
  MarginKind margin = MarginKind::kCornering;
  double x_m = 0;
  double y_m = 0;
  double time_s = 0;
};

/// The replay of a candidate with the direct wheel model and a ten times finer step.
struct Verification {
  bool passed = false;
  std::string reason;  ///< why it did not pass, with the place
  double margin_min = 0;
  double deviation_max_m = 0;  ///< between the searched and the replayed path, at equal times
};

/// What optimising its controls did to a path, in the units of the objective.
struct Improvement {
  double cost_before = 0;
  double cost_after = 0;
};

struct Candidate {
  int rank = 0;  ///< from 1; 0 of a path that was not ranked
  std::string planner;
  std::uint64_t seed = 0;
  bool off_doubtful_soils = false;  ///< searched where the map's doubtful soils are forbidden
  std::vector<ControlSegment> controls;
  std::optional<Improvement> improvement;  ///< where it is not as the search found it
  std::vector<TrajectoryPoint> points;     ///< of the replay
  double length_m = 0;
  double duration_s = 0;
  double energy_j = 0;
  double margin_min = 0;
  double margin_worst_tenth = 0;       ///< mean over the worst 10 % of the length
  std::optional<MarginSpread> spread;  ///< over the soils' draws, once there are some
  LimitingPlace limiting;
  Verification verified;
};

/// The best candidate under other circumstances: what carries its feasibility.
struct WhatIf {
  std::string question;  ///< "the same path at twice its speed", ...
  bool feasible = false;
  std::optional<Rejection> reason;  ///< the first that fails, with its place
  double x_m = 0;
  double y_m = 0;
  double time_s = 0;
  double margin_min = 0;
  std::optional<double> end_shift_m;  ///< how far away the same controls end
  /// Where the same controls lead: x_m, y_m of a few hundred places.
  std::vector<std::array<double, 2>> driven;
  std::optional<Probability> probability;  ///< over the soils' draws, where they are asked
};

/// What was given up of a problem without a path, and what a brief search then found.
struct RelaxedAnswer {
  std::string given_up;             ///< "with slope_max_deg 25", ...
  std::optional<Candidate> opened;  ///< a path that it opens, verified; nothing: none was found
};

enum class PlanStatus { kFeasible, kInfeasible, kUndecided };
std::string_view name(PlanStatus status);  ///< `feasible`, `infeasible`, `undecided`

/// What a part of a plan took.
struct TimedStep {
  std::string_view step;  ///< in words of the program, that outlive it
  double time_s = 0;
};

struct PlanResult {
  PlanStatus status = PlanStatus::kUndecided;
  std::string reason;
  std::optional<std::string> certificate;
  std::vector<Candidate> candidates;  ///< verified, in rank order
  std::vector<Candidate> overturned;  ///< found, but failed verification
  /// Soils that may not bear the vehicle (`doubtful_soils`): every other search kept off them.
  std::vector<std::string> doubtful_soils;
  std::vector<WhatIf> what_ifs;        ///< of the best candidate
  std::vector<RelaxedAnswer> relaxed;  ///< without a path: what would open the way, and would not
  std::array<std::int64_t, kRejectionCount> rejected{};  ///< states, by first reason
  std::vector<RejectedState> rejected_states;            ///< an even sample of them for display
  std::optional<TerrainRasters> rasters;  ///< where a search was made, and time left for them
  std::int64_t propagations = 0;
  /// No path of this problem is faster (`least_duration_s`), where that was worked out.
  std::optional<double> least_duration_s;
  std::vector<TimedStep> before_search;    ///< since the plan's start, in order
  double planning_time_s = 0;              ///< from the first search's start to the last one's end
  double verification_time_s = 0;          ///< from then on: replays, improvement and soil draws
  std::optional<double> first_verified_s;  ///< since the plan's start, of the first verified path
  std::uint64_t seed = 0;
  bool interrupted = false;
};

/// The shortest time of the candidates; nothing where there are none.
std::optional<double> fastest_duration_s(const PlanResult& result);

/// How far the fastest candidate may be from the fastest path that there is, as a share of its own
/// time: (time - bound) / time, as solvers of optimisation problems state it.
std::optional<double> duration_gap(const PlanResult& result);

}  // namespace regoplan
