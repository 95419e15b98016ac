#include "drive_diagnosis/fit/effect_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drive_diagnosis/contest/held_out_stretches.h"
#include "drive_diagnosis/fit/zone_borders.h"

namespace regoplan {
namespace {

constexpr double kSettled = 0.05;  ///< deviations

std::vector<std::size_t> numbers_that_vary(const TerrainMap& map) {
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    const bool varies = std::ranges::any_of(
        map.soils(), [k](const MapSoil& soil) { return soil_spread(soil.soil).at(k) > 0; });
    if (varies) numbers.push_back(k);
  }
  return numbers;
}

}  // namespace

EffectFit::EffectFit(WindowComparison& comparison, const TerrainMap& map,
                     const std::vector<VehicleTrial>& trials, const std::vector<LikelySoil>& likely,
                     const std::stop_token& stop)
    : comparison_(comparison),
      map_(map),
      trials_(trials),
      stop_(stop),
      numbers_(numbers_that_vary(map)),
      linearisation_(comparison, trials, numbers_, stop),
      fit_(nothing_known()) {
  shifts_ = Eigen::MatrixXd::Zero(comparison.measured().rows(),
                                  static_cast<Eigen::Index>(comparison.inputs()));
  for (std::size_t i = 0; i < comparison.size(); ++i) {
    contest_.follows.push_back(comparison.consecutive(i));
  }
  for (const VehicleTrial& trial : trials_) contest_.claimable.push_back(!trial.id.empty());
  contest_.soil_numbers = numbers_.size();
  contest_.wide_directions = differences_among_soils_driven();
  for (const LikelySoil& soil : likely) {
    constexpr double kFarthest = 6;
    contest_.likely_soils.push_back(
        values_of(soil.numbers).cwiseMax(-kFarthest).cwiseMin(kFarthest));
  }
}

EffectFound EffectFit::strongest(std::uint64_t seed) {
  silent_ = windows_at_borders(comparison_, zones());
  EffectFound strongest = strongest_of_heard(seed);
  silent_.clear();
  return strongest;
}

EffectFound EffectFit::strongest_of_heard(std::uint64_t seed) {
  Linearised here = linearise();
  const SoilColumns soil =
      soil_columns(comparison_, numbers_, {deviation(), zones()}, here.windows.base, stop_);
  whiten_soil(soil, here.noise);
  EffectFound strongest = strongest_effect(contest_, seed);
  if (strongest.stands_out || !strongest.is_zone) return strongest;
  // A zone that is there has widened the noise that it was held against, and slopes that err alike
  // from window to window would pass for it.
  std::vector<Eigen::MatrixXd>& numbers = here.windows.zones.emplace_back();
  for (const std::vector<Eigen::MatrixXd>& by_window : soil) {
    Eigen::MatrixXd& number = numbers.emplace_back(0 * here.windows.base);
    for (std::size_t w = 0; w < by_window.size(); ++w) {
      number += strongest.share[static_cast<Eigen::Index>(w)] * by_window[w];
    }
  }
  contest_.zones_known.push_back({.share = strongest.share, .columns = {}});
  const ResidualNoise noise = whiten(here.windows);
  contest_.zones_known.pop_back();
  whiten_soil(soil, noise);
  return strongest_effect(contest_, seed);
}

void EffectFit::add(const EffectFound& effect) {
  if (effect.is_zone) {
    contest_.zones_known.push_back({.share = effect.share, .columns = {}});
    edges_.push_back(edges_of(effect));
    fit_.zones.emplace_back(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbers_.size())));
  } else {
    contest_.faults_known.push_back(effect.parameter);
    free_beside_known();
  }
}

void EffectFit::withdraw(std::size_t fault) {
  std::erase(contest_.faults_known, fault);
  free_beside_known();
}

/// Parameters that go with an effect are free where it is known.
void EffectFit::free_beside_known() {
  std::vector<std::size_t>& known = contest_.faults_known;
  const auto goes_with = [this](std::size_t k) { return !trials_[k].beside.empty(); };
  std::erase_if(known, goes_with);
  std::vector<std::size_t> freed;
  for (std::size_t k = 0; k < trials_.size(); ++k) {
    const auto is_beside = [&](std::size_t fault) {
      return trials_[fault].id == trials_[k].beside;
    };
    if (goes_with(k) && std::ranges::any_of(known, is_beside)) freed.push_back(k);
  }
  known.insert(known.end(), freed.begin(), freed.end());
}

SoilNumbers EffectFit::numbers_of(const Eigen::VectorXd& values) const {
  SoilNumbers numbers{};
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    numbers.at(numbers_[k]) = values[static_cast<Eigen::Index>(k)];
  }
  return numbers;
}

