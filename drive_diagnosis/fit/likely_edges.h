#pragma once

#include <Eigen/Core>
#include <array>
#include <stop_token>
#include <vector>

#include "drive_diagnosis/comparison/window_comparison.h"
#include "drive_diagnosis/contest/residual_noise.h"

namespace regoplan {

/// Where a zone begins and ends, in windows, and 95 % of each while its soil is what it is.
struct LikelyEdges {
  double begins = 0, ends = 0;
  std::array<double, 2> begins_ci95{}, ends_ci95{};
};

/// What zones are fitted to, as a fit has it.
struct FittedWindows {
  const WindowComparison& comparison;
  const VehicleDeviation& deviation;
  Eigen::MatrixXd measured;  ///< less what the scatter of inputs explains
  Eigen::MatrixXd predicted;
  const ResidualNoise& noise;
};

/// The edges of the last of these zones that make what is measured likeliest, within a window of
/// where they are: by quarters of a window, then finer. A window is never cut out of a zone by a
/// motion that does not balance.
/// \throws Interrupted
LikelyEdges likely_edges(const FittedWindows& windows, std::vector<WindowZone> zones,
                         const std::stop_token& stop);

}  // namespace regoplan
