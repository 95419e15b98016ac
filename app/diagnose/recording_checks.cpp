#include "app/diagnose/recording_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "app/diagnose/modelled_recording.h"
#include "app/diagnose/recording_signs.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {
namespace {

constexpr double kStandardGravity_mps2 = 9.80665;  // of the unit kgf

/// One value of a channel, in units of what limits it, beside the model's.
struct Sample {
  std::size_t run = 0;
  double share = 0;  ///< |measured| over load, load times radius, or radius
  double model_share = 0;
};

double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

struct SuspectedUnit {
  double times = 1;  ///< so many times too large the channel seems
  std::string_view suspected;
};

/// The unit that a column may have been written in, from how many times too large the channel is.
std::string suspected_unit(Channel channel, double times) {
  static constexpr std::array kLengths{SuspectedUnit{1e3, "{} in mm"},
                                       SuspectedUnit{1e2, "{} in cm"},
                                       SuspectedUnit{1e-3, "{} in km"}};
  static constexpr std::array kForces{SuspectedUnit{1e3, "{} in mN, or load_n in kN"},
                                      SuspectedUnit{kStandardGravity_mps2, "load_n in kg (kgf)"},
                                      SuspectedUnit{1 / kStandardGravity_mps2, "{} in kgf"},
                                      SuspectedUnit{1e-3, "{} in kN, or load_n in mN"}};
  static constexpr std::array kTorques{SuspectedUnit{1e3, "{} in N mm, or load_n in kN"},
                                       SuspectedUnit{1e2, "{} in N cm"},
                                       SuspectedUnit{kStandardGravity_mps2, "load_n in kg (kgf)"},
                                       SuspectedUnit{1 / kStandardGravity_mps2, "{} in kgf m"},
                                       SuspectedUnit{1e-3, "{} in kN m, or load_n in mN"}};
  std::span<const SuspectedUnit> units = kForces;
  if (is_length(channel)) units = kLengths;
  if (channel == Channel::kTorque) units = kTorques;
  const SuspectedUnit& nearest = *std::ranges::min_element(
      units, {},
      [times](const SuspectedUnit& unit) { return std::abs(std::log(times / unit.times)); });
  return fmt::format(fmt::runtime(nearest.suspected), name(channel));
}

class Checks {
 public:
  Checks(const RecordingFile& recording, const DiagnosisSetup& setup)
      : recording_(recording, setup) {
    for (const WheelRun& run : runs()) {
      // What is written in radians and read as degrees is 57 times too small.
      const double as_radians = std::clamp(run.slip_angle_rad / kDegree, -1.5, 1.5);
      as_radians_.push_back(recording_.model()
                                .channels(run.load_n, motion_at(run.slip_ratio, as_radians))
                                .forces.fy_n);
    }
  }

  std::vector<std::string> run_all() {
    check_that_the_wheel_is_carried();
    for (const Channel channel : recording_.file().recording.channels) {
      check_that_it_lives(channel);
      check_size(channel);
    }
    check_angle_unit();
    std::ranges::copy(doubtful_signs(recording_), std::back_inserter(warnings_));
    check_exchanged();
    check_kilograms();
    check_load_in_kilograms();
    check_speed();
    return std::move(warnings_);
  }

  /// Channels that follow the model divided by what a kilogram weighs, each with its factor.
  std::vector<std::pair<Channel, double>> in_kilograms() const {
    std::vector<std::pair<Channel, double>> found;
    constexpr double kAlike = 0.8;
    constexpr int kFewest = 4;
    // Missing physics changes a channel beside its unit: of 450 channels of challenges, right in
    // their units, the factors are 0.36 to 2.2, and all but 18 lie within 1.6 of 1.
    const double near = std::log(1.6);
    for (const Channel channel : {Channel::kFx, Channel::kFy, Channel::kTorque}) {
      double with_model = 0, own = 0, model = 0;
      int measured = 0;
      for (std::size_t i = 0; i < runs().size(); ++i) {
        const double value = runs()[i].value(channel), expected = recording_.modelled(i, channel);
        if (!recording_.is_comparable(i, channel)) continue;
        ++measured;
        with_model += value * expected;
        own += value * value;
        model += expected * expected;
      }
      if (measured < kFewest || !(with_model > kAlike * std::sqrt(own * model))) continue;
      const double factor = std::sqrt(own / model);
      if (std::abs(std::log(factor * kStandardGravity_mps2)) < near)
        found.push_back({channel, factor});
    }
    return found;
  }

