#pragma once

#include <Eigen/Core>
#include <vector>

#include "drive_diagnosis/comparison/window_comparison.h"
#include "drive_diagnosis/contest/effect_contest.h"

namespace regoplan {

/// What is measured and what changes it, about a fit: each matrix by window and channel.
struct LinearisedWindows {
  Eigen::MatrixXd data;  ///< measured less predicted, plus what parameters and inputs stand for
  Eigen::MatrixXd base;  ///< predicted
  std::vector<Eigen::MatrixXd> columns;             ///< what each parameter changes
  std::vector<Eigen::MatrixXd> inputs;              ///< what each input's scatter changes
  std::vector<std::vector<Eigen::MatrixXd>> zones;  ///< of each, what its soil's numbers change

  /// Windows in which the model has no motion about the fit: predicted as the map and the vehicle
  /// are said to be, and what changes them is a jump and no slope.
  WindowSet unbalanced;

  /// All 0, of as many windows and channels as `alike` has. \param numbers of each zone's soil
  static LinearisedWindows none(const Eigen::MatrixXd& alike, std::size_t parameters,
                                std::size_t inputs, std::size_t zones, std::size_t numbers);
  /// What the parameters and zones of a fit change, to first order.
  Eigen::MatrixXd changed_by(const ContestFit& fit) const;
  /// What inputs off the measured ones change, to first order. \param shifts by window and input
  Eigen::MatrixXd shifted_by(const Eigen::MatrixXd& shifts) const;
  /// Sets all that is known of these windows to 0.
  void forget(const WindowSet& windows);
};

}  // namespace regoplan