/// Of the numbers that vary.
Eigen::VectorXd EffectFit::values_of(const SoilNumbers& numbers) const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(numbers_.size()));
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    values[static_cast<Eigen::Index>(k)] = numbers.at(numbers_[k]);
  }
  return values;
}

/// In the mean of the map's soils that were driven on.
std::vector<Eigen::VectorXd> EffectFit::differences_among_soils_driven() const {
  std::vector<Eigen::VectorXd> sum;
  double count = 0;
  for (std::size_t i = 0; i < map_.soils().size(); ++i) {
    if (!comparison_.soils_driven()[i]) continue;
    const std::vector<SoilNumbers> differences = differences_among_soils(map_.soils()[i].soil);
    sum.resize(differences.size(), values_of({}));
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += values_of(differences[k]);
    ++count;
  }
  for (Eigen::VectorXd& difference : sum) difference /= count;
  return sum;
}

std::vector<WindowZone> EffectFit::zones() const {
  std::vector<WindowZone> result;
  for (std::size_t z = 0; z < fit_.zones.size(); ++z) {
    result.push_back({.begins = edges_[z].begins,
                      .ends = edges_[z].ends,
                      .soil = soil_of(z),
                      .numbers = numbers_of(fit_.zones[z]),
                      .begins_slant = edges_[z].begins_slant,
                      .ends_slant = edges_[z].ends_slant});
  }
  return result;
}

Eigen::MatrixXd EffectFit::predicted() const {
  return comparison_.predicted(comparison_.all(), deviation(), zones(),
                               comparison_.predicted_as_said(stop_), stop_);
}

/// Brings data and columns of the contest to the present fit.
EffectFit::Linearised EffectFit::linearise() {
  Linearised here = linearise(linearisation_.predicted(fit_, zones(), shifts_));
  shifts_ = here.noise.inputs_given(here.windows.data - here.windows.changed_by(fit_));
  return here;
}

EffectFit::Linearised EffectFit::linearise(PredictedWindows predicted) {
  LinearisedWindows here = linearisation_.linearised(std::move(predicted), fit_, zones());
  ResidualNoise noise = whiten(here);
  return {.windows = std::move(here), .noise = std::move(noise)};
}

/// What the present fit leaves, under the scatter that fits are compared by.
EffectFit::Weighed EffectFit::weigh() {
  PredictedWindows here = linearisation_.predicted(fit_, zones(), shifts_);
  ResidualNoise noise =
      scatter_ ? ResidualNoise(residual_parts(here.windows), *scatter_) : linearise(here).noise;
  shifts_ = noise.inputs_given(here.left);
  return {.windows = std::move(here), .noise = std::move(noise), .is_linearised = !scatter_};
}

/// By how many nats what the present fit leaves is unlikely. Where a zone's soil carries the
/// vehicle nowhere in it nothing is predicted there but what the map says, and no soil is likelier
/// than another: infinite.
double EffectFit::nats(const PredictedWindows& here, const ResidualNoise& noise) const {
  if (!linearisation_.is_carried(here, fit_, zones())) {
    return std::numeric_limits<double>::infinity();
  }
  return noise.nats(here.left);
}

void EffectFit::go_on_from(Settled settled) {
  fit_ = std::move(settled.fit);
  shifts_ = std::move(settled.shifts);
  comparison_.shift_inputs(shifts_);
}

void EffectFit::settle() {
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    linearise();
    if (step() < kSettled) break;
  }
}

/// All parameters where they are said to be, as well known as they are said to be.
ContestFit EffectFit::nothing_known() const {
  const auto count = static_cast<Eigen::Index>(trials_.size());
  return {.parameters = Eigen::VectorXd::Zero(count),
          .parameters_std = Eigen::VectorXd::Ones(count),
          .zones = {},
          .zones_covariance = {}};
}

OutsideZones EffectFit::fit_outside_zones() {
  WindowSet in_zones = comparison_.touching(zones());
  if (comparison_.size() - in_zones.size() < kFewestOutside) {
    return {.fit = nothing_known(), .soils_held_out_nats = {}};
  }
  const Settled here{.fit = fit_, .shifts = shifts_};
  silent_ = std::move(in_zones);
  if (silent_.empty()) {
    linearise();
  } else {
    settle();
  }
  OutsideZones outside{.fit = fit_, .soils_held_out_nats = soils_held_out_nats()};
  silent_.clear();
  go_on_from(here);
  return outside;
}

