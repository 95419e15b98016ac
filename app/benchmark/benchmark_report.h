#pragma once

#include <map>
#include <string>

#include "benchmarking/experiment.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// The verdict of a suite in one sentence.
std::string benchmark_headline(const SuiteResults& results);

/// The terrain of scenarios by their labels.
using ScenarioMaps = std::map<std::string, TerrainMap>;

/// report.html of a suite: success with intervals, profiles, boxes, comparisons, paths over the
/// terrain of those scenarios whose map is given.
std::string benchmark_report(const SuiteResults& results, const ScenarioMaps& maps);

}  // namespace regoplan
