#pragma once

#include <string>

#include "app/evaluate/evaluation_files.h"

namespace regoplan {

/// Sections of the page of an evaluation, which say in HTML what its figures draw.

/// A row of short cells for each path, and room for what its margins spread over.
std::string side_by_side_html(const EvaluationResult& result);

/// Each path in sentences, with room for its drawing.
std::string courses_html(const EvaluationResult& result);

std::string method_html(const EvaluationResult& result);

}  // namespace regoplan
