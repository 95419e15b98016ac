#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/io/staged_files.h"
#include "app/settings/input_files.h"
#include "planner/evaluation/evaluation.h"
#include "planner/problem/plan_result.h"

namespace regoplan {

/// What a manoeuvre was driven on.
struct ManoeuvrePlane {
  double slope_rad = 0;
  double uphill_rad = 0;     ///< its heading, from the heading at the start, left positive
  bool on_the_spot = false;  ///< a turn there, without a way
};

/// An evaluation with where its path came from.
struct EvaluatedPath {
  PathEvaluation evaluation;
  std::optional<ManoeuvrePlane> plane;  ///< of a manoeuvre; else the path lies on the map
  std::string vehicle;
  double gravity_mps2 = 0;
  Limits limits;
  std::optional<double> recorded_margin_min;  ///< of a candidate of `plan`
};

struct EvaluationResult {
  std::vector<EvaluatedPath> paths;  ///< in rank order
  EvaluationSettings settings;
  double speed_max_mps = 0;              ///< that paths were judged by where they give no speed
  std::vector<Vehicle> vehicles = {};    ///< that manoeuvres have in place of the scenario's
  std::vector<InputDigest> inputs = {};  ///< what it was read from, the scenario first
  double evaluation_time_s = 0;
  bool interrupted = false;

  bool any_feasible() const;

  /// Feasible where any path is; undecided where none is and some were not judged.
  PlanStatus status() const;
};

/// Feasible ones first, see `rank` of evaluations.
void rank(EvaluationResult& result);

/// The text of evaluation.json, to lie in `folder`.
std::string evaluation_json(const PlanningProblem& problem, const EvaluationResult& result,
                            const std::filesystem::path& folder = {});

/// The steering law with its gains, in a sentence.
std::string steering_law_text(const SteeringLaw& law);

/// Writes evaluation.json and report.html, both or none.
/// \throws InputError where the folder takes no files
void write_evaluation_files(const PlanningProblem& problem, const EvaluationResult& result,
                            const ResultFolder& folder);

}  // namespace regoplan
