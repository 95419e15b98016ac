#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "planner/evaluation/path_tracking.h"
#include "planner/soils/soil_uncertainty.h"
#include "planner/soils/standing.h"

namespace regoplan {

struct EvaluationSettings {
  FollowerChoice follower;
  /// How far the vehicle may stray from a path; half of its body's width where none is given.
  std::optional<double> deviation_max_m;
  int soil_draws = 1000;
  std::uint64_t seed = 1;
  int threads = 2;
  std::stop_token stop = {};  ///< what it interrupts is worth nothing
};

/// \throws ValueError naming the field and its range
void validate(const EvaluationSettings& settings);

/// Half of the body's width.
double default_deviation_max_m(const Vehicle& vehicle);

/// What a margin of a place hangs on: which end of the supply the demand is nearer to, and what
/// ends the branch of trims there.
struct CorneringLimit {
  BranchLimit limit = BranchLimit::kFold;
  std::string wheel;  ///< its name; empty where the limit is no wheel's
  double supply_n = 0;
  std::optional<double> fold_n;  ///< the fold beyond, limits aside
};

/// The first thing on the way that forbids a path.
struct Refusal {
  bool while_tracking = false;  ///< else of the commanded path itself
  bool while_stopping = false;  ///< beyond its end, where a drive that arrives at speed stops
  Rejection reason = Rejection::kBounds;
  double x_m = 0, y_m = 0;
  double s_m = 0, time_s = 0;
  std::optional<Exceeded> exceeded = {};
};

/// Why, with place and numbers, in a sentence without its stop.
std::string sentence(const Refusal& refusal);

/// What is thought of a path.
struct PathEvaluation {
  std::string name;
  int rank = 0;  ///< from 1
  bool feasible = false;
  std::optional<Refusal> refusal;
  double length_m = 0;
  double duration_s = 0;  ///< of the commanded speeds
  double speed_max_mps = 0;
  std::vector<double> s_m;              ///< of each of `points`
  std::vector<TrajectoryPoint> points;  ///< the commanded path; strains are those of the run, NaN
                                        ///< where there is none
  double margin_min = 0;                ///< what is missing counts as -1
  PathMargins margins;                  ///< the smallest of each
  double margin_worst_tenth = 0;
  LimitingPlace limiting;
  std::optional<CorneringLimit> cornering_limit;  ///< there
  TrackingRun tracking;
  double deviation_allowed_m = 0;
  /// Nothing where a place of the path has no margins whatever the soils: on unknown ground, off
  /// the map, sharper than the steering. Then the margins of the whole path are none either.
  std::optional<SoilSpread> spread;
  std::vector<std::string> notices;
};

/// A place of a course, as the steady manoeuvre that is commanded there.
struct Station {
  double s_m = 0, time_s = 0;
  VehicleState state;
};

/// A course told by its stations, and how it went when it was driven.
struct DrivenCourse {
  std::string name;
  double length_m = 0;
  double duration_s = 0;
  double speed_max_mps = 0;
  std::vector<Station> stations;  ///< at least two
  TrackingRun run;
  double deviation_allowed_m = 0;
  std::optional<RejectedState> refused_stop = {};  ///< why it cannot stop at its end
};
PathEvaluation judged(const World& verdict, const DrivenCourse& course,
                      const EvaluationSettings& settings);

/// Judges a path twice: as the sequence of steady manoeuvres that it commands, at stations at most
/// half a metre apart as well as where, between two, the curve is sharper or speed lost or gathered
/// harder (at the moments of its record, where it has one), and by driving it in closed loop.
/// Feasible where both hold, and the vehicle can then stop. \param verdict a world for verdicts
/// \throws ValueError as `validate(settings)` and `validate(path)`
PathEvaluation evaluate(const World& verdict, const ReferencePath& path,
                        const EvaluationSettings& settings);

/// What evaluations rank by: feasible ones first, then as candidates do.
Standing standing_of(const PathEvaluation& evaluation);

}  // namespace regoplan
