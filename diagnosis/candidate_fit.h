#pragma once

#include <vector>

#include "diagnosis/candidate.h"
#include "diagnosis/evidence.h"

namespace regoplan {

/// A candidate fitted to a recording.
struct CandidateFit {
  Candidate candidate;
  Eigen::VectorXd x;           ///< soil, then effects; standard normal beforehand
  Eigen::VectorXd prediction;  ///< at x
  Eigen::MatrixXd jacobian;    ///< at x
  Evidence evidence;
};

/// Derivatives of the model values by x: one column a coordinate.
/// \param prediction at x \param from the first coordinate to take
/// \param central differences of second order, else one-sided
std::optional<Eigen::MatrixXd> jacobian_of(const TestBed& bed,
                                           const std::vector<SoilCoordinate>& soil,
                                           const Candidate& candidate, const Eigen::VectorXd& x,
                                           const Eigen::VectorXd& prediction, Eigen::Index from = 0,
                                           bool central = false, double step = 0.05);

struct FitProblem {
  const TestBed& bed;
  const std::vector<SoilCoordinate>& soil;
  const Discrepancy& discrepancy;
  const Eigen::MatrixXd& soil_free;
};

/// Gauss-Newton from `start`, the discrepancy's settings chosen on the way; nothing where the
/// start has no forces.
std::optional<CandidateFit> fit_candidate(const FitProblem& problem, const Candidate& candidate,
                                          const SettingWeights& weights,
                                          const Eigen::VectorXd& start);

/// Gauss-Newton under fixed settings.
/// \param steps at most
std::optional<CandidateFit> fit_under(const FitProblem& problem, const Candidate& candidate,
                                      const std::vector<std::size_t>& settings,
                                      const Eigen::VectorXd& start, int steps);

}  // namespace regoplan
