#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/io/staged_files.h"
#include "app/settings/earlier_plan.h"
#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Where a plan came from.
struct PlanOrigin {
  std::vector<InputDigest> inputs = {};
  std::optional<EarlierPlan> again = {};  ///< the plan that it repeats
};

/// The text of plan.json, to lie in `folder`. Two runs of the same problem under an iteration
/// budget differ in `before_search`, `planning_time_s`, `verification_time_s` and
/// `first_verified_s` only.
std::string plan_json(const PlanningProblem& problem, const PlanResult& result,
                      const PlanOrigin& origin = {}, const std::filesystem::path& folder = {});

/// The table of a candidate's points: candidate-K.csv.
std::string candidate_csv(const PlanningProblem& problem, const Candidate& candidate);

/// A candidate's path in map coordinates, GeoJSON with a `crs` member: candidate-K.geojson.
std::string candidate_geojson(const PlanningProblem& problem, const Candidate& candidate);

/// The files that a plan of this problem may come to.
std::vector<std::string> plan_file_names(const PlanningProblem& problem);

/// Writes plan.json, candidate-K.csv, candidate-K.geojson, report.html, and where the plan has them
/// as GeoTIFF in the map's place margin.tif, probability.tif and supply.tif, a band for each speed
/// (see `TerrainRasters`), all or none. Takes away the candidate files and rasters of an earlier
/// plan in the same folder that are not written again. \throws InputError where the folder takes no
/// files
void write_plan_files(const PlanningProblem& problem, const PlanResult& result,
                      const ResultFolder& folder, const PlanOrigin& origin = {});

}  // namespace regoplan
