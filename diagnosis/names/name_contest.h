#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/names/calibrated_recording.h"
#include "diagnosis/names/claim.h"

namespace regoplan {

/// A claim that held-out conditions bear.
struct ProvenClaim {
  std::vector<NameClass> names;
  CandidateFit fit;
  std::vector<std::size_t> remainder;  ///< settings of the discrepancy that is added to it
  HeldOut proof;
};

/// Finds out whether the names that score best may be claimed: every effect must do its part on
/// held-out conditions, nothing must speak against it, and what it explains there must be worth a
/// name. What does not hold is given up, and the rest is weighed anew.
class NameContest {
 public:
  /// \param scored weighed
  NameContest(const CalibratedRecording& calibrated, std::vector<ScoredId> scored, PlainModel plain,
              std::uint64_t seed, int threads)
      : calibrated_(calibrated),
        scored_(std::move(scored)),
        plain_(plain),
        seed_(seed),
        threads_(threads) {}

  /// The claim that holds, if any does.
  std::optional<ProvenClaim> decide();

  /// The candidates, weighed as far as they are not given up.
  const std::vector<ScoredId>& scored() const { return scored_; }
  /// What was given up, and why.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct IdleEffect {
    double over_one_nats = 0;  // what the pair scores over the other effect alone
    std::string why;
  };

  std::vector<NameClass> proven_one_by_one();
  double least_over_nats(const ScoredId& single) const;
  std::optional<IdleEffect> idle_effect(const std::vector<NameClass>& claimed) const;
  HeldOut proof_of(const CandidateFit& fit, const std::vector<std::size_t>& remainder) const;
  std::string doubt_about(const CandidateFit& fit) const;
  std::string doubt_about_fault(const CandidateFit& fit) const;
  void share_with_unlisted(std::vector<NameClass>& claimed);
  bool another_holds(const std::vector<NameClass>& refuted, const std::set<std::string>& best);

  const CalibratedRecording& calibrated_;
  std::vector<ScoredId> scored_;
  PlainModel plain_;
  std::uint64_t seed_;
  int threads_;
  std::vector<std::string> notes_;
};

}  // namespace regoplan
