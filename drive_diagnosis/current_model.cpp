#include "drive_diagnosis/current_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "drive_diagnosis/instruments/sensor_checks.h"
#include "drive_diagnosis/recording/robust_statistics.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

constexpr int kTerms = CurrentModel::kTerms;

using Windows = std::vector<CurrentWindow>;
/// Which windows go together: of one drive, one day, one stretch of a drive.
using Groups = std::vector<int>;

/// In how many standard deviations a share of numbers lies below, of one told by so many parts.
double t_quantile(double share, std::size_t parts) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(parts) - 1), share);
}

/// The standard deviation of a number by its values without one cluster each.
double jackknife_std(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares * (n - 1) / n);
}

/// Least squares with a prior of 100 A about 0 on every term: nothing to windows that say something
/// of it, and 0 for what they do not show at all.
CurrentModel fit(const Windows& windows, const std::vector<double>& weights, double half_track_m) {
  constexpr double kPrior = 1e-4;
  using Normal = Eigen::Matrix<double, kTerms, kTerms>;
  std::array<Normal, 2> normal{kPrior * Normal::Identity(), kPrior * Normal::Identity()};
  Eigen::Matrix<double, kTerms, 2> right = Eigen::Matrix<double, kTerms, 2>::Zero();
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (weights[i] == 0) continue;
    for (int side = 0; side < 2; ++side) {
      const CurrentModel::Terms terms = CurrentModel::terms(side, windows[i], half_track_m);
      const Eigen::Map<const Eigen::Matrix<double, kTerms, 1>> t(terms.data());
      normal.at(static_cast<std::size_t>(side)) += weights[i] * t * t.transpose();
      right.col(side) += weights[i] * t * windows[i].current_a.at(static_cast<std::size_t>(side));
    }
  }
  CurrentModel model{.half_track_m = half_track_m};
  for (int side = 0; side < 2; ++side) {
    const Eigen::Matrix<double, kTerms, 1> c =
        normal.at(static_cast<std::size_t>(side)).ldlt().solve(right.col(side));
    for (int k = 0; k < kTerms; ++k) {
      model.sides.at(static_cast<std::size_t>(side)).at(static_cast<std::size_t>(k)) = c[k];
    }
  }
  return model;
}

double squares_left(const CurrentModel& model, const Windows& windows,
                    const std::vector<double>& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (weights[i] == 0) continue;
    for (int side = 0; side < 2; ++side) {
      const double off = model.current_a(side, windows[i]) -
                         windows[i].current_a.at(static_cast<std::size_t>(side));
      sum += weights[i] * off * off;
    }
  }
  return sum;
}

/// The same with the track that leaves least: nobody says how wide the vehicle rolls.
CurrentModel fit(const Windows& windows, const std::vector<double>& weights) {
  CurrentModel best;
  double least = std::numeric_limits<double>::infinity();
  for (const double half_track_m : {0.1, 0.2, 0.4, 0.8, 1.6}) {
    const CurrentModel model = fit(windows, weights, half_track_m);
    const double left = squares_left(model, windows, weights);
    if (left >= least) continue;
    least = left;
    best = model;
  }
  return best;
}

std::array<double, 2> mean_currents(const Windows& windows, const std::vector<double>& weights) {
  std::array<double, 2> sum{};
  double total = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      sum.at(side) += weights[i] * windows[i].current_a.at(side);
    }
    total += weights[i];
  }
  for (double& value : sum) value /= std::max(total, 1.0);
  return sum;
}

/// What is held out at a time: days where there are three, else drives, else stretches of a minute.
Groups groups_of(const Windows& windows, const std::vector<DriveRecording>& drives,
                 const std::vector<DriveWindow>& of, std::string& kind) {
  std::map<std::string, int> days;
  std::set<std::size_t> seen;
  for (const CurrentWindow& window : windows) {
    days.emplace(drives[window.drive].day, static_cast<int>(days.size()));
    seen.insert(window.drive);
  }
  Groups groups;
  kind = days.size() >= 3 ? "day" : seen.size() >= 3 ? "drive" : "stretch";
  for (const CurrentWindow& window : windows) {
    constexpr double kStretch_s = 60;
    const auto stretch = static_cast<int>(
        (of[window.window].start_s - drives[window.drive].time_s.front()) / kStretch_s);
    groups.push_back(kind == "day"     ? days.at(drives[window.drive].day)
                     : kind == "drive" ? static_cast<int>(window.drive)
                                       : static_cast<int>(window.drive) * 10000 + stretch);
  }
  return groups;
}

/// 1 of windows outside a group.
std::vector<double> weights_without(const Groups& groups, int left_out) {
  std::vector<double> weights;
  for (const int group : groups) weights.push_back(group == left_out ? 0 : 1);
  return weights;
}

struct Predictions {
  std::vector<std::array<double, 2>> model_a, constant_a;
};

