#include "drive_diagnosis/vehicle_effects.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drive_diagnosis/effect_contest.h"
#include "drive_diagnosis/likely_soils.h"
#include "drive_diagnosis/residual_noise.h"
#include "drive_diagnosis/rolling_resistance.h"
#include "drive_diagnosis/slope_errors.h"
#include "drive_diagnosis/vehicle_trials.h"
#include "drive_diagnosis/window_comparison.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

constexpr std::size_t kWindowsLeast = 12;
constexpr double kSettled = 0.05;  ///< deviations
/// How far another soil may be from that of the map, in standard deviations of the map's: weaker in
/// all; and in the logarithm of its bearing, which of sands and regoliths spans two decades (kphi
/// of 1e4 to 1e6) where tests of one soil know it to a quarter.
constexpr double kFarWeaker = 6, kBearing_log = 1.5;
/// By how much more the numbers of a zone err than the fit linearised about them says: wheels that
/// sink deep are far from linear. Root mean square of 30 concealed zones (benchmarks/drives, seeds
/// 401 to 450): friction 2.1, logarithm of the bearing 2.2.
constexpr double kZoneErrs = 2;
constexpr SoilNumbers kOne{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};

/// The contest over a drive, linearised anew about what was found.
class EffectSearch {
 public:
  EffectSearch(const std::vector<DriveWindow>& windows, const TerrainMap& map,
               const Vehicle& vehicle, double gravity_mps2, WindowComparison& comparison,
               const EffectSearchSettings& settings)
      : windows_(windows),
        map_(map),
        vehicle_(vehicle),
        gravity_mps2_(gravity_mps2),
        comparison_(comparison),
        uncertain_(settings.uncertain),
        trials_(vehicle_trials(vehicle, settings.uncertain, map, comparison.soils_driven())),
        likely_(likely_soils(map, comparison.soils_driven())),
        seed_(settings.seed),
        stop_(settings.stop),
        fit_{.parameters = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(trials_.size()))} {
    shifts_ = Eigen::MatrixXd::Zero(comparison.measured().rows(),
                                    static_cast<Eigen::Index>(comparison.inputs()));
    for (std::size_t k = 0; k < kSoilNumbers; ++k) {
      const bool varies = std::ranges::any_of(
          map.soils(), [k](const MapSoil& soil) { return soil_spread(soil.soil).at(k) > 0; });
      if (varies) numbers_.push_back(k);
    }
    for (std::size_t i = 0; i < comparison.size(); ++i) {
      contest_.follows.push_back(comparison.consecutive(i));
    }
    for (const VehicleTrial& trial : trials_) contest_.claimable.push_back(!trial.id.empty());
    contest_.soil_numbers = numbers_.size();
    contest_.wide_directions = {values_of(weaker_by(kFarWeaker)), other_bearing()};
    for (const LikelySoil& likely : likely_) {
      constexpr double kFarthest = 6;
      contest_.likely_soils.push_back(
          values_of(likely.numbers).cwiseMax(-kFarthest).cwiseMin(kFarthest));
    }
  }

  VehicleEffects run() {
    VehicleEffects result{.windows = static_cast<int>(comparison_.size()),
                          .channels = comparison_.channels(),
                          .has_torque = comparison_.has_torque()};
    const Eigen::MatrixXd nothing =
        Eigen::MatrixXd::Zero(comparison_.measured().rows(), comparison_.measured().cols());
    result.rms = rms(comparison_.measured() - comparison_.predicted({}, {}, nothing, stop_));
    constexpr int kEffectsMost = 3;
    settle();  // soils and sensors as they are, before anything is judged
    std::vector<EffectFound> found;
    while (true) {
      EffectFound strongest = strongest_now();
      if (!strongest.stands_out || static_cast<int>(found.size()) == kEffectsMost) {
        result.strongest_left = told(strongest);
        break;
      }
      if (strongest.is_zone) {
        contest_.zones_known.push_back(strongest.share);
        fit_.zones.emplace_back(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbers_.size())));
      } else {
        contest_.faults_known.push_back(strongest.parameter);
      }
      found.push_back(std::move(strongest));
      settle_with(found.back());
    }
    std::size_t zone = 0;
    for (const EffectFound& effect : found) {
      VehicleFinding finding = told(effect);
      if (effect.is_zone) {
        finding.zone = zone_of(effect, zone++);
        finding.size = finding.zone->resistance.value;
        finding.std = finding.zone->resistance.std;
      } else {
        const auto k = static_cast<Eigen::Index>(effect.parameter);
        finding.size = fit_.parameters[k] * trials_[effect.parameter].unit;
        finding.std = fit_.parameters_std[k] * trials_[effect.parameter].unit;
      }
      result.found.push_back(std::move(finding));
    }
    result.noise = noise_;
    result.vehicle = estimated_vehicle(uncertain_, trials_, fit_.parameters, fit_.parameters_std);
    result.soils = soils_left();
    result.rms_after = rms(comparison_.measured() - predicted());
    return result;
  }

 private:
  VehicleDeviation deviation() const {
    VehicleDeviation sum;
    for (std::size_t k = 0; k < trials_.size(); ++k) {
      const double size = fit_.parameters[static_cast<Eigen::Index>(k)];
      if (size != 0) sum.add(trials_[k].deviation, size);
    }
    return sum;
  }

  SoilNumbers numbers_of(const Eigen::VectorXd& values) const {
    SoilNumbers numbers{};
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      numbers.at(numbers_[k]) = values[static_cast<Eigen::Index>(k)];
    }
    return numbers;
  }

  /// Of the numbers that vary.
  Eigen::VectorXd values_of(const SoilNumbers& numbers) const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(numbers_.size()));
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      values[static_cast<Eigen::Index>(k)] = numbers.at(numbers_[k]);
    }
    return values;
  }

  /// Soils of another bearing, in the mean of those driven on.
  Eigen::VectorXd other_bearing() const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbers_.size()));
    double count = 0;
    for (std::size_t i = 0; i < map_.soils().size(); ++i) {
      if (!comparison_.soils_driven()[i]) continue;
      sum += values_of(bearing_by(map_.soils()[i].soil, -kBearing_log));
      ++count;
    }
    return sum / std::max(count, 1.0);
  }

  std::vector<WindowZone> zones() const {
    std::vector<WindowZone> result;
    for (std::size_t z = 0; z < fit_.zones.size(); ++z) {
      const Eigen::VectorXd& share = contest_.zones_known[z];
      result.push_back({.share = {share.begin(), share.end()},
                        .soil = soil_of(share),
                        .numbers = numbers_of(fit_.zones[z])});
    }
    return result;
  }

  Eigen::MatrixXd predicted() const {
    const Eigen::MatrixXd nothing =
        Eigen::MatrixXd::Zero(comparison_.measured().rows(), comparison_.measured().cols());
    return comparison_.predicted(deviation(), zones(),
                                 comparison_.predicted({}, {}, nothing, stop_), stop_);
  }

  std::vector<double> rms(const Eigen::MatrixXd& residuals) const {
    std::vector<double> result;
    for (Eigen::Index k = 0; k < residuals.cols(); ++k) {
      result.push_back(
          std::sqrt(residuals.col(k).squaredNorm() / static_cast<double>(residuals.rows())));
    }
    return result;
  }

  /// What is measured and what changes it, about the present fit.
  struct Linearised {
    Eigen::MatrixXd data, base;
    std::vector<Eigen::MatrixXd> columns, soil, inputs;
    double nats = 0;  ///< by which what the fit leaves is unlikely
  };

  EffectFound strongest_now() {
    const Linearised here = linearise();
    EffectFound strongest = strongest_effect(contest_, seed_);
    if (strongest.stands_out || !strongest.is_zone) return strongest;
    // A zone that is there has widened the noise that it was held against.
    std::vector<Eigen::VectorXd> zones = contest_.zones_known;
    zones.push_back(strongest.share);
    whiten(here, zones);
    return strongest_effect(contest_, seed_);
  }

  /// Columns and data about the present fit: what is measured less what is predicted there, plus
  /// what the parameters there stand for.
  Linearised linearise() {
    const VehicleDeviation here = deviation();
    const std::vector<WindowZone> zones_here = zones();
    comparison_.shift_inputs(shifts_);
    const Eigen::MatrixXd base = predicted();
    std::vector<Eigen::MatrixXd> columns;
    // Told of the measured inputs, to first order about the likely ones.
    const std::vector<Eigen::MatrixXd> inputs = comparison_.of_inputs(here, base, stop_);
    Eigen::MatrixXd data = comparison_.measured() - base;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      data += shifts_.col(static_cast<Eigen::Index>(k)).asDiagonal() * inputs[k];
    }
    const Eigen::MatrixXd left = data;
    for (std::size_t k = 0; k < trials_.size(); ++k) {
      VehicleDeviation there = here;
      there.add(trials_[k].deviation, 1);
      columns.push_back(comparison_.predicted(there, zones_here, base, stop_) - base);
      data += fit_.parameters[static_cast<Eigen::Index>(k)] * columns.back();
    }
    std::vector<Eigen::MatrixXd> soil;
    for (const std::size_t number : numbers_) {
      VehicleDeviation there = here;
      there.soils.resize(map_.soils().size());
      for (SoilNumbers& numbers : there.soils) numbers.at(number) += 1;
      soil.push_back(comparison_.predicted(there, zones_here, base, stop_) - base);
    }
    for (std::size_t z = 0; z < fit_.zones.size(); ++z) {
      for (Eigen::Index w = 0; w < data.rows(); ++w) {
        for (std::size_t k = 0; k < numbers_.size(); ++k) {
          data.row(w) += contest_.zones_known[z][w] * fit_.zones[z][static_cast<Eigen::Index>(k)] *
                         soil[k].row(w);
        }
      }
    }
    Linearised result{.data = std::move(data),
                      .base = base,
                      .columns = std::move(columns),
                      .soil = std::move(soil),
                      .inputs = inputs};
    const ResidualNoise noise = whiten(result, contest_.zones_known);
    shifts_ = noise.inputs_given(left);
    result.nats = noise.nats(left);
    return result;
  }

  /// Makes data and columns of the contest white.
  /// \param zones stretches whose soil is no noise
  ResidualNoise whiten(const Linearised& here, const std::vector<Eigen::VectorXd>& zones) {
    const auto& [data, base, columns, soil, inputs, nats] = here;
    Eigen::MatrixXd reference = Eigen::MatrixXd::Zero(base.rows(), base.cols());
    for (Eigen::Index k = 0; k < base.cols(); ++k) {
      if (!comparison_.scales(static_cast<std::size_t>(k))) continue;
      const double mean = base.col(k).cwiseAbs().mean();
      if (mean > 0) reference.col(k) = base.col(k) / mean;
    }
    std::vector<Eigen::MatrixXd> global = columns;
    std::vector<bool> may_be_wrong = contest_.claimable;
    for (const Eigen::VectorXd& share : zones) {
      for (const Eigen::MatrixXd& number : soil) {
        global.emplace_back(share.asDiagonal() * number);
        may_be_wrong.push_back(true);
      }
    }
    std::vector<bool> unknown;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      unknown.push_back(k >= comparison_.slope_along());
    }
    ResidualNoise noise({.residuals = data,
                         .columns = std::move(global),
                         .may_be_wrong = std::move(may_be_wrong),
                         .inputs = inputs,
                         .scatters_unknown = unknown,
                         .follows = contest_.follows,
                         .reference = std::move(reference),
                         .sampled_std = comparison_.sampled_std()});
    noise_ = noise.scales();
    contest_.data = noise.whitened(data);
    contest_.parameters.resize(contest_.data.size(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      contest_.parameters.col(static_cast<Eigen::Index>(k)) = noise.whitened(columns[k]);
    }
    contest_.soil.resize(contest_.data.size(),
                         base.rows() * static_cast<Eigen::Index>(numbers_.size()));
    for (Eigen::Index w = 0; w < base.rows(); ++w) {
      for (std::size_t k = 0; k < numbers_.size(); ++k) {
        Eigen::MatrixXd alone = Eigen::MatrixXd::Zero(base.rows(), base.cols());
        alone.row(w) = soil[k].row(w);
        contest_.soil.col(w * static_cast<Eigen::Index>(numbers_.size()) +
                          static_cast<Eigen::Index>(k)) = noise.whitened(alone);
      }
    }
    const std::size_t along = comparison_.slope_along();
    const auto white = [&](std::size_t input) {
      return Eigen::VectorXd(noise.input_scales()[input] * noise.whitened(here.inputs[input]));
    };
    contest_.ground = likely_slope_errors(
        contest_, {.along = white(along), .across = white(along + 1), .channels = base.cols()},
        comparison_.channel("pitch_rad"));
    return noise;
  }

  /// A fit, and by how many nats what it leaves is unlikely.
  struct Settled {
    ContestFit fit;
    Eigen::MatrixXd shifts;
    double nats = std::numeric_limits<double>::infinity();
  };

  void go_on_from(Settled settled) {
    fit_ = std::move(settled.fit);
    shifts_ = std::move(settled.shifts);
    comparison_.shift_inputs(shifts_);
  }

  /// Moves to the most likely parameters, linearised anew about each until they stay: soils off
  /// their means change what everything else does.
  void settle() {
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds; ++round) {
      linearise();
      if (step() < kSettled) break;
    }
  }

  void settle_with(const EffectFound& effect) {
    if (effect.is_zone) {
      settle_zone();
    } else if (fit_.zones.empty()) {
      settle();
    } else {
      go_on_from(settled_from_here());
    }
  }

  /// The same with zones. Soils far off are no longer linear, so that steps may lead away again,
  /// and lead elsewhere from a soil like the map's than from one far weaker: the likeliest of where
  /// they led counts.
  void settle_zone() {
    const Settled start{.fit = fit_, .shifts = shifts_};
    Settled best = settled_from_here();
    go_on_from(start);
    fit_.zones.back() = contest_.wide_directions[0] + contest_.wide_directions[1];
    Settled weak = settled_from_here();
    if (weak.nats < best.nats) best = std::move(weak);
    go_on_from(std::move(best));
  }

  /// Steps are taken where they lead to what is likelier, and else shortened.
  Settled settled_from_here() {
    constexpr int kRounds = 10;
    constexpr double kShorter = 0.4;
    Settled best;
    ContestFit towards;
    double share = 1;
    for (int round = 0; round < kRounds; ++round) {
      const Settled here{.fit = fit_, .shifts = shifts_};
      const double nats = linearise().nats + prior_nats(contest_, fit_);
      if (round == 0 || nats < best.nats) {
        best = {.fit = here.fit, .shifts = here.shifts, .nats = nats};
        step();
        towards = fit_;
        best.fit.parameters_std = towards.parameters_std;
        best.fit.zones_std = towards.zones_std;
        share = std::min(1.0, share / kShorter);
      } else {
        share *= kShorter;
        shifts_ = best.shifts;
      }
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
  double step() {
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
  double longest_of_sound(const Eigen::VectorXd& step) const {
    double longest = 0;
    for (std::size_t k = 0; k < trials_.size(); ++k) {
      const auto& known = contest_.faults_known;
      if (std::ranges::find(known, k) != known.end()) continue;
      longest = std::max(longest, std::abs(step[static_cast<Eigen::Index>(k)]));
    }
    return longest;
  }

  VehicleFinding told(const EffectFound& effect) const {
    VehicleFinding finding{.sigmas = effect.sigmas, .gain = effect.gain, .chance = effect.chance};
    if (effect.is_zone) {
      finding.id = "soil_zone";
      finding.parameter = "resistance_share";
    } else {
      const VehicleTrial& trial = trials_[effect.parameter];
      finding.id = trial.id;
      finding.parameter = trial.parameter;
      finding.size = effect.size * trial.unit;
      finding.std = effect.std * trial.unit;
    }
    finding.equivalent.push_back(finding.id);
    const auto add = [&finding](const std::string& id) {
      if (std::ranges::find(finding.equivalent, id) == finding.equivalent.end()) {
        finding.equivalent.push_back(id);
      }
    };
    for (const std::size_t other : effect.alike) add(trials_[other].id);
    if (effect.zone_alike) add("soil_zone");
    return finding;
  }

  double time_s(double at) const {
    const auto last = static_cast<double>(comparison_.size() - 1);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, last));
    const DriveWindow& window = windows_[comparison_.window(i)];
    return window.start_s + (at - static_cast<double>(i)) * window.duration_s();
  }

  int soil_at(std::size_t i) const {
    const WindowPart& middle = comparison_.input(i).places[DriveWindow::kParts / 2].part;
    return map_.soil_index(middle.x_m, middle.y_m).value_or(0);
  }

  /// The soil of the map that most of a zone is said to be.
  int soil_of(const Eigen::VectorXd& share) const {
    std::vector<double> lies_on(map_.soils().size());
    for (std::size_t i = 0; i < comparison_.size(); ++i) {
      lies_on[static_cast<std::size_t>(soil_at(i))] += share[static_cast<Eigen::Index>(i)];
    }
    return static_cast<int>(std::ranges::max_element(lies_on) - lies_on.begin());
  }

  SoilZoneFound zone_of(const EffectFound& effect, std::size_t index) const {
    std::size_t first = comparison_.size(), last = 0;
    double begins = 0, ends = 0;
    for (std::size_t i = 0; i < comparison_.size(); ++i) {
      const double share = effect.share[static_cast<Eigen::Index>(i)];
      if (share == 0) continue;
      if (first == comparison_.size()) {
        first = i;
        begins = static_cast<double>(i) + 1 - share;
      }
      last = i;
      ends = static_cast<double>(i) + share;
    }
    const auto before_end = [this](double at) { return time_s(at - 1e-9); };
    SoilZoneFound zone{.drive = windows_[comparison_.window(first)].drive,
                       .first = comparison_.window(first),
                       .last = comparison_.window(last),
                       .starts_s = time_s(begins),
                       .ends_s = before_end(ends),
                       .start_s = {time_s(effect.first_at[0]), time_s(effect.first_at[1])},
                       .end_s = {before_end(effect.last_at[0]), before_end(effect.last_at[1])},
                       .soil = soil_of(effect.share)};
    zone.at_border = (first > 0 && soil_at(first - 1) != soil_at(first)) ||
                     (last + 1 < comparison_.size() && soil_at(last + 1) != soil_at(last));
    estimate(index, zone);
    if (!effect.like) return zone;
    const LikelySoil& likely = likely_[*effect.like];
    constexpr double kWithin = 2;  // deviations
    if (likely.here == zone.soil && std::abs(effect.like_size - 1) < kWithin * effect.like_std) {
      zone.like = likely.there;
    }
    return zone;
  }

  /// The map's soils as the fit has them.
  std::vector<MapSoil> soils_left() const {
    return estimated_soils(map_.soils(), deviation().soils,
                           soil_stds(trials_, fit_.parameters_std, map_.soils().size()),
                           comparison_.soils_driven());
  }

  /// The zone's soil: its map soil as it is estimated all along, with the zone's numbers on top.
  void estimate(std::size_t index, SoilZoneFound& zone) const {
    const auto soil = static_cast<std::size_t>(zone.soil);
    SoilNumbers numbers = numbers_of(fit_.zones[index]), stds = kOne;
    const std::vector<SoilNumbers> all_along = deviation().soils;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const std::size_t k = numbers_[i];
      stds.at(k) = kZoneErrs * fit_.zones_std[index][static_cast<Eigen::Index>(i)];
      if (!all_along.empty()) numbers.at(k) += all_along[soil].at(k);
    }
    const UncertainSoil& said = map_.soils()[soil].soil;
    zone.estimate = estimated_soil(said, numbers, stds);
    const Soil before = all_along.empty() ? said.mean : deviating(said, all_along[soil]);
    zone.resistance = added_resistance(vehicle_, gravity_mps2_, before, zone.estimate, seed_);
  }

  const std::vector<DriveWindow>& windows_;
  const TerrainMap& map_;
  const Vehicle& vehicle_;
  double gravity_mps2_;
  WindowComparison& comparison_;
  Eigen::MatrixXd shifts_;  ///< of the inputs that were linearised about
  const UncertainVehicle& uncertain_;
  std::vector<VehicleTrial> trials_;
  std::vector<LikelySoil> likely_;  ///< what the contest's likely soils are
  std::uint64_t seed_;
  const std::stop_token& stop_;
  std::vector<std::size_t> numbers_;  ///< of soil, that vary
  EffectContest contest_;
  ContestFit fit_;
  std::vector<double> noise_;
};

}  // namespace

VehicleComparison find_vehicle_effects(const std::vector<DriveRecording>& drives,
                                       const std::vector<DriveWindow>& windows,
                                       const TerrainMap& map, const Vehicle& vehicle,
                                       double gravity_mps2, const EffectSearchSettings& settings) {
  WindowComparison comparison(drives, windows, map, vehicle, gravity_mps2, settings.threads);
  VehicleComparison result{.windows = comparison.used(), .effects = {}};
  if (comparison.size() < kWindowsLeast) return result;
  result.effects = EffectSearch(windows, map, vehicle, gravity_mps2, comparison, settings).run();
  return result;
}

}  // namespace regoplan
