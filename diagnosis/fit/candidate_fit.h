#pragma once

#include <array>
#include <vector>

#include "diagnosis/fit/candidate.h"
#include "diagnosis/fit/evidence.h"

namespace regoplan {

/// A candidate fitted to a recording.
struct CandidateFit {
  Hypothesis candidate;
  Eigen::VectorXd x;           ///< soil, then effects; standard normal beforehand
  Eigen::VectorXd prediction;  ///< at x
  Eigen::MatrixXd jacobian;    ///< at x
  /// Columns by which the forms of the mechanisms may be wrong: what a mechanism adds, times a
  /// smooth function of the conditions that all channels share, and times a factor in each channel.
  /// Each column's factor is standard normal beforehand.
  Eigen::MatrixXd shape;
  double shape_spread = 0;  ///< share by which forms may be wrong, standard deviation
  /// By channel, by what deviations of the noise were multiplied where it was fitted; empty: by 1.
  std::vector<double> widened;
  Evidence evidence;  ///< its x and covariance: x, then the factors of the shape's columns
};

/// Derivatives of the model values by x: one column a coordinate.
/// \param prediction at x \param from the first coordinate to take
/// \param central differences of second order, else one-sided
std::optional<Eigen::MatrixXd> jacobian_of(const TestBed& bed,
                                           const std::vector<SoilCoordinate>& soil,
                                           const Hypothesis& candidate, const Eigen::VectorXd& x,
                                           const Eigen::VectorXd& prediction, Eigen::Index from = 0,
                                           bool central = false, double step = 0.05);

/// What one effect adds to the model values of a fit, the rest as fitted.
std::optional<Eigen::VectorXd> part_of(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
                                       const CandidateFit& fit, std::size_t effect);

/// Index into x of an effect's first coordinate.
Eigen::Index first_of(const std::vector<SoilCoordinate>& soil, const Hypothesis& candidate,
                      std::size_t effect);

struct FitProblem {
  const TestBed& bed;
  const std::vector<SoilCoordinate>& soil;
  const Discrepancy& discrepancy;
  const Eigen::MatrixXd& soil_free;
};

/// Where fitting starts: soil numbers as they are known beforehand or as `beside` has them, its
/// effects with them, further effects each at its own start.
/// \param beside null, or a fit of the candidate's first effects
Eigen::VectorXd start_of(const FitProblem& problem, const Hypothesis& candidate,
                         const CandidateFit* beside = nullptr);

/// Gauss-Newton from `start`, the discrepancy's settings chosen on the way; nothing where the
/// start has no forces.
std::optional<CandidateFit> fit_candidate(const FitProblem& problem, const Hypothesis& candidate,
                                          const SettingWeights& weights,
                                          const Eigen::VectorXd& start);

/// Gauss-Newton with nothing but noise beside it, which is widened channel by channel to what it
/// leaves: where that is far more than noise, each channel counts by how well it is told, and soil
/// numbers stay near their tests.
/// \param widened to begin with, by channel
std::optional<CandidateFit> fit_to_widened(const FitProblem& problem, const Hypothesis& candidate,
                                           std::vector<double> widened,
                                           const Eigen::VectorXd& start, int steps);

/// log(sum of exp(terms)).
double log_sum(const std::vector<double>& terms);

/// Forms of one name together.
struct MarginalFit {
  double log_marginal = 0;
  CandidateFit likeliest;
};
/// \param tried how many forms there were, each as likely beforehand, those without forces included
MarginalFit marginal_of(const std::vector<CandidateFit>& forms, std::size_t tried);

/// Spreads of the mechanisms' forms that are tried and marginalised: close and rough.
constexpr std::array kShapeSpreads{0.1, 0.4};

/// Gauss-Newton under fixed settings.
/// \param steps at most \param shape_spread of the mechanisms' forms, see CandidateFit::shape
std::optional<CandidateFit> fit_under(const FitProblem& problem, const Hypothesis& candidate,
                                      const std::vector<std::size_t>& settings,
                                      const Eigen::VectorXd& start, int steps, double shape_spread);

}  // namespace regoplan
