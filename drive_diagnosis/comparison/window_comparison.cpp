#include "drive_diagnosis/comparison/window_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "drive_diagnosis/comparison/channel_samples.h"
#include "drive_diagnosis/comparison/window_input.h"
#include "drive_diagnosis/recording/drive_pace.h"
#include "terramech/basics/interruption.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

/// By how much an acceleration may be off: sinkage is that of steady motion at each place, and
/// samples do not tell what happens between them.
double acceleration_std(const WindowInput& input, double WindowInput::Place::*of, double least) {
  constexpr double kUnsteady = 0.1;
  double squares = 0;
  for (const WindowInput::Place& place : input.places) {
    squares += place.part.mean_share * (place.*of) * (place.*of);
  }
  return std::hypot(least, kUnsteady * std::sqrt(squares));
}

}  // namespace

std::string_view name(LeftOut reason) {
  constexpr std::array<std::string_view, kLeftOutReasons> kNames{
      "no_input", "standing", "off_map", "no_balance", "no_channel", "too_many"};
  return kNames.at(static_cast<std::size_t>(reason));
}

WindowComparison::WindowComparison(const std::vector<DriveRecording>& drives,
                                   const std::vector<DriveWindow>& windows, const TerrainMap& map,
                                   const Vehicle& vehicle, double gravity_mps2, int threads)
    : drives_(drives),
      windows_(windows),
      map_(map),
      vehicle_(vehicle),
      gravity_mps2_(gravity_mps2),
      model_(map, vehicle, gravity_mps2),
      threads_(threads),
      soils_driven_(map.soils().size(), false) {
  choose_channels();
  std::vector<Eigen::VectorXd> rows;
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    const auto reason = add(i, rows);
    unbalanced_.push_back(reason == LeftOut::kNoBalance);
    if (reason) {
      ++used_.left_out.at(static_cast<std::size_t>(*reason));
    } else {
      ++used_.compared;
    }
    if (reason != LeftOut::kNoInput) continue;
    for (const std::string& column :
         columns_missing(drives_[windows_[i].drive], windows_[i], vehicle_)) {
      ++used_.columns_missing[column];
    }
  }
  measured_.resize(static_cast<Eigen::Index>(rows.size()),
                   static_cast<Eigen::Index>(channels_.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    measured_.row(static_cast<Eigen::Index>(i)) = rows[i];
  }
  estimate_rim_std();
  estimate_sampled_std();
  measure_sizes();
  estimate_more_std();
}

/// Takes a window in, or says why not.
std::optional<LeftOut> WindowComparison::add(std::size_t window,
                                             std::vector<Eigen::VectorXd>& rows) {
  if (rows.size() == kComparedMost) return LeftOut::kTooMany;
  const DriveRecording& drive = drives_[windows_[window].drive];
  auto input = input_of(drive, windows_[window], vehicle_, gravity_mps2_);
  if (!input) return LeftOut::kNoInput;
  if (stands(*input)) return LeftOut::kStanding;
  if (!model_.knows_ground(*input)) return LeftOut::kOffMap;
  const auto prediction = model_.predict(*input, {});
  if (!prediction) return LeftOut::kNoBalance;
  auto measured = measured_in(window);
  if (!measured) return LeftOut::kNoChannel;
  for (std::size_t j = 0; j < input->places.size(); ++j) {
    input->places[j].near = input->places[j].start = prediction->found[j];
    const WindowPart& part = input->places[j].part;
    const auto soil = map_.soil_index(part.x_m, part.y_m);
    if (soil) soils_driven_[static_cast<std::size_t>(*soil)] = true;
  }
  windows_of_.push_back(window);
  inputs_.push_back(*input);
  rows.push_back(std::move(*measured));
  return {};
}

bool WindowComparison::has_input(std::size_t drive) const {
  return std::ranges::any_of(windows_, [&](const DriveWindow& window) {
    return window.drive == drive && input_of(drives_[drive], window, vehicle_, gravity_mps2_);
  });
}

