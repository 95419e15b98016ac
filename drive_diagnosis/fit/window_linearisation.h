#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "drive_diagnosis/comparison/vehicle_trials.h"
#include "drive_diagnosis/comparison/window_comparison.h"
#include "drive_diagnosis/fit/linearised_windows.h"

namespace regoplan {

/// Predicts a drive's windows, and what changes them, about one fit after the other.
class WindowLinearisation {
 public:
  /// All must outlive it. \param numbers indices of soils' numbers that vary
  WindowLinearisation(WindowComparison& comparison, const std::vector<VehicleTrial>& trials,
                      const std::vector<std::size_t>& numbers, const std::stop_token& stop);

  /// The parameters of a fit.
  VehicleDeviation deviation_of(const ContestFit& fit) const;
  /// Windows about a fit. \param zones those of the fit
  /// \param shifts of the inputs, by window and input, in deviations of each
  /// \throws Interrupted
  LinearisedWindows about(const ContestFit& fit, const std::vector<WindowZone>& zones,
                          const Eigen::MatrixXd& shifts);
  /// From now on only these windows are predicted anew about a fit, of as many zones as here; all
  /// others are what they are here, to first order.
  void predict_only(WindowSet windows, LinearisedWindows here);
  /// From now on all windows are predicted anew.
  void predict_all();

 private:
  void predict(const VehicleDeviation& here, const std::vector<WindowZone>& zones,
               LinearisedWindows& windows) const;
  LinearisedWindows kept(const ContestFit& fit, const Eigen::MatrixXd& shifts) const;

  WindowComparison& comparison_;
  const std::vector<VehicleTrial>& trials_;
  const std::vector<std::size_t>& numbers_;
  const std::stop_token& stop_;
  WindowSet anew_;                           ///< windows that are predicted anew
  std::optional<LinearisedWindows> others_;  ///< that the others are taken from
};

}  // namespace regoplan