std::vector<double> EffectFit::soils_held_out_nats() const {
  std::vector<double> nats;
  for (std::size_t soil = 0; soil < map_.soils().size(); ++soil) {
    const std::vector<std::size_t> numbers = trials_of_soil(trials_, soil);
    nats.push_back(held_out_nats(contest_, numbers, comparison_.measured().cols()));
  }
  return nats;
}

void EffectFit::settle_with(EffectFound& effect) {
  if (effect.is_zone) {
    settle_zone(effect);
  } else {
    settle_beside_zones();
  }
}

void EffectFit::settle_beside_zones() {
  if (fit_.zones.empty()) {
    settle();
    return;
  }
  silent_ = windows_at_borders(comparison_, zones());
  go_on_from(settled_from_here());
  silent_.clear();
}

/// Steps are taken where they lead to what is likelier, and else shortened, until nothing changes
/// by more than noise would.
EffectFit::Settled EffectFit::settled_from_here(int steps_most) {
  constexpr double kShorter = 0.4, kSmallest = 0.1, kSame_nats = 0.1;
  Settled best;
  ContestFit towards;
  double share = 1;
  for (int round = 0; round < steps_most && share > kSmallest; ++round) {
    const Settled here{.fit = fit_, .shifts = shifts_};
    Weighed weighed = weigh();
    const double all_nats = nats(weighed.windows, weighed.noise) + prior_nats(contest_, fit_);
    const bool is_same = round > 0 && std::abs(all_nats - best.nats) < kSame_nats;
    if (round == 0 || all_nats < best.nats) {
      best = {.fit = here.fit, .shifts = here.shifts, .nats = all_nats};
      if (!weighed.is_linearised) linearise(std::move(weighed.windows));
      step();
      towards = fit_;
      best.fit.parameters_std = towards.parameters_std;
      best.fit.zones_covariance = towards.zones_covariance;
      share = std::min(1.0, share / kShorter);
    } else {
      share *= kShorter;
      shifts_ = best.shifts;
    }
    if (is_same) break;
    fit_ = towards;
    fit_.parameters = best.fit.parameters + share * (towards.parameters - best.fit.parameters);
    for (std::size_t z = 0; z < fit_.zones.size(); ++z) {
      fit_.zones[z] = best.fit.zones[z] + share * (towards.zones[z] - best.fit.zones[z]);
    }
  }
  return best;
}

/// To the most likely parameters as the contest is linearised; steps that are long are shortened.
/// \returns the longest part of it, in deviations of what a sound vehicle and its soils are off
double EffectFit::step() {
  constexpr double kLongest = 1.5, kZoneLongest = 4, kZoneFarthest = 24;  // deviations
  ContestFit next = fit_contest(contest_);
  const double longest = longest_of_sound(next.parameters - fit_.parameters);
  if (longest > kLongest) {
    next.parameters = fit_.parameters + kLongest / longest * (next.parameters - fit_.parameters);
  }
  for (std::size_t z = 0; z < next.zones.size(); ++z) {
    const Eigen::VectorXd off = next.zones[z] - fit_.zones[z];
    const double length = off.cwiseAbs().maxCoeff();
    if (length > kZoneLongest) next.zones[z] = fit_.zones[z] + kZoneLongest / length * off;
    next.zones[z] = next.zones[z].cwiseMax(-kZoneFarthest).cwiseMin(kZoneFarthest);
  }
  fit_ = std::move(next);
  return longest;
}

/// Of a step, how far it takes whatever a sound vehicle and its soils may be off.
double EffectFit::longest_of_sound(const Eigen::VectorXd& step) const {
  double longest = 0;
  for (std::size_t k = 0; k < trials_.size(); ++k) {
    const auto& known = contest_.faults_known;
    if (std::ranges::find(known, k) != known.end()) continue;
    longest = std::max(longest, std::abs(step[static_cast<Eigen::Index>(k)]));
  }
  return longest;
}

int EffectFit::soil_at(std::size_t i) const {
  const std::vector<WindowInput::Place>& places = comparison_.input(i).places;
  const WindowPart& middle = places[places.size() / 2].part;
  return map_.soil_index(middle.x_m, middle.y_m).value_or(0);
}

/// The soil of the map that most of a zone is said to be.
int EffectFit::soil_of(std::size_t zone) const {
  const Eigen::VectorXd& share = contest_.zones_known[zone].share;
  std::vector<double> lies_on(map_.soils().size());
  for (std::size_t i = 0; i < comparison_.size(); ++i) {
    lies_on[static_cast<std::size_t>(soil_at(i))] += share[static_cast<Eigen::Index>(i)];
  }
  return static_cast<int>(std::ranges::max_element(lies_on) - lies_on.begin());
}

}  // namespace regoplan