 private:
  const std::vector<WheelRun>& runs() const { return recording_.runs(); }

  void check_that_the_wheel_is_carried() {
    std::vector<std::size_t> sunk;
    for (std::size_t i = 0; i < runs().size(); ++i) {
      if (!has_forces(recording_.forces(i).status)) sunk.push_back(i);
    }
    if (sunk.empty()) return;
    const std::size_t first = sunk.front();
    const std::string what = fmt::format(
        "{}: load_n: {} is not carried by the model at the setup's means ({}), nor are the loads "
        "of {} of {} rows; suspected: load_n not in N, or kc, kphi, n, radius_m, width_m in other "
        "units (kN, mm)",
        recording_.place(first), runs()[first].load_n, name(recording_.forces(first).status),
        sunk.size(), runs().size());
    if (sunk.size() == runs().size()) throw InputError(what);
    warnings_.push_back(what);
  }

  std::vector<Sample> samples(Channel channel) const {
    std::vector<Sample> samples;
    constexpr double kHardlySideways_rad = 2 * kDegree;
    for (std::size_t i = 0; i < runs().size(); ++i) {
      const WheelRun& run = runs()[i];
      const double value = run.value(channel);
      if (!recording_.is_comparable(i, channel)) continue;
      if (channel == Channel::kFy && std::abs(run.slip_angle_rad) < kHardlySideways_rad) continue;
      const double scale = recording_.reach(i, channel);
      samples.push_back({.run = i,
                         .share = std::abs(value) / scale,
                         .model_share = std::abs(recording_.modelled(i, channel)) / scale});
    }
    return samples;
  }

  /// A sensor that says nothing but 0 where the model says something.
  void check_that_it_lives(Channel channel) {
    const std::vector<Sample> all = samples(channel);
    constexpr double kClear_share = 0.01;
    const auto says_zero = [&](const WheelRun& run) {
      return std::isnan(run.value(channel)) || run.value(channel) == 0;
    };
    const auto is_clear = [](const Sample& at) { return at.model_share > kClear_share; };
    const auto expected = std::ranges::find_if(all, is_clear);
    if (expected == all.end() || !std::ranges::all_of(runs(), says_zero)) return;
    throw InputError(fmt::format(
        "{}: {}: 0 is not valid in every run (allowed: what was measured; the model has {:.3g} "
        "here); suspected: a dead channel; remedy: leave the column out",
        recording_.place(expected->run), name(channel),
        recording_.modelled(expected->run, channel)));
  }

  void check_size(Channel channel) {
    const std::vector<Sample> all = samples(channel);
    if (all.empty()) return;
    std::vector<double> shares, of_model;
    for (const Sample& sample : all) {
      shares.push_back(sample.share);
      of_model.push_back(sample.model_share);
    }
    const double most = quantile(shares, 0.9);
    const double low = is_length(channel) ? 1e-3 : 2e-3, high = is_length(channel) ? 1 : 3;
    const double model_most = quantile(of_model, 0.9);
    const bool too_large = most > high, too_small = most < low && model_most > 20 * most;
    if (too_large || too_small) {
      const Sample& worst = *std::ranges::max_element(all, {}, &Sample::share);
      const std::string of = is_length(channel)            ? "the wheel's radius"
                             : channel == Channel::kTorque ? "load times radius"
                                                           : "the load";
      throw InputError(fmt::format(
          "{}: {}: {} is not valid (allowed: nine tenths of the values within {} to {} times {}; "
          "here {:.2g}, the model {:.2g}); suspected: {}",
          recording_.place(worst.run), name(channel), runs()[worst.run].value(channel), low, high,
          of, most, model_most, suspected_unit(channel, most / model_most)));
    }
    for (const Sample& sample : all) {
      if (sample.share <= 3 * high) continue;
      warnings_.push_back(fmt::format("{}: {}: {} is an outlier by size ({:.3g} times {})",
                                      recording_.place(sample.run), name(channel),
                                      runs()[sample.run].value(channel), sample.share,
                                      is_length(channel) ? "the radius" : "what the load allows"));
    }
  }