void WindowComparison::choose_channels() {
  channels_ = {"speed_mps", "left_mps", "yaw_rate_rad_s"};
  // What a drive lacks whose windows are not compared, as one without rim speeds, is no loss.
  std::vector<const DriveRecording*> with_input;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (has_input(i)) with_input.push_back(&drives_[i]);
  }
  const auto everywhere = [&](const std::string& name) {
    return std::ranges::all_of(
        with_input, [&](const DriveRecording* drive) { return drive->channel(name) != nullptr; });
  };
  has_attitude_ = everywhere("pitch_rad") && everywhere("roll_rad");
  if (has_attitude_) {
    channels_.emplace_back("pitch_rad");
    channels_.emplace_back("roll_rad");
  }
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const std::string name = fmt::format("torque_{}_nm", vehicle_.wheels[i].name);
    if (!everywhere(name)) continue;
    torque_wheels_.push_back(i);
    channels_.push_back(name);
  }
}

std::optional<std::size_t> WindowComparison::channel(std::string_view name) const {
  const auto at = std::ranges::find(channels_, name);
  if (at == channels_.end()) return {};
  return static_cast<std::size_t>(at - channels_.begin());
}

Eigen::VectorXd WindowComparison::vector_of(const WindowPrediction& prediction) const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(channels_.size()));
  values[0] = prediction.forward_mps;
  values[1] = prediction.left_mps;
  values[2] = prediction.yaw_rate_rad_s;
  Eigen::Index k = 3;
  if (has_attitude_) {
    values[k++] = prediction.pitch_rad;
    values[k++] = prediction.roll_rad;
  }
  for (const std::size_t wheel : torque_wheels_) values[k++] = prediction.torque_nm.at(wheel);
  return values;
}

std::optional<Eigen::VectorXd> WindowComparison::measured_in(std::size_t i) const {
  const DriveWindow& window = windows_[i];
  Eigen::VectorXd values(static_cast<Eigen::Index>(channels_.size()));
  values[0] = window.forward_mps;
  values[1] = window.left_mps;
  values[2] = window.yaw_rate_rad_s;
  Eigen::Index k = 3;
  if (has_attitude_) {
    values[k++] = window.pitch_rad;
    values[k++] = window.roll_rad;
  }
  for (const std::size_t wheel : torque_wheels_) {
    values[k++] = channel_mean(drives_[window.drive], window,
                               fmt::format("torque_{}_nm", vehicle_.wheels[wheel].name));
  }
  if (!values.allFinite()) return {};
  return values;
}

bool WindowComparison::consecutive(std::size_t i) const {
  return i > 0 && windows_of_[i] == windows_of_[i - 1] + 1 &&
         windows_[windows_of_[i]].drive == windows_[windows_of_[i - 1]].drive;
}

void WindowComparison::shift(WindowInput& input, std::size_t window, std::size_t which,
                             double deviations) const {
  constexpr double kLeast_mps2 = 0.002, kLeast_rps2 = 0.002;
  const std::size_t wheels = vehicle_.wheels.size();
  const WindowInput& measured = inputs_[window];
  for (WindowInput::Place& place : input.places) {
    if (which < wheels) {
      place.rim_rad_s.at(which) += deviations * rim_std_rad_s_[window].at(which);
    } else if (which == wheels) {
      place.more_mps2 +=
          deviations * acceleration_std(measured, &WindowInput::Place::acceleration_mps2,
                                        kLeast_mps2 * measured.pace);
    } else if (which == wheels + 1) {
      place.more_rps2 +=
          deviations * acceleration_std(measured, &WindowInput::Place::yaw_acceleration_rps2,
                                        kLeast_rps2 * measured.pace);
    } else {
      (which == wheels + 2 ? place.more_slope_forward : place.more_slope_left) +=
          deviations * kSlope;
    }
  }
}

WindowInput WindowComparison::shifted(std::size_t i) const {
  WindowInput input = inputs_[i];
  if (shifts_.size() == 0) return input;
  for (std::size_t k = 0; k < inputs(); ++k) {
    shift(input, i, k, shifts_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)));
  }
  return input;
}

Eigen::MatrixXd WindowComparison::predicted_as_said(const std::stop_token& stop) const {
  return predicted(all(), {}, {}, Eigen::MatrixXd::Zero(measured_.rows(), measured_.cols()), stop);
}

Eigen::MatrixXd WindowComparison::predicted(const WindowSet& windows,
                                            const VehicleDeviation& deviation,
                                            const std::vector<WindowZone>& zones,
                                            const Eigen::MatrixXd& otherwise,
                                            const std::stop_token& stop) const {
  return predicted(windows, {{deviation, zones}}, otherwise, MotionsByWindow(size()), stop).front();
}

