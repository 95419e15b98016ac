#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command/command.h"
#include "app/demo/hidden_patch.h"
#include "app/diagnose_drive/drive_diagnosis_files.h"
#include "app/drive/drive_files.h"
#include "app/settings/scenario_settings.h"
#include "planner/evaluation/evaluation.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// What `evaluate` says of a planned path over the map as it was known, and as it was corrected.
struct VerdictChange {
  int candidate = 0;
  PathEvaluation before, after;

  bool flips() const { return holds(before) != holds(after); }

  /// Feasible, and its margins are kept in 95 % of the draws of the soils.
  static bool holds(const PathEvaluation& evaluation) {
    constexpr double kShare = 0.95;
    const auto& spread = evaluation.spread;
    return evaluation.feasible &&
           (!spread || spread->draws == 0 || spread->feasible.share >= kShare);
  }
};

/// Plan, drive, diagnosis, corrected map, plan again, drive again.
struct ClosedLoop {
  HiddenPatch hidden;
  DriveRecord first;
  DriveDiagnosisRun diagnosis;
  std::vector<VerdictChange> verdicts;
  PlanResult second_plan;
  std::optional<DriveRecord> second;  ///< nothing where the second plan has no path
};

struct LoopSettings {
  ResultFolder plan;  ///< where the first plan lies; the loop's files go to `drive` in it
  ScenarioOverrides overrides;
  bool quiet = false;
};

/// Drives the best candidate of a plan over ground that hides a weak patch, diagnoses the drive,
/// plans again over what it told and drives that, writing `drive/` and saying how it goes.
/// \param plan with a candidate, written to the folder
/// \returns kInterrupted where it was, with what was written by then; else kYes
ExitStatus close_the_loop(const PlanningProblem& known, const PlanResult& plan,
                          const LoopSettings& settings);

/// What becomes of the loop's folder: files that could not be replaced are told before long work.
/// \throws InputError
void require_loop_fits(const ResultFolder& plan);

}  // namespace regoplan