Predictions held_out_predictions(const Windows& windows, const Groups& groups,
                                 const std::stop_token& stop) {
  Predictions result{std::vector<std::array<double, 2>>(windows.size()),
                     std::vector<std::array<double, 2>>(windows.size())};
  for (const int group : std::set<int>(groups.begin(), groups.end())) {
    throw_if_stopped(stop);
    const std::vector<double> weights = weights_without(groups, group);
    const CurrentModel model = fit(windows, weights);
    const std::array<double, 2> constant = mean_currents(windows, weights);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      if (groups[i] != group) continue;
      for (int side = 0; side < 2; ++side) {
        result.model_a[i].at(static_cast<std::size_t>(side)) = model.current_a(side, windows[i]);
      }
      result.constant_a[i] = constant;
    }
  }
  return result;
}

std::vector<ComparedChannel> compared_sides(const Windows& windows, const Predictions& predicted) {
  std::vector<ComparedChannel> sides{{.name = "current_left_a"}, {.name = "current_right_a"}};
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t i = 0; i < windows.size(); ++i) {
      sides[side].windows.push_back(windows[i].window);
      sides[side].measured.push_back(windows[i].current_a.at(side));
      sides[side].corrected.push_back(predicted.model_a[i].at(side));
    }
  }
  return sides;
}

HeldOutCurrents judge(const Windows& windows, const Predictions& predicted) {
  HeldOutCurrents result;
  std::map<std::size_t, HeldOutCurrents::Charge> charges;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    HeldOutCurrents::Charge& charge = charges[windows[i].drive];
    charge.drive = windows[i].drive;
    ++charge.windows;
    const double hours = windows[i].duration_s / 3600;
    for (std::size_t side = 0; side < 2; ++side) {
      const double measured = windows[i].current_a.at(side);
      const double off = predicted.model_a[i].at(side) - measured;
      const double constant_off = predicted.constant_a[i].at(side) - measured;
      result.rms_a.at(side) += off * off;
      result.constant_rms_a.at(side) += constant_off * constant_off;
      charge.measured_ah += measured * hours;
      charge.predicted_ah += predicted.model_a[i].at(side) * hours;
      charge.constant_ah += predicted.constant_a[i].at(side) * hours;
    }
  }
  const auto n = static_cast<double>(windows.size());
  result.both_rms_a = std::sqrt((result.rms_a[0] + result.rms_a[1]) / (2 * n));
  result.both_constant_rms_a =
      std::sqrt((result.constant_rms_a[0] + result.constant_rms_a[1]) / (2 * n));
  for (std::size_t side = 0; side < 2; ++side) {
    result.rms_a.at(side) = std::sqrt(result.rms_a.at(side) / n);
    result.constant_rms_a.at(side) = std::sqrt(result.constant_rms_a.at(side) / n);
  }
  std::vector<double> errors, constant_errors;
  for (const auto& [drive, charge] : charges) {
    constexpr int kLeast = 6;
    if (charge.windows < kLeast || charge.measured_ah == 0) continue;
    result.charges.push_back(charge);
    errors.push_back(std::abs(charge.predicted_ah / charge.measured_ah - 1));
    constant_errors.push_back(std::abs(charge.constant_ah / charge.measured_ah - 1));
  }
  if (!errors.empty()) {
    result.median_charge_error = median_value(errors);
    result.median_constant_error = median_value(constant_errors);
  }
  return result;
}

/// Whether less is left of the model than of a constant, by more than a standard error over
/// clusters of windows, which err alike each: what one of them alone shows is no more than that.
bool is_beyond_chance(const Windows& windows, const Predictions& predicted,
                      const Groups& clusters) {
  std::map<int, double> gains;
  double sum = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    double gain = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      const double measured = windows[i].current_a.at(side);
      gain += std::pow(predicted.constant_a[i].at(side) - measured, 2) -
              std::pow(predicted.model_a[i].at(side) - measured, 2);
    }
    gains[clusters[i]] += gain;
    sum += gain;
  }
  const auto n = static_cast<double>(gains.size());
  double squares = 0;
  for (const auto& [cluster, gain] : gains) squares += std::pow(gain - sum / n, 2);
  return sum > std::sqrt(squares * n / (n - 1));
}

double pitch_offset_rad(const std::vector<Mounting>& mountings, const std::string& day) {
  std::vector<double> known;
  for (const Mounting& mounting : mountings) {
    if (!mounting.pitch_rad) continue;
    if (mounting.day == day) return mounting.pitch_rad->value;
    known.push_back(mounting.pitch_rad->value);
  }
  return known.empty() ? 0 : median_value(std::move(known));
}

