#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "drive_diagnosis/linearised_windows.h"
#include "drive_diagnosis/vehicle_trials.h"
#include "drive_diagnosis/window_comparison.h"

namespace regoplan {

/// Predicts a drive's windows, and what changes them, about one fit after the other.
class WindowLinearisation {
 public:
  /// All must outlive it. \param numbers indices of soils' numbers that vary
  WindowLinearisation(WindowComparison& comparison, const std::vector<VehicleTrial>& trials,
                      std::vector<std::size_t> numbers, const std::stop_token& stop);

  /// The parameters of a fit.
  VehicleDeviation deviation_of(const ContestFit& fit) const;
  /// Windows about a fit. \param zones those of the fit
  /// \param shifts of the inputs, by window and input, in deviations of each
  /// \throws Interrupted
  LinearisedWindows about(const ContestFit& fit, const std::vector<WindowZone>& zones,
                          const Eigen::MatrixXd& shifts);
  /// From now on windows are predicted anew only if the last zone has touched them since; all
  /// others are what they are here, to first order. A tenth of the windows is often enough.
  void keep_but_touched(LinearisedWindows here);
  /// From now on all windows are predicted anew.
  void keep_none();

 private:
  WindowSet windows_anew(const std::vector<WindowZone>& zones);
  LinearisedWindows kept_but(const WindowSet& anew, const ContestFit& fit,
                             const Eigen::MatrixXd& shifts) const;

  WindowComparison& comparison_;
  const std::vector<VehicleTrial>& trials_;
  std::vector<std::size_t> numbers_;
  const std::stop_token& stop_;
  std::optional<LinearisedWindows> kept_;
  WindowSet touched_;  ///< by the last zone since
};

}  // namespace regoplan