std::vector<Eigen::MatrixXd> WindowComparison::predicted(
    const WindowSet& windows, const std::vector<WindowQuestion>& questions,
    const Eigen::MatrixXd& otherwise, const MotionsByWindow& known,
    const std::stop_token& stop) const {
  std::vector<Eigen::MatrixXd> result(questions.size(), otherwise);
  parallel_for(questions.size() * windows.size(), threads_, [&](std::size_t n) {
    throw_if_stopped(stop);
    const std::size_t question = n / windows.size(), window = windows[n % windows.size()];
    const WindowMotions* here = known[window] ? &*known[window] : nullptr;
    const auto values = predicted_in(window, questions[question], here);
    if (values) result[question].row(static_cast<Eigen::Index>(window)) = *values;
  });
  return result;
}

std::vector<std::optional<Eigen::VectorXd>> WindowComparison::predicted_each(
    const std::vector<std::pair<std::size_t, WindowQuestion>>& windows,
    const std::stop_token& stop) const {
  std::vector<std::optional<Eigen::VectorXd>> result(windows.size());
  parallel_for(windows.size(), threads_, [&](std::size_t n) {
    throw_if_stopped(stop);
    result[n] = predicted_in(windows[n].first, windows[n].second, nullptr);
  });
  return result;
}

MotionsByWindow WindowComparison::motions(const WindowSet& windows, const WindowQuestion& question,
                                          const std::stop_token& stop) const {
  MotionsByWindow result(size());
  parallel_for(windows.size(), threads_, [&](std::size_t n) {
    throw_if_stopped(stop);
    const std::size_t i = windows[n];
    result[i] = model_.motions(shifted(i), question.deviation, stretches_in(i, question.zones));
  });
  return result;
}

/// Nothing where a window's motion does not balance.
std::optional<Eigen::VectorXd> WindowComparison::predicted_in(std::size_t i,
                                                              const WindowQuestion& question,
                                                              const WindowMotions* known) const {
  const auto prediction =
      model_.predict(shifted(i), question.deviation, stretches_in(i, question.zones), known);
  if (!prediction) return {};
  return vector_of(*prediction);
}

std::vector<int> WindowComparison::zones_under_wheels(std::size_t i,
                                                      const WindowQuestion& question) const {
  const WindowInput& input = inputs_[i];
  std::vector<int> under;
  for (const WindowInput::Place& place : input.places) {
    for (const WheelTime& wheel : model_.wheel_times(input, place, question.deviation)) {
      int in = -1;
      for (std::size_t z = 0; z < question.zones.size() && in < 0; ++z) {
        if (!touches(i, question.zones[z])) continue;
        if (stretch_of(question.zones[z]).holds(wheel)) in = static_cast<int>(z);
      }
      under.push_back(in);
    }
  }
  return under;
}

double WindowComparison::time_s(double at) const {
  const auto last = static_cast<double>(size() - 1);
  const auto i = static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, last));
  const DriveWindow& window = windows_[windows_of_[i]];
  return window.start_s + (at - static_cast<double>(i)) * window.duration_s();
}

/// Where windows begin or end with a zone, nothing says that it does not go on.
SoilStretch WindowComparison::stretch_of(const WindowZone& zone) const {
  constexpr double kNever_s = std::numeric_limits<double>::infinity();
  const auto first = static_cast<std::size_t>(std::floor(zone.begins));
  const auto last = static_cast<std::size_t>(std::ceil(zone.ends)) - 1;
  const bool from_before = zone.begins == std::floor(zone.begins) && !consecutive(first);
  const bool goes_on =
      zone.ends == std::ceil(zone.ends) && (last + 1 == size() || !consecutive(last + 1));
  const double within = std::nextafter(zone.ends, zone.begins);  // at the end of its last window
  return {.starts_s = from_before ? -kNever_s : time_s(zone.begins),
          .ends_s = goes_on ? kNever_s : time_s(within),
          .soil = zone.soil,
          .numbers = zone.numbers,
          .starts_slant = zone.begins_slant,
          .ends_slant = zone.ends_slant};
}

