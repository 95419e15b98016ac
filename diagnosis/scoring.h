#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnosis/candidate_fit.h"

namespace regoplan {

/// Everything of one id that was scored.
struct ScoredId {
  std::string id;
  double score = 0;  ///< log marginal likelihood, forms marginalised
  double probability = 0;
  CandidateFit fit;  ///< of the likeliest form
};

struct ScoringOptions {
  int threads = 2;
  std::stop_token stop = {};
  std::function<void(double)> progress = {};
};

/// Scores `none`, `parameters`, `unexplained`, every effect alone and promising pairs of them.
/// \param wide soil with priors widened, for `parameters`
std::vector<ScoredId> score_candidates(const FitProblem& problem, const FitProblem& wide,
                                       const std::vector<Effect>& effects,
                                       const ScoringOptions& options);

/// Fills in the probabilities.
/// \param no_lack_of_fit whether the test for lack of fit stays silent
void weigh(std::vector<ScoredId>& scored, bool no_lack_of_fit);

}  // namespace regoplan
