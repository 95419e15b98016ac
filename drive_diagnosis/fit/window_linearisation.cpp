#include "drive_diagnosis/fit/window_linearisation.h"

#include <algorithm>
#include <iterator>
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
  return linearised(predicted(fit, zones, shifts), fit, zones);
}

PredictedWindows WindowLinearisation::predicted(const ContestFit& fit,
                                                const std::vector<WindowZone>& zones,
                                                const Eigen::MatrixXd& shifts) {
  const WindowQuestion here{deviation_of(fit), zones};
  comparison_.shift_inputs(shifts);
  comparison_.start_at(anew_, here.deviation, zones, stop_);
  PredictedWindows result{
      .windows = kept(fit, shifts), .left = {}, .motions = comparison_.motions(anew_, here, stop_)};
  predict(here, result.motions, result.windows);
  const std::vector<Eigen::MatrixXd> inputs = comparison_.of_inputs(anew_, result.motions, stop_);
  for (std::size_t k = 0; k < inputs.size(); ++k) result.windows.inputs[k] += inputs[k];
  result.left = comparison_.measured() - result.windows.base + result.windows.shifted_by(shifts);
  return result;
}

LinearisedWindows WindowLinearisation::linearised(PredictedWindows here, const ContestFit& fit,
                                                  const std::vector<WindowZone>& zones) const {
  LinearisedWindows result = std::move(here.windows);
  const WindowQuestion about{deviation_of(fit), zones};
  std::vector<WindowQuestion> questions;
  for (const VehicleTrial& trial : trials_) {
    questions.push_back(about);
    questions.back().deviation.add(trial.deviation, 1);
  }
  for (std::size_t z = 0; z < zones.size(); ++z) {
    for (const std::size_t number : numbers_) questions.push_back(with_one_more(about, z, number));
  }
  const std::vector<Eigen::MatrixXd> there =
      comparison_.predicted(anew_, questions, result.base, here.motions, stop_);
  auto next = there.begin();
  for (Eigen::MatrixXd& column : result.columns) column += *next++ - result.base;
  for (std::vector<Eigen::MatrixXd>& numbers : result.zones) {
    for (Eigen::MatrixXd& number : numbers) number += *next++ - result.base;
  }
  // Told of the measured inputs, to first order about the likely ones.
  result.data = here.left + result.changed_by(fit);
  return result;
}

bool WindowLinearisation::is_carried(const PredictedWindows& here, const ContestFit& fit,
                                     const std::vector<WindowZone>& zones) const {
  const WindowQuestion about{deviation_of(fit), zones};
  const auto changes = [&](const WindowSet& windows, std::size_t zone, std::size_t number) {
    if (!here.windows.zones[zone][number].isZero(0)) return true;
    const std::vector<Eigen::MatrixXd> there =
        comparison_.predicted(windows, {with_one_more(about, zone, numbers_[number])},
                              here.windows.base, here.motions, stop_);
    return there.front() != here.windows.base;
  };
  const auto any_changes = [&](const WindowSet& windows, std::size_t zone) {
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      if (changes(windows, zone, k)) return true;
    }
    return false;
  };
  // Windows that have no motion take many times as long, and are seldom needed.
  WindowSet balanced;
  std::ranges::set_difference(anew_, here.windows.unbalanced, std::back_inserter(balanced));
  for (std::size_t z = 0; z < zones.size(); ++z) {
    if (!any_changes(balanced, z) && !any_changes(here.windows.unbalanced, z)) return false;
  }
  return true;
}

WindowQuestion WindowLinearisation::with_one_more(WindowQuestion here, std::size_t zone,
                                                  std::size_t number) {
  here.zones[zone].numbers.at(number) += 1;
  return here;
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
void WindowLinearisation::predict(const WindowQuestion& here, const MotionsByWindow& motions,
                                  LinearisedWindows& windows) const {
  windows.unbalanced.clear();
  for (const std::size_t w : anew_) {
    windows.base.row(static_cast<Eigen::Index>(w)).setZero();
    if (!motions[w]->places) windows.unbalanced.push_back(w);
  }
  windows.base = comparison_.predicted(anew_, {here}, windows.base, motions, stop_).front();
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