bool WindowComparison::touches(std::size_t i, const WindowZone& zone) const {
  const auto first = static_cast<std::size_t>(std::floor(zone.begins));
  if (windows_[windows_of_[i]].drive != windows_[windows_of_[first]].drive) return false;
  const WindowInput& input = inputs_[i];
  const double slant = std::max(std::abs(zone.begins_slant), std::abs(zone.ends_slant));
  double ahead_s = 0;
  for (const WheelMount& wheel : vehicle_.wheels) {
    if (input.forward_mps == 0) continue;
    const double ahead_m = std::abs(wheel.x_m) + slant * std::abs(wheel.y_m);
    ahead_s = std::max(ahead_s, ahead_m / std::abs(input.forward_mps));
  }
  const SoilStretch stretch = stretch_of(zone);
  return input.places.front().part.start_s - ahead_s < stretch.ends_s &&
         input.places.back().part.end_s + ahead_s > stretch.starts_s;
}

WindowSet WindowComparison::all() const {
  WindowSet windows(size());
  std::iota(windows.begin(), windows.end(), 0);
  return windows;
}

WindowSet WindowComparison::touching(const std::vector<WindowZone>& zones) const {
  WindowSet windows = all();
  std::erase_if(windows, [&](std::size_t i) {
    return std::ranges::none_of(zones, [&](const WindowZone& zone) { return touches(i, zone); });
  });
  return windows;
}

WindowSet WindowComparison::touching_in_run(std::size_t window, const WindowZone& zone) const {
  std::size_t first = window, last = window;
  while (consecutive(first) && touches(first - 1, zone)) --first;
  while (last + 1 < size() && consecutive(last + 1) && touches(last + 1, zone)) ++last;
  WindowSet windows(last + 1 - first);
  std::iota(windows.begin(), windows.end(), first);
  return windows;
}

WindowZone WindowComparison::widened(WindowZone zone, double windows) const {
  auto first = static_cast<std::size_t>(std::floor(zone.begins));
  auto end = static_cast<std::size_t>(std::ceil(zone.ends));
  const double begins = zone.begins - windows, ends = zone.ends + windows;
  while (static_cast<double>(first) > begins && consecutive(first)) --first;
  while (static_cast<double>(end) < ends && end < size() && consecutive(end)) ++end;
  zone.begins = std::max(begins, static_cast<double>(first));
  zone.ends = std::min(ends, static_cast<double>(end));
  return zone;
}

std::vector<SoilStretch> WindowComparison::stretches_in(
    std::size_t i, const std::vector<WindowZone>& zones) const {
  std::vector<SoilStretch> stretches;
  for (const WindowZone& zone : zones) {
    if (touches(i, zone)) stretches.push_back(stretch_of(zone));
  }
  return stretches;
}

void WindowComparison::start_at(const WindowSet& windows, const VehicleDeviation& deviation,
                                const std::vector<WindowZone>& zones, const std::stop_token& stop) {
  parallel_for(windows.size(), threads_, [&](std::size_t n) {
    throw_if_stopped(stop);
    const std::size_t i = windows[n];
    const auto found = model_.predict(shifted(i), deviation, stretches_in(i, zones));
    if (!found) return;
    for (std::size_t j = 0; j < found->found.size(); ++j) {
      inputs_[i].places[j].near = found->found[j];
    }
  });
}

std::vector<Eigen::MatrixXd> WindowComparison::of_inputs(const WindowSet& windows,
                                                         const MotionsByWindow& here,
                                                         const std::stop_token& stop) const {
  std::vector<Eigen::MatrixXd> result(inputs(),
                                      Eigen::MatrixXd::Zero(measured_.rows(), measured_.cols()));
  parallel_for(inputs() * windows.size(), threads_, [&](std::size_t n) {
    throw_if_stopped(stop);
    const std::size_t k = n / windows.size(), i = windows[n % windows.size()];
    const WindowMotions& motions = *here[i];
    const WindowInput input = shifted(i);
    const auto before = model_.predict(input, motions.deviation, motions.stretches, &motions);
    if (!before) return;
    WindowInput further = input;
    shift(further, i, k, 1);
    const auto there = model_.predict(further, motions.deviation, motions.stretches);
    if (!there) return;
    result[k].row(static_cast<Eigen::Index>(i)) = vector_of(*there) - vector_of(*before);
  });
  return result;
}

}  // namespace regoplan
