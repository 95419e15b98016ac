#include "drive_diagnosis/fit/window_linearisation.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace regoplan {

WindowLinearisation::WindowLinearisation(WindowComparison& comparison,
                                         const std::vector<VehicleTrial>& trials,
                                         const std::vector<std::size_t>& numbers,
                                         const std::stop_token& stop)
    : comparison_(comparison),
      trials_(trials),
      numbers_(numbers),
      stop_(stop),
      anew_(comparison.all()) {}

VehicleDeviation WindowLinearisation::deviation_of(const ContestFit& fit) const {
  VehicleDeviation sum;
  for (std::size_t k = 0; k < trials_.size(); ++k) {
    const double size = fit.parameters[static_cast<Eigen::Index>(k)];
    if (size != 0) sum.add(trials_[k].deviation, size);
  }
  return sum;
}

LinearisedWindows WindowLinearisation::about(const ContestFit& fit,
                                             const std::vector<WindowZone>& zones,
                                             const Eigen::MatrixXd& shifts) {
  const VehicleDeviation here = deviation_of(fit);
  comparison_.shift_inputs(shifts);
  comparison_.start_at(anew_, here, zones, stop_);
  LinearisedWindows result = kept(fit, shifts);
  predict(here, zones, result);
  const Eigen::MatrixXd& base = result.base;
  const std::vector<Eigen::MatrixXd> inputs = comparison_.of_inputs(anew_, here, zones, stop_);
  for (std::size_t k = 0; k < inputs.size(); ++k) result.inputs[k] += inputs[k];
  for (std::size_t k = 0; k < trials_.size(); ++k) {
    VehicleDeviation there = here;
    there.add(trials_[k].deviation, 1);
    result.columns[k] += comparison_.predicted(anew_, there, zones, base, stop_) - base;
  }
  for (std::size_t z = 0; z < zones.size(); ++z) {
    WindowSet in_zone;
    std::ranges::set_intersection(anew_, comparison_.touching(zones[z]),
                                  std::back_inserter(in_zone));
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      std::vector<WindowZone> there = zones;
      there[z].numbers.at(numbers_[k]) += 1;
      result.zones[z][k] += comparison_.predicted(in_zone, here, there, base, stop_) - base;
    }
  }
  // Told of the measured inputs, to first order about the likely ones.
  result.data = comparison_.measured() - base + result.shifted_by(shifts) + result.changed_by(fit);
  return result;
}

void WindowLinearisation::predict_only(WindowSet windows, LinearisedWindows here) {
  anew_ = std::move(windows);
  others_ = std::move(here);
}

void WindowLinearisation::predict_all() {
  anew_ = comparison_.all();
  others_.reset();
}

/// Predicts windows anew; where no motion balances, as map and vehicle are said to be.
void WindowLinearisation::predict(const VehicleDeviation& here,
                                  const std::vector<WindowZone>& zones,
                                  LinearisedWindows& windows) const {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  for (const std::size_t w : anew_) {
    windows.base.row(static_cast<Eigen::Index>(w)).setConstant(kUnknown);
  }
  windows.base = comparison_.predicted(anew_, here, zones, windows.base, stop_);
  windows.unbalanced.clear();
  for (const std::size_t w : anew_) {
    auto row = windows.base.row(static_cast<Eigen::Index>(w));
    if (row.allFinite()) continue;
    row.setZero();
    windows.unbalanced.push_back(w);
  }
  windows.base = comparison_.predicted(windows.unbalanced, {}, {}, windows.base, stop_);
}

/// Windows that are not predicted anew, about a fit: nothing is known of those that are.
LinearisedWindows WindowLinearisation::kept(const ContestFit& fit,
                                            const Eigen::MatrixXd& shifts) const {
  if (!others_) {
    return LinearisedWindows::none(comparison_.measured(), trials_.size(), comparison_.inputs(),
                                   fit.zones.size(), numbers_.size());
  }
  LinearisedWindows windows = *others_;
  windows.base =
      comparison_.measured() + windows.shifted_by(shifts) + windows.changed_by(fit) - windows.data;
  windows.forget(anew_);
  return windows;
}

}  // namespace regoplan
