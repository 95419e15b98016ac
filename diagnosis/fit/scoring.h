#pragma once

#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/account.h"
#include "diagnosis/fit/candidate_fit.h"

namespace regoplan {

/// One account that was scored, in all of its forms.
struct ScoredId {
  Account account;
  double score = 0;  ///< log marginal likelihood, forms marginalised
  double probability = 0;
  CandidateFit fit;       ///< of the likeliest form
  bool given_up = false;  ///< held-out conditions or its own numbers speak against it

  std::string id() const { return account.id(); }
};

/// The one of these with an account that every scoring has.
/// \pre it is not `kEffects`
const ScoredId& scored_as(Account::Kind kind, const std::vector<ScoredId>& scored);

struct ScoringOptions {
  int threads = 2;
  std::function<void(double)> progress = {};
};

/// Scores `none`, `parameters`, `unexplained`, every effect alone and promising pairs of them.
/// \param wide soil with priors widened, for `parameters`
std::vector<ScoredId> score_candidates(const FitProblem& problem, const FitProblem& wide,
                                       const std::vector<Effect>& effects,
                                       const ScoringOptions& options);

/// By what a difference of evidence is divided before it becomes a probability: forms are proxies,
/// and what names lose by that grows with the signal. Fitted to the log likelihood of the true
/// names of 420 generated challenges (1.2 + 0.22 log(...) there).
/// \param gain_nats of the best name over the model without it
double temperature_of(double gain_nats);

/// What the scores say for a name against the plain model.
NameSupport support_of(const std::vector<ScoredId>& scored, PlainModel tests);

/// Fills in the probabilities, the likeliest first; 0 for what is given up and for what the tests
/// refute.
void weigh(std::vector<ScoredId>& scored, PlainModel plain);

}  // namespace regoplan
