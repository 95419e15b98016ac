#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "drive_diagnosis/comparison/vehicle_trials.h"
#include "drive_diagnosis/comparison/window_comparison.h"
#include "drive_diagnosis/fit/linearised_windows.h"

namespace regoplan {

/// Windows about a fit before it is asked what changes them.
struct PredictedWindows {
  /// Without data; of windows that are predicted anew, only what inputs change is known.
  LinearisedWindows windows;
  Eigen::MatrixXd left;  ///< measured less predicted, and less what shifts of inputs explain
  MotionsByWindow motions;
};

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
  /// The same in two steps: most of the time is that of the second, which a fit that leaves more
  /// than another does not need. \throws Interrupted
  PredictedWindows predicted(const ContestFit& fit, const std::vector<WindowZone>& zones,
                             const Eigen::MatrixXd& shifts);
  LinearisedWindows linearised(PredictedWindows here, const ContestFit& fit,
                               const std::vector<WindowZone>& zones) const;
  /// Whether the soil of each zone changes something in its windows: what carries the vehicle
  /// nowhere does not. \throws Interrupted
  bool is_carried(const PredictedWindows& here, const ContestFit& fit,
                  const std::vector<WindowZone>& zones) const;
  /// From now on only these windows are predicted anew about a fit, of as many zones as here; all
  /// others are what they are here, to first order.
  void predict_only(WindowSet windows, LinearisedWindows here);
  /// From now on all windows are predicted anew.
  void predict_all();

 private:
  void predict(const WindowQuestion& here, const MotionsByWindow& motions,
               LinearisedWindows& windows) const;
  static WindowQuestion with_one_more(WindowQuestion here, std::size_t zone, std::size_t number);
  LinearisedWindows kept(const ContestFit& fit, const Eigen::MatrixXd& shifts) const;

  WindowComparison& comparison_;
  const std::vector<VehicleTrial>& trials_;
  const std::vector<std::size_t>& numbers_;
  const std::stop_token& stop_;
  WindowSet anew_;                           ///< windows that are predicted anew
  std::optional<LinearisedWindows> others_;  ///< that the others are taken from
};

}  // namespace regoplan
