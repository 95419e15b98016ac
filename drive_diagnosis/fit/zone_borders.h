#pragma once

#include <Eigen/Core>
#include <stop_token>
#include <vector>

#include "drive_diagnosis/comparison/window_comparison.h"
#include "drive_diagnosis/fit/likely_edges.h"

namespace regoplan {

/// Windows in which a wheel comes onto one of these zones or leaves it, as nearly as that is told.
WindowSet windows_at_borders(const WindowComparison& comparison,
                             const std::vector<WindowZone>& zones);

/// By window and channel, what the borders of these zones change that lie so far off and are
/// crossed at such another angle: in the windows where wheels come onto them, the data cannot hold
/// the soil to more than that. \throws Interrupted
Eigen::MatrixXd border_std(const WindowComparison& comparison, const WindowQuestion& here,
                           const EdgesErr& err, const std::stop_token& stop);

}  // namespace regoplan
