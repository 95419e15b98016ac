#pragma once

#include <string>

#include "app/evaluate/evaluation_files.h"

namespace regoplan {

/// The verdict in one sentence.
std::string evaluation_headline(const EvaluationResult& result);

/// The evaluations side by side, for people: one self-contained HTML page; paths on the scenario's
/// map also as a picture and as charts along them.
std::string evaluation_report(const PlanningProblem& problem, const EvaluationResult& result);

}  // namespace regoplan
