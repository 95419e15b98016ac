#pragma once

#include <nlohmann/json.hpp>

#include "app/evaluate/evaluation_files.h"

namespace regoplan {

/// What the page of an evaluation draws of each path, on a map or not: what its margins spread over
/// and where it leads, about two hundred points of it.
nlohmann::json courses_data(const EvaluationResult& result);

}  // namespace regoplan
