#include "drive_diagnosis/window_linearisation.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace regoplan {

WindowLinearisation::WindowLinearisation(WindowComparison& comparison,
                                         const std::vector<VehicleTrial>& trials,
                                         std::vector<std::size_t> numbers,
                                         const std::stop_token& stop)
    : comparison_(comparison), trials_(trials), numbers_(std::move(numbers)), stop_(stop) {}

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
  const WindowSet anew = windows_anew(zones);
  comparison_.shift_inputs(shifts);
  comparison_.start_at(anew, here, zones, stop_);
  LinearisedWindows result = kept_but(anew, fit, shifts);
  const Eigen::MatrixXd as_said = comparison_.predicted(anew, {}, {}, result.base, stop_);
  const Eigen::MatrixXd base = comparison_.predicted(anew, here, zones, as_said, stop_);
  result.base = base;
  const std::vector<Eigen::MatrixXd> inputs = comparison_.of_inputs(anew, here, zones, stop_);
  for (std::size_t k = 0; k < inputs.size(); ++k) result.inputs[k] += inputs[k];
  for (std::size_t k = 0; k < trials_.size(); ++k) {
    VehicleDeviation there = here;
    there.add(trials_[k].deviation, 1);
    result.columns[k] += comparison_.predicted(anew, there, zones, base, stop_) - base;
  }
  for (std::size_t z = 0; z < zones.size(); ++z) {
    WindowSet in_zone;
    std::ranges::set_intersection(anew, comparison_.touching(zones[z]),
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

void WindowLinearisation::keep_but_touched(LinearisedWindows here) {
  kept_ = std::move(here);
  touched_.clear();
}

void WindowLinearisation::keep_none() {
  kept_.reset();
}

WindowSet WindowLinearisation::windows_anew(const std::vector<WindowZone>& zones) {
  if (!kept_) return comparison_.all();
  const WindowSet before = std::exchange(touched_, {});
  std::ranges::set_union(before, comparison_.touching(zones.back()), std::back_inserter(touched_));
  return touched_;
}

/// Windows that are kept, about another fit; nothing is known of the others.
LinearisedWindows WindowLinearisation::kept_but(const WindowSet& anew, const ContestFit& fit,
                                                const Eigen::MatrixXd& shifts) const {
  if (!kept_) {
    return LinearisedWindows::none(comparison_.measured(), trials_.size(), comparison_.inputs(),
                                   fit.zones.size(), numbers_.size());
  }
  LinearisedWindows kept = *kept_;
  kept.base = comparison_.measured() + kept.shifted_by(shifts) + kept.changed_by(fit) - kept.data;
  kept.forget(anew);
  return kept;
}

}  // namespace regoplan
