#include "diagnosis/names/claim_shares.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "diagnosis/names/name_share.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

const CandidateFit* fit_of(const std::set<std::string>& ids, const std::vector<ScoredId>& scored) {
  const auto found = std::ranges::find_if(
      scored, [&](const ScoredId& s) { return !ids.empty() && s.account.effects == ids; });
  return found == scored.end() ? nullptr : &found->fit;
}

}  // namespace

void measure_shares(const CalibratedRecording& calibrated, const std::vector<ScoredId>& scored,
                    const CandidateFit& fit, int threads, std::vector<Claim>& claims) {
  // As they were where what noise alone makes of them would not be believed.
  const auto alone = [&](const CandidateFit& names) {
    CandidateFit refitted = fitted_alone(calibrated, names);
    const bool is_believed =
        objection(calibrated.problem(), refitted, Thresholds::kPlausibleFault).empty();
    return is_believed ? refitted : names;
  };
  const auto measured = [&](const CandidateFit& with, const std::optional<CandidateFit>& without) {
    return without ? added_share(calibrated, alone(with), *without, threads)
                   : name_share(calibrated, alone(with), threads);
  };
  std::set<std::string> before;
  for (Claim& claim : claims) {
    std::optional<CandidateFit> without;
    if (const CandidateFit* found = fit_of(before, scored)) without = alone(*found);
    std::set<std::string> names = before;
    names.insert(claim.id);
    const CandidateFit* with = names.size() == claims.size() ? &fit : fit_of(names, scored);
    if (with == nullptr) return;
    const NameShare share = measured(*with, without);
    if (!share.is_told) return;
    claim.share = share.share;
    claim.member_shares[claim.id] = *claim.share;
    for (const std::string& id : claim.equivalent) {
      std::set<std::string> instead = before;
      instead.insert(id);
      const CandidateFit* other = fit_of(instead, scored);
      if (other != nullptr) claim.member_shares[id] = measured(*other, without).share;
    }
    before = std::move(names);
  }
}

}  // namespace regoplan
