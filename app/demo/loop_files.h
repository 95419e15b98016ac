#pragma once

#include <string>
#include <vector>

#include "app/demo/closed_loop.h"

namespace regoplan {

/// What the loop came to, in a sentence.
std::string loop_headline(const ClosedLoop& loop);

/// What loop.json holds, docs/demo.md.
std::string loop_json(const ClosedLoop& loop, const PlanningProblem& known);

/// Writes loop.json and report.html, the page of before and after, all or none.
/// \throws InputError where the folder takes no files
void write_loop_files(const PlanningProblem& known, const ClosedLoop& loop,
                      const ResultFolder& folder);
std::vector<std::string> loop_file_names();

}  // namespace regoplan
