#include "diagnosis/names/suspects.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/recording/thresholds.h"

namespace regoplan {

std::vector<std::string> suspects_of(const CalibratedRecording& calibrated,
                                     const std::vector<ScoredId>& scored) {
  constexpr std::size_t kMost = 3;
  const Eigen::VectorXd& base = calibrated.base().x;
  std::vector<Eigen::Index> far;
  for (Eigen::Index i = 0; i < base.size(); ++i) {
    if (std::abs(base[i]) > Thresholds::kSuspectPull) far.push_back(i);
  }
  const double parameters = scored_as(Account::Kind::kParameters, scored).score;
  std::vector<const ScoredId*> singles;
  for (const ScoredId& s : scored) {
    if (s.fit.candidate.effects.size() != 1) continue;
    const bool near = std::ranges::all_of(
        far, [&](Eigen::Index i) { return std::abs(s.fit.x[i]) < Thresholds::kUnsuspectPull; });
    const double asked = far.empty() ? Thresholds::kUnprompted_nats : -Thresholds::kAsGood_nats;
    if (near && s.score > parameters + asked) singles.push_back(&s);
  }
  std::ranges::stable_sort(singles, std::greater{}, &ScoredId::score);
  std::vector<std::string> suspects;
  for (std::size_t i = 0; i < std::min(kMost, singles.size()); ++i) {
    suspects.push_back(singles[i]->id());
  }
  return suspects;
}

}  // namespace regoplan
