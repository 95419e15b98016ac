#pragma once

#include <optional>

#include "diagnosis/findings/findings.h"
#include "diagnosis/names/claim.h"
#include "diagnosis/names/name_share.h"
#include "diagnosis/names/names_by_chance.h"

namespace regoplan {

/// Names that explain part of a misfit, the likeliest form of each fitted together.
struct PartialClaim {
  std::vector<Claim> claims;
  CandidateFit fit;
  std::vector<CandidateFit> steps;    ///< of the first name, of the first two, ...
  std::vector<CandidateFit> members;  ///< of the first class, one a name, each by itself
};

/// What every step makes of conditions held out by the families that there are most of.
std::vector<NameStep> steps_of(const CalibratedRecording& calibrated, const PartialClaim& claim,
                               int threads);

/// Probabilities of names beside a remainder, adding up to 1 with `unexplained`, `none` and
/// `parameters`. \param chance_p probability that a nameless world gains as much
std::vector<ScoredCandidate> capped_ranking(const std::vector<CappedName>& names, double chance_p);

/// What is likelier than all of these names together, though it may not stand; empty where nothing
/// is.
std::string likelier_than(const std::vector<std::string>& ids,
                          const std::vector<ScoredCandidate>& ranking);

/// Why names that fit alike are no class; empty where they are. Names of wheel and instrument both
/// are one only where they explain everything: an instrument that leaves something unexplained is
/// as likely to stand for that.
std::string objection_to_class(const std::vector<std::string>& ids, bool leave_nothing);

/// What claims leave of the excess misfit; nothing where no share of it was measured.
double remainder_share(const std::vector<Claim>& claims);

/// A claim for the first of a class, its members' shares beside it.
/// \param names as scored \param ids of the class, best first
PartialClaim first_claim(const CalibratedRecording& calibrated,
                         const std::vector<CappedName>& names, const std::vector<std::string>& ids,
                         double chance_p, int threads);

/// Adds names one by one as long as each gains 10 nats and adds its part on held-out conditions,
/// however these are held out: at most three. Names that fit alike join as a class.
void add_further_names(const CalibratedRecording& calibrated, const CappedContest& contest,
                       const std::vector<Effect>& effects, double gain_nats, int threads,
                       PartialClaim& claim);

/// A claim for what stands beside a remainder of a recording's misfit, if anything does. A single
/// name must do better than names do by chance (Thresholds::kByChance_p); a class of names that fit
/// alike must only be likelier than that, as none of them is claimed alone. A class by shares
/// (claim_by_shares) is tried where nothing stands by its evidence.
struct PartialDecision {
  std::optional<PartialClaim> claim;
  std::vector<ScoredCandidate> ranking;
  double chance_nats = 0;
  std::string refused;  ///< why there is none
};
PartialDecision decide_partly(const CalibratedRecording& calibrated,
                              const std::vector<Effect>& effects, std::uint64_t seed, int threads);

}  // namespace regoplan