  /// Side forces that fit the slip angle in radians and are far too large for it in degrees.
  void check_angle_unit() {
    double largest_rad = 0;
    for (const WheelRun& run : runs()) {
      largest_rad = std::max(largest_rad, std::abs(run.slip_angle_rad));
    }
    const double largest_deg = largest_rad / kDegree;
    if (largest_deg < 0.03 || largest_deg > 1.6) return;
    double with_model = 0, own = 0, model = 0, as_degrees = 0;
    std::size_t first = runs().size();
    for (std::size_t i = 0; i < runs().size(); ++i) {
      const double fy = runs()[i].value(Channel::kFy);
      if (!recording_.is_comparable(i, Channel::kFy)) continue;
      if (first == runs().size() && runs()[i].slip_angle_rad != 0) first = i;
      with_model += fy * as_radians_[i];
      own += fy * fy;
      model += as_radians_[i] * as_radians_[i];
      as_degrees += recording_.forces(i).fy_n * recording_.forces(i).fy_n;
    }
    const bool too_large = own > 25 * as_degrees && own > model / 9;
    const bool alike = std::abs(with_model) > 0.9 * std::sqrt(own * model);
    if (!too_large || !alike) return;
    throw InputError(fmt::format(
        "{}: slip_angle_deg: {} is not valid (allowed: degrees, -90 to 90); the side forces are "
        "{:.0f} times those of such small angles; suspected: radians",
        recording_.place(first), runs()[first].slip_angle_rad / kDegree,
        std::sqrt(own / as_degrees)));
  }

  /// Both forces of the runs that have them, each over its load, beside the model's.
  std::vector<std::array<double, 4>> force_pairs() const {
    std::vector<std::array<double, 4>> pairs;
    for (std::size_t i = 0; i < runs().size(); ++i) {
      const WheelRun& run = runs()[i];
      const double fx = run.value(Channel::kFx), fy = run.value(Channel::kFy);
      if (std::isnan(fx + fy) || !has_forces(recording_.forces(i).status)) continue;
      const WheelForces& model = recording_.forces(i);
      pairs.push_back(
          {fx / run.load_n, fy / run.load_n, model.fx_n / run.load_n, model.fy_n / run.load_n});
    }
    return pairs;
  }

  /// Forces that come much nearer to the model with their columns exchanged.
  void check_exchanged() {
    constexpr std::size_t kFewest = 4;
    const auto pairs = force_pairs();
    if (pairs.size() < kFewest) return;
    double told = 0, exchanged = 0;
    for (const auto& [fx, fy, model_fx, model_fy] : pairs) {
      told += std::pow(fx - model_fx, 2) + std::pow(fy - model_fy, 2);
      exchanged += std::pow(fy - model_fx, 2) + std::pow(fx - model_fy, 2);
    }
    constexpr double kMuch = 3;
    if (told <= kMuch * kMuch * exchanged) return;
    const auto rms = [&](double sum) { return std::sqrt(sum / static_cast<double>(pairs.size())); };
    warnings_.push_back(fmt::format(
        "{}: fx_n and fy_n lie {:.2g} of the load off the model, and {:.2g} with their columns "
        "exchanged; are they?",
        recording_.file().file, rms(told), rms(exchanged)));
  }

  void check_kilograms() {
    for (const auto& [channel, factor] : in_kilograms()) {
      warnings_.push_back(fmt::format("{}: {} is {:.2g} times the model's; suspected: {}",
                                      recording_.file().file, name(channel), factor,
                                      channel == Channel::kTorque ? "kgf m for N m" : "kgf for N"));
    }
  }

  /// Loads in kgf with forces that are as well: their ratio hardly tells it, the sinkage does.
  void check_load_in_kilograms() {
    std::vector<double> as_told;
    for (std::size_t i = 0; i < runs().size(); ++i) {
      if (!recording_.is_comparable(i, Channel::kSinkage)) continue;
      as_told.push_back(runs()[i].value(Channel::kSinkage) / recording_.forces(i).sinkage_m);
    }
    // Of 211 recordings of challenges in newtons the median is 0.6 to 1.7 times the model's and
    // none is suspected, of the same in kilograms it is 1.7 to 8.5 times and 189 are.
    constexpr double kFarAbove = 2, kNear = 1.5, kForcesOff = 0.25;
    constexpr std::size_t kFewest = 4;
    if (as_told.size() < kFewest || quantile(as_told, 0.5) < kFarAbove) return;
    const AsKilograms kilograms = as_kilograms();
    if (kilograms.sinkages.size() < kFewest) return;
    const double times = quantile(kilograms.sinkages, 0.5);
    if (std::abs(std::log(times)) > std::log(kNear)) return;
    if (kilograms.off > std::min(kilograms.off_as_told, kForcesOff * kForcesOff * kilograms.forces))
      return;
    warnings_.push_back(fmt::format(
        "{}: sinkage_m is {:.2g} times the model's in the median, and {:.2g} times that of a load "
        "9.8 times as large; suspected: load_n, and forces with it, in kgf",
        recording_.file().file, quantile(as_told, 0.5), times));
  }

