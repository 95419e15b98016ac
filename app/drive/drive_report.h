#pragma once

#include <string>

#include "app/drive/drive_files.h"

namespace regoplan {

/// A drive for people: one self-contained HTML page with planned and driven path on the map, the
/// places where limits were broken, and charts along the way.
///
/// Of a long drive about 1000 rows are drawn: the first, the last and from each stretch those in
/// which cross-track error, slip, slip angle, sinkage and margin are worst.
std::string drive_report(const PlanningProblem& problem, const ReferencePath& path,
                         const DriveRecord& record, const TrueWorld& world);

}  // namespace regoplan
