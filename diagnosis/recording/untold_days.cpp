#include "diagnosis/recording/untold_days.h"

#include <utility>

#include "diagnosis/recording/thresholds.h"

namespace regoplan {

std::optional<UntoldDays> untold_days(const Recording& recording,
                                      const std::vector<Condition>& conditions,
                                      const std::vector<ChannelRuns>& channels,
                                      const DiagnosisSetup& setup, const std::stop_token& stop) {
  if (tells_times_of_replicates(recording, conditions)) return std::nullopt;
  auto rounds = rounds_as_days(recording, conditions);
  if (!rounds || rounds->share_repeated < Thresholds::kInRounds_share) return std::nullopt;
  double gain = 0;
  for (const ChannelRuns& channel : channels) {
    const auto log_likelihood = [&](const Recording& of) {
      return estimate_noise(of, conditions, channel, setup, {}, stop).log_likelihood;
    };
    gain += log_likelihood(rounds->recording) - log_likelihood(recording);
  }
  if (gain < Thresholds::kUntoldDays_nats) return std::nullopt;
  return UntoldDays{std::move(*rounds), gain};
}

}  // namespace regoplan