  /// A recording beside the model under loads of as many kilograms as it tells newtons.
  struct AsKilograms {
    std::vector<double> sinkages;     ///< over the model's
    double off = 0, off_as_told = 0;  ///< squares of forces off the model's, as shares of the load
    int forces = 0;
  };
  AsKilograms as_kilograms() const {
    AsKilograms result;
    for (std::size_t i = 0; i < runs().size(); ++i) {
      const WheelRun& run = runs()[i];
      if (!recording_.is_comparable(i, Channel::kSinkage)) continue;
      const double heavier_n = run.load_n * kStandardGravity_mps2;
      const WheelForces heavier =
          recording_.model()
              .channels(heavier_n, motion_at(run.slip_ratio, run.slip_angle_rad))
              .forces;
      if (!has_forces(heavier.status)) continue;
      result.sinkages.push_back(run.value(Channel::kSinkage) / heavier.sinkage_m);
      for (const auto& [channel, force_n] :
           {std::pair{Channel::kFx, heavier.fx_n}, {Channel::kFy, heavier.fy_n}}) {
        const double share = run.value(channel) / run.load_n;
        if (std::isnan(share)) continue;
        result.off += std::pow(share - force_n / heavier_n, 2);
        result.off_as_told += std::pow(share - recording_.modelled(i, channel) / run.load_n, 2);
        ++result.forces;
      }
    }
    return result;
  }

  void check_speed() {
    if (!recording_.file().recording.columns.speed) return;
    constexpr double kFast_mps = 10;
    for (std::size_t i = 0; i < runs().size(); ++i) {
      const double speed_mps = runs()[i].conditions.speed_mps;
      if (speed_mps <= kFast_mps) continue;
      warnings_.push_back(
          fmt::format("{}: speed_mps: {} is fast for a test bed; suspected: mm/s or cm/s",
                      recording_.place(i), speed_mps));
      return;
    }
  }

  ModelledRecording recording_;
  std::vector<double> as_radians_;
  std::vector<std::string> warnings_;
};

void leave_out(Channel channel, Recording& recording) {
  std::erase(recording.channels, channel);
  for (WheelRun& run : recording.runs) {
    run.measured[static_cast<std::size_t>(channel)] = WheelRun::kNotMeasured;
  }
}

}  // namespace

std::vector<std::string> doubtful_values(const RecordingFile& recording,
                                         const DiagnosisSetup& setup) {
  return Checks(recording, setup).run_all();
}

std::vector<std::string> leave_out_nearly_empty(RecordingFile& file, const DiagnosisSetup& setup) {
  constexpr std::ptrdiff_t kFewest = 4;
  Recording& recording = file.recording;
  std::vector<std::string> told;
  for (const Channel channel : std::vector(recording.channels)) {
    const auto values = std::ranges::count_if(
        recording.runs, [channel](const WheelRun& run) { return !std::isnan(run.value(channel)); });
    const bool is_nearly_empty = values < kFewest && values < std::ssize(recording.runs);
    if (!is_nearly_empty || setup.noise_standard_deviation.contains(channel)) continue;
    leave_out(channel, recording);
    told.push_back(
        fmt::format("{0}: {1} is left out: values in {2} of {3} rows tell neither its noise nor "
                    "where it is off "
                    "(allowed: in {4} and more, or noise: {{{1}: ...}} in the setup)",
                    file.file, name(channel), values, recording.runs.size(), kFewest));
    if (recording.channels.empty()) {
      throw InputError(told.back() + "; no other channel is measured");
    }
  }
  return told;
}

std::optional<std::string> leave_out_kilograms(RecordingFile& recording,
                                               const DiagnosisSetup& setup) {
  constexpr std::size_t kNoChance = 2;
  std::vector<std::string_view> columns;
  std::vector<Channel>& channels = recording.recording.channels;
  const auto in_question = Checks(recording, setup).in_kilograms();
  if (in_question.size() < kNoChance) return std::nullopt;
  for (const auto& [channel, factor] : in_question) {
    columns.push_back(name(channel));
    leave_out(channel, recording.recording);
  }
  std::string left_out = fmt::format(
      "{}: {} are left out: as kgf (kgf m) they say nothing of the physics; remedy: 9.80665 times "
      "their numbers",
      recording.file, fmt::join(columns, ", "));
  if (channels.empty()) throw InputError(left_out + "; no other channel is measured");
  return left_out;
}

}  // namespace regoplan
