#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <stop_token>
#include <vector>

#include "drive_diagnosis/comparison/vehicle_trials.h"
#include "drive_diagnosis/comparison/window_comparison.h"
#include "drive_diagnosis/contest/effect_contest.h"
#include "drive_diagnosis/contest/residual_noise.h"
#include "drive_diagnosis/contest/slope_errors.h"
#include "drive_diagnosis/fit/likely_edges.h"
#include "drive_diagnosis/fit/likely_soils.h"
#include "drive_diagnosis/fit/soil_columns.h"
#include "drive_diagnosis/fit/window_linearisation.h"

namespace regoplan {

/// What windows that no zone touches say.
struct OutsideZones {
  ContestFit fit;
  /// Of each soil of the map, by how many nats its numbers as they are fitted to the others make
  /// stretches likelier than as they are said to be; see `held_out_nats`. Empty where the windows
  /// are too few to be fitted.
  std::vector<double> soils_held_out_nats;
};

/// Fits all that may be otherwise to a drive's windows, linearised anew about each fit: parameters
/// of a sound vehicle and its soils, and the faults and zones that were found.
class EffectFit {
 public:
  /// All must outlive it. \param likely soils that a zone may well have
  EffectFit(WindowComparison& comparison, const TerrainMap& map,
            const std::vector<VehicleTrial>& trials, const std::vector<LikelySoil>& likely,
            const std::stop_token& stop);
  EffectFit(const EffectFit&) = delete;
  EffectFit& operator=(const EffectFit&) = delete;

  /// The strongest effect of those that are not known yet, about the present fit. Windows at the
  /// borders of known zones say nothing of it: where a wheel changes soils is told no finer than to
  /// `kEdgeErr`, and what that leaves is the zone's, whichever effect it looks like.
  EffectFound strongest(std::uint64_t seed);
  /// A fault as it would be found beside all else that is known by now, whatever is stronger.
  /// \pre an effect was sought after the last was added
  EffectFound judged_anew(std::size_t fault, std::uint64_t seed) const {
    return regoplan::judged_anew(contest_, fault, seed);
  }
  /// Of each likely soil, the fewest windows of a zone that the effect sought last would have been:
  /// see `shortest_zones_shown`.
  std::vector<std::optional<int>> shortest_zones_shown(const EffectFound& sought_last) const {
    return regoplan::shortest_zones_shown(contest_, sought_last.asked);
  }
  /// An effect is known from now on.
  void add(const EffectFound& effect);
  /// A fault is none any more.
  void withdraw(std::size_t fault);
  /// Moves to the most likely parameters, linearised anew about each until they stay: soils off
  /// their means change what everything else does.
  void settle();
  /// The same where zones are known: windows at their borders say nothing.
  void settle_beside_zones();
  /// The same with the effect that was added last. Soils far off are no longer linear, so that
  /// steps may lead away again, and lead elsewhere from a soil like the map's than from weaker
  /// ones, down to what carries no vehicle: the likeliest of where they led counts, each with a
  /// zone that begins and ends where that soil makes it likeliest. While a zone is sought, windows
  /// far from it are what they were, to first order; in the end all are linearised anew.
  void settle_with(EffectFound& effect);

  const ContestFit& fit() const { return fit_; }
  /// The parameters that the windows that no zone touches make likeliest; where these are too few,
  /// as they are said to be. In a zone the ground is far from what the model is good at (wheels
  /// sink deep, its borders are not as sharp as a window is short), and what misfits there would be
  /// taken up by soils and numbers that all other windows share.
  OutsideZones fit_outside_zones();
  /// How far each channel scatters.
  const std::vector<double>& noise() const { return noise_; }
  /// How far the map's slopes err, along and across, root mean square.
  const std::array<double, 2>& slope_errors() const { return slope_errors_; }
  /// Indices of soils' numbers that vary.
  const std::vector<std::size_t>& numbers() const { return numbers_; }
  SoilNumbers numbers_of(const Eigen::VectorXd& values) const;
  /// The parameters as they are fitted.
  VehicleDeviation deviation() const { return deviation(fit_); }
  VehicleDeviation deviation(const ContestFit& fit) const {
    return linearisation_.deviation_of(fit);
  }
  /// What the model says of each window with them and the known zones.
  Eigen::MatrixXd predicted() const;
  /// The soil of the map that most of a zone is said to be. \param zone index of those added
  int soil_of(std::size_t zone) const;
  /// The soil of the map in the middle of a window.
  int soil_at(std::size_t window) const;

 private:
  /// Windows that no zone touches, by which they can be compared with each other.
  static constexpr std::size_t kFewestOutside = 10;

  /// The windows about the present fit.
  struct Linearised {
    LinearisedWindows windows;
    ResidualNoise noise;  ///< that the contest was made white by
  };
  /// The same before it is asked what changes them, where their scatter is known without.
  struct Weighed {
    PredictedWindows windows;
    ResidualNoise noise;
    bool is_linearised = false;  ///< the contest is at the present fit
  };

  /// A fit, and by how many nats what it leaves is unlikely.
  struct Settled {
    ContestFit fit;
    Eigen::MatrixXd shifts;
    double nats = std::numeric_limits<double>::infinity();
  };
  ContestFit nothing_known() const;
  Eigen::VectorXd values_of(const SoilNumbers& numbers) const;
  std::vector<Eigen::VectorXd> differences_among_soils_driven() const;
  std::vector<double> soils_held_out_nats() const;
  std::vector<WindowZone> zones() const;
  Linearised linearise();
  Linearised linearise(PredictedWindows here);
  Weighed weigh();
  double nats(const PredictedWindows& here, const ResidualNoise& noise) const;
  ResidualParts residual_parts(const LinearisedWindows& here) const;
  ResidualNoise whiten(const LinearisedWindows& here);
  double persistence(const SlopeErrors& errors) const;
  EffectFound strongest_of_heard(std::uint64_t seed);
  void whiten_soil(const SoilColumns& soil, const ResidualNoise& noise);
  std::optional<ScatterSources> scatter_outside(const LinearisedWindows& here,
                                                const Eigen::VectorXd& zone) const;
  bool place_edges(EffectFound& zone);
  void free_beside_known();
  void take_edges(const EffectFound& zone);
  SoilNumbers told_from(int soil, int before, const SoilNumbers& numbers) const;
  void go_on_from(Settled settled);
  void settle_zone(EffectFound& zone);
  WindowSet windows_far_from_linear(const LinearisedWindows& here) const;
  Settled likeliest_soil(const Settled& start, EffectFound& zone);
  bool has_motions_in_last_zone();
  Settled settled_with_edges(EffectFound& zone);
  Settled settled_from_here(int steps_most = 10);
  double step();
  double longest_of_sound(const Eigen::VectorXd& step) const;

  WindowComparison& comparison_;
  const TerrainMap& map_;
  const std::vector<VehicleTrial>& trials_;
  const std::stop_token& stop_;
  Eigen::MatrixXd shifts_;            ///< of the inputs that were linearised about
  std::vector<std::size_t> numbers_;  ///< of soil, that vary
  WindowLinearisation linearisation_;
  EffectContest contest_;
  ContestFit fit_;
  std::vector<ZoneBorders> edges_;  ///< of each zone
  /// How far residuals scatter, where fits are compared by it; else as each fit leaves it.
  std::optional<ScatterSources> scatter_;
  WindowSet silent_;  ///< windows that say nothing
  /// By window and channel, what the borders of zones change as far as these may lie off.
  Eigen::MatrixXd border_std_;
  std::vector<double> noise_;
  std::array<double, 2> slope_errors_{};
};

}  // namespace regoplan
