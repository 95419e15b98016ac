#pragma once

#include <Eigen/Core>

#include "drive_diagnosis/comparison/window_comparison.h"

namespace regoplan {

/// Whether measured pitch and roll go with those of the map's ground, whatever the factor: their
/// correlation over all windows, beside the mean of each, is above .9. Not where neither was told,
/// nor over another ground, nor on level ground, where noise is all there is.
/// \param as_said what is predicted of map and vehicle as they are said to be
bool attitude_follows_map(const WindowComparison& comparison, const Eigen::MatrixXd& as_said);

}  // namespace regoplan
