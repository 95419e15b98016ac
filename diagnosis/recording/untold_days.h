#pragma once

#include <optional>

#include "diagnosis/recording/noise_model.h"
#include "diagnosis/recording/replicates.h"

namespace regoplan {

/// Rounds of replicates that differ from each other as days do.
struct UntoldDays {
  Rounds rounds;
  double gain_nats = 0;  ///< over scatter alone, all channels
};

/// Days that a recording does not tell, where its replicates do: most conditions were run in
/// rounds, nothing says when, and days of one a round are likelier than scatter alone by 5 nats.
std::optional<UntoldDays> untold_days(const Recording& recording,
                                      const std::vector<Condition>& conditions,
                                      const std::vector<ChannelRuns>& channels,
                                      const DiagnosisSetup& setup,
                                      const std::stop_token& stop = {});

}  // namespace regoplan
