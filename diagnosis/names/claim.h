#pragma once

#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/scoring.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {

/// Names that stand for one effect: the likeliest first, then those the data cannot tell from it.
struct NameClass {
  std::vector<std::string> ids;
  double probability = 0;  ///< that one of them is at work
};

/// The claim that the probabilities bear: the smallest set of names that together reach 0.9, of at
/// most 4, or none where nothing reaches it; then the same for a second effect, if one beside the
/// first is likelier than none, of all that it may be.
std::vector<NameClass> claimed_names(const std::vector<ScoredId>& scored);

/// Whether a candidate consists of one effect of each class.
bool is_of(const ScoredId& scored, const std::vector<NameClass>& claimed);

/// The best scored candidate whose every effect is of one of the classes.
const ScoredId* best_of(const std::vector<ScoredId>& scored, const std::vector<NameClass>& claimed);

/// Adds to the names of a claim what may do the same in their place, as far as the recorded
/// channels tell: some usual numbers of it do, nearer than one prediction beats another, its
/// evidence is as near as that of two forms of one name (Thresholds::kNearForm_nats), and nothing
/// speaks against it. Evidence counts there no more than how many numbers each has and how usual
/// they are. \param best the claim's leading names, fitted
void add_names_alike(const FitProblem& problem, const std::vector<ScoredId>& scored,
                     const ScoredId& best, std::vector<NameClass>& claimed);

/// Candidates that have one name of each class, the likeliest first: as many as a class may have.
std::vector<ScoredId> members_of(const std::vector<ScoredId>& scored,
                                 const std::vector<NameClass>& claimed);

/// Why a fitted claim is not believed; empty where it is: an amplitude or a soil number far from
/// what is usual, or a channel that the effect should move and that moved the other way beyond its
/// noise.
/// \param plausible_fault bound of how far an instrument's fault that does not change may lie from
/// what is usual, in deviations; higher where what it leaves is looked at as well
std::string objection(const FitProblem& problem, const CandidateFit& fit,
                      double plausible_fault = Thresholds::kPlausible);

/// Channels in which an effect of a fitted candidate shows beyond the noise.
std::vector<Channel> channels_of(const FitProblem& problem, const CandidateFit& fit,
                                 std::size_t effect);

/// The claims in full.
std::vector<Claim> claims_of(const FitProblem& problem, const std::vector<ScoredId>& scored,
                             const std::vector<NameClass>& claimed, const CandidateFit& fit);

}  // namespace regoplan
