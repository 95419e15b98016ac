#pragma once

#include <string>
#include <vector>

#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// The verdict in one sentence, with the margin of the best candidate and what binds it.
/// Where fewer draws of the soils hold than are asked for (`is_doubtful`), it says so first.
std::string plan_headline(const PlanResult& result, const Limits& limits);

/// A result for people: one self-contained HTML page with the verdict, the candidates on the map,
/// what decides along each of them, what was rejected and why, and how it was decided. Its data
/// stand in it as JSON, with the key names and units of `plan.json`.
std::string plan_report(const PlanningProblem& problem, const PlanResult& result);

/// Which ranks are none, as the draws of the soils, or without draws the margins at their means,
/// cannot tell their paths apart; empty where each is one.
std::string tie_sentence(const std::vector<Candidate>& ranked);

}  // namespace regoplan