/// Windows at rest show what the instruments read of nothing.
std::optional<DriveEstimate> standing_excess(const std::vector<DriveRecording>& drives,
                                             const std::vector<DriveWindow>& windows,
                                             bool swapped) {
  std::map<std::size_t, std::pair<double, int>> by_drive;
  for (const DriveWindow& window : windows) {
    const DriveRecording& drive = drives[window.drive];
    const double command = channel_mean(drive, window, "command_speed");
    const double turn = channel_mean(drive, window, "command_turn");
    constexpr double kStands_mps = 0.03;
    if (!(command == 0) || !(turn == 0) || !window.steady ||
        !(window.speed_mps < kStands_mps * window.pace)) {
      continue;
    }
    const double off = side_mean(drive, window, "current", "a", {}, "left") -
                       side_mean(drive, window, "current", "a", {}, "right");
    if (std::isnan(off)) continue;
    by_drive[window.drive].first += swapped ? -off : off;
    ++by_drive[window.drive].second;
  }
  if (by_drive.size() < 3) return {};
  std::vector<double> means;
  for (const auto& [drive, sum] : by_drive) means.push_back(sum.first / sum.second);
  double mean = 0, square = 0;
  for (const double value : means) mean += value / static_cast<double>(means.size());
  for (const double value : means) square += (value - mean) * (value - mean);
  const auto n = static_cast<double>(means.size());
  return DriveEstimate{mean, std::sqrt(square / (n * (n - 1)))};
}

/// Whether its wheels, or else its heading against its course, say so.
bool goes_back(const DriveRecording& drive, const DriveWindow& window) {
  const double rim = (side_mean(drive, window, "wheel_speed", "rad_s", {}, "left") +
                      side_mean(drive, window, "wheel_speed", "rad_s", {}, "right")) /
                     2;
  constexpr double kTurns_rad_s = 0.1;
  if (std::abs(rim) > kTurns_rad_s * window.pace) return rim < 0;
  const double back =
      std::remainder(heading_rad(drive, window) - window.course_rad, 2 * std::numbers::pi);
  return std::abs(back) > 1;
}

/// Share of a window in which speed or turning is commanded; all of it where no command is logged.
double driven_share(const DriveRecording& drive, const DriveWindow& window) {
  const DriveChannel* speed = drive.channel("command_speed");
  const DriveChannel* turn = drive.channel("command_turn");
  if (!speed || !turn) return 1;
  int driven = 0, all = 0;
  const auto from = std::ranges::lower_bound(drive.time_s, window.start_s) - drive.time_s.begin();
  for (auto i = static_cast<std::size_t>(from); i < drive.size() && drive.time_s[i] <= window.end_s;
       ++i) {
    if (std::isnan(speed->values[i]) || std::isnan(turn->values[i])) continue;
    ++all;
    driven += speed->values[i] != 0 || turn->values[i] != 0;
  }
  return all > 0 ? static_cast<double>(driven) / all : 1;
}

Windows steady_windows(const std::vector<DriveRecording>& drives,
                       const std::vector<DriveWindow>& windows,
                       const std::vector<Mounting>& mountings, bool swapped) {
  Windows chosen;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const DriveWindow& window = windows[i];
    const DriveRecording& drive = drives[window.drive];
    double speed = window.sensed_speed_mps;
    if (std::isnan(speed)) speed = window.speed_mps;
    if (!window.steady || !(std::abs(speed) > kMoving_mps * window.pace)) continue;
    CurrentWindow at{
        .window = i, .drive = window.drive, .duration_s = window.duration_s(), .pace = window.pace};
    at.current_a = {side_mean(drive, window, "current", "a", {}, swapped ? "right" : "left"),
                    side_mean(drive, window, "current", "a", {}, swapped ? "left" : "right")};
    at.speed_mps = goes_back(drive, window) ? -speed : speed;
    at.driven = driven_share(drive, window);
    at.sin_pitch = std::sin(window.pitch_rad - pitch_offset_rad(mountings, drive.day));
    at.yaw_rate_rad_s = window.yaw_rate_rad_s;
    const double all = at.current_a[0] + at.current_a[1] + at.sin_pitch + at.yaw_rate_rad_s;
    if (!std::isnan(all)) chosen.push_back(at);
  }
  return chosen;
}

/// What is fitted without one cluster of windows at a time (a drive; of a few drives, a stretch)
/// tells how far it errs. Drawn clusters would not: of a few, most draws lack what tells a term.
void estimate_excess(const Windows& windows, const Groups& clusters, const std::stop_token& stop,
                     CurrentDiagnosis& result) {
  std::vector<double> excess, ratio;
  for (const int cluster : std::set<int>(clusters.begin(), clusters.end())) {
    throw_if_stopped(stop);
    const CurrentModel model =
        fit(windows, weights_without(clusters, cluster), result.model.half_track_m);
    excess.push_back(model.level_a(0) - model.level_a(1));
    ratio.push_back(model.gravity_a(0) / model.gravity_a(1));
  }
  result.clusters = static_cast<int>(excess.size());
  const double excess_a = result.model.level_a(0) - result.model.level_a(1);
  result.left_excess_a = {excess_a, jackknife_std(excess)};
  const double reach_a = t_quantile(0.975, excess.size()) * result.left_excess_a.std;
  result.left_excess_ci95_a = {excess_a - reach_a, excess_a + reach_a};
  result.gravity_ratio = {result.model.gravity_a(0) / result.model.gravity_a(1),
                          jackknife_std(ratio)};
}

