#pragma once

#include <vector>

#include "app/io/staged_files.h"
#include "planner/chart/feasibility_chart.h"

namespace regoplan {

/// A feasibility chart as feasibility.svg, safe-curvature.csv and side-slope.csv.
std::vector<RenderedFile> render_chart(const ChartSettings& settings,
                                       const FeasibilityChart& chart);

std::vector<std::string> chart_file_names();

}  // namespace regoplan
