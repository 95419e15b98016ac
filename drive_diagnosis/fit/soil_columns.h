#pragma once

#include <Eigen/Core>
#include <stop_token>
#include <vector>

#include "drive_diagnosis/comparison/window_comparison.h"

namespace regoplan {

/// By number and window: what another soil along that window changes in all of them.
using SoilColumns = std::vector<std::vector<Eigen::MatrixXd>>;

/// What each number of the soil along each window changes, by one deviation of that number. Each
/// wheel is on it while it is there itself: one ahead of the body comes onto it in the window
/// before.
/// \param numbers of soil, by index \param here what is known; \param base what it predicts
/// \throws Interrupted
SoilColumns soil_columns(const WindowComparison& comparison,
                         const std::vector<std::size_t>& numbers, const WindowQuestion& here,
                         const Eigen::MatrixXd& base, const std::stop_token& stop);

}  // namespace regoplan