/// What would do as well as a dragging side.
void name_excess(CurrentDiagnosis& result) {
  const double left = result.model.level_a(0), right = result.model.level_a(1);
  result.level_mean_a = (left + right) / 2;
  constexpr double kBuildShare = 0.1;  ///< by which the sides of a sound vehicle differ
  constexpr double kSigmas = 4.5;
  constexpr int kClustersLeast = 6;
  const double beyond_build_a =
      std::abs(result.left_excess_a.value) - kBuildShare * std::abs(result.level_mean_a);
  result.side_drag =
      result.clusters >= kClustersLeast && beyond_build_a > kSigmas * result.left_excess_a.std;
  if (!result.side_drag) return;
  result.equivalent = {"side_drag", "wheel_drag", "cg_offset"};
  // A motor that takes more for the same torque takes more against gravity as well.
  constexpr double kTold = 3;
  if (right != 0 && std::abs(left / right - result.gravity_ratio.value) <
                        kTold * std::max(result.gravity_ratio.std, 0.02)) {
    result.equivalent.emplace_back("motor_constant");
  }
  const auto& standing = result.standing_excess_a;
  if (!standing || std::abs(standing->value - result.left_excess_a.value) <
                       kTold * std::hypot(standing->std, result.left_excess_a.std)) {
    result.equivalent.emplace_back("sensor_bias");
  }
}

}  // namespace

CurrentModel::Terms CurrentModel::terms(int side, const CurrentWindow& at, double half_track_m) {
  constexpr double kTurnsOver_mps = 0.05;  // slower, wheels turn both ways within a window
  constexpr double kStands_mps = 0.01, kSlides = 1.0 / 3;
  const double outward = side == 0 ? -1 : 1, by_turn_mps = half_track_m * at.yaw_rate_rad_s;
  const double direction =
      std::tanh((at.speed_mps + outward * by_turn_mps) / (kTurnsOver_mps * at.pace));
  const double turn =
      by_turn_mps / std::hypot(by_turn_mps, kSlides * at.speed_mps, kStands_mps * at.pace);
  const double braking = std::min(0.0, direction * at.sin_pitch) * direction;
  Terms terms{0, 1, direction, at.sin_pitch, braking, turn, direction * std::abs(turn)};
  for (double& term : terms) term *= at.driven;
  terms[0] = 1 - at.driven;
  return terms;
}

double CurrentModel::current_a(int side, const CurrentWindow& window) const {
  const Terms t = terms(side, window, half_track_m);
  double sum = 0;
  for (std::size_t k = 0; k < t.size(); ++k)
    sum += sides.at(static_cast<std::size_t>(side)).at(k) * t.at(k);
  return sum;
}

CurrentComparison diagnose_currents(const std::vector<DriveRecording>& drives,
                                    const std::vector<DriveWindow>& windows,
                                    const std::vector<Mounting>& mountings, bool sides_swapped,
                                    const std::stop_token& stop) {
  const Windows chosen = steady_windows(drives, windows, mountings, sides_swapped);
  std::string kind;
  const Groups groups = groups_of(chosen, drives, windows, kind);
  const std::size_t parts = std::set<int>(groups.begin(), groups.end()).size();
  const CurrentsUsed used{static_cast<int>(chosen.size()), static_cast<int>(parts)};
  if (!used.are_enough()) return {.used = used, .currents = {}};
  CurrentDiagnosis result;
  result.windows = used.windows;
  result.model = fit(chosen, std::vector<double>(chosen.size(), 1.0));
  const Predictions predicted = held_out_predictions(chosen, groups, stop);
  result.held_out = judge(chosen, predicted);
  result.held_out.held_out = kind;
  result.compared = compared_sides(chosen, predicted);
  Groups clusters = groups;
  if (kind == "day") {
    for (std::size_t i = 0; i < chosen.size(); ++i) clusters[i] = static_cast<int>(chosen[i].drive);
  }
  result.held_out.beats_constant = is_beyond_chance(chosen, predicted, clusters);
  estimate_excess(chosen, clusters, stop, result);
  result.standing_excess_a = standing_excess(drives, windows, sides_swapped);
  if (result.held_out.beats_constant) name_excess(result);
  return {.used = used, .currents = std::move(result)};
}

}  // namespace regoplan
