#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace regoplan {

/// A stretch whose soil is free.
struct KnownZone {
  Eigen::VectorXd share;    ///< of each window that lies in it
  Eigen::MatrixXd columns;  ///< white, what each number of its soil changes, by a deviation
};

/// Everything that competes to explain a drive, in white data: to first order, what each changes.
struct EffectContest {
  Eigen::VectorXd data;
  /// What varies from window to window without a name and without being noise of one window, by one
  /// deviation each: the ground's slopes off the map's.
  Eigen::MatrixXd ground;
  /// A column for each parameter, by the size that a sound vehicle is off (one standard deviation).
  Eigen::MatrixXd parameters;
  std::vector<bool> claimable;  ///< of each parameter: a fault has a name
  /// Columns of soil of its own: for each window one for each number, by a standard deviation. Soil
  /// along one window may change its neighbours too.
  Eigen::MatrixXd soil;
  std::size_t soil_numbers = 0;
  /// Ways in which soils differ from each other, each as far as one standard deviation among them:
  /// the fit of a known zone may go far along them.
  std::vector<Eigen::VectorXd> wide_directions;
  /// Soils that a zone may well have, as numbers by which it would differ, each one deviation long:
  /// less evidence shows one of these than a soil of which nothing is known.
  std::vector<Eigen::VectorXd> likely_soils;
  std::vector<bool> follows;  ///< whether a window follows the one before: zones do not jump
  std::vector<KnownZone> zones_known;     ///< whose soil is free already
  std::vector<std::size_t> faults_known;  ///< parameters that are free already
};

/// A fault by itself, beside all that varies without a name; in units of the parameter's column.
struct FaultAlone {
  std::size_t parameter = 0;
  double size = 0, std = 0;  ///< whatever a sound vehicle is off
  double gain = 0;           ///< twice the nats of evidence
  double least_shown = 0;    ///< four of five faults of this size stand out
};

/// An effect that the data may need: a parameter or a zone.
struct EffectFound {
  bool is_zone = false;
  std::size_t parameter = 0;
  double size = 0, std = 0;                     ///< in units of the parameter's column
  double begins = 0, ends = 0;                  ///< of the zone, in windows
  double begins_slant = 0, ends_slant = 0;      ///< of its borders; see WindowZone
  Eigen::VectorXd share;                        ///< of each window that lies in the zone
  std::array<double, 2> first_at{}, last_at{};  ///< 95 % of where it begins and ends, in windows
  /// The likely soil whose evidence is most in the zone, and how much of it is there; nothing where
  /// soil of any numbers has more.
  std::optional<std::size_t> like;
  double like_size = 0, like_std = 0;
  double gain = 0;    ///< twice the nats of evidence over a sound vehicle on the map's soils
  double chance = 0;  ///< what one contest in a thousand gains by chance
  double asked = 0;   ///< gain that a zone needs to stand out
  double sigmas = 0;
  bool stands_out = false;
  std::vector<FaultAlone> faults;  ///< all that may be claimed and are not known
  std::vector<FaultAlone> alike;   ///< those of them that explain as much, or the same
  bool zone_alike = false;         ///< some zone explains as much
};

/// How much of each window lies between two places along them.
Eigen::VectorXd shares_between(double begins, double ends, std::size_t windows);

/// A fault as if it were to be found now, whatever is stronger; of those that are known, all others
/// stand. `faults` and `alike` tell which others there are beside those that stand.
EffectFound judged_anew(EffectContest contest, std::size_t fault, std::uint64_t seed);

/// The strongest of all effects, judged against the largest gain in null draws of the whole
/// contest: sound vehicles, soils within their spread, normal noise.
EffectFound strongest_effect(const EffectContest& contest, std::uint64_t seed);

/// Of each likely soil, the fewest windows from which on four of five zones of it gain as much as
/// is asked, at nine of ten places; nothing: none do of the lengths at which zones are sought.
std::vector<std::optional<int>> shortest_zones_shown(const EffectContest& contest, double asked);

/// The most likely parameters and numbers of the known zones' soils, known faults and zones free.
struct ContestFit {
  Eigen::VectorXd parameters, parameters_std;
  std::vector<Eigen::VectorXd> zones;
  std::vector<Eigen::MatrixXd> zones_covariance;
};
ContestFit fit_contest(const EffectContest& contest);

/// Nats by which the data are likely with whatever varies without a name, but for a constant.
double likelihood_nats(const EffectContest& contest);

/// Nats that parameters and zones of a fit cost before anything is measured.
double prior_nats(const EffectContest& contest, const ContestFit& fit);

}  // namespace regoplan
