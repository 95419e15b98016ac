#pragma once

#include <cstdint>
#include <vector>

#include "diagnosis/names/capped_contest.h"

namespace regoplan {

// What names reach in worlds whose misfit has none. They are linear in their numbers there.

/// What the best of the names has over a misfit without one, in every such world. Sorted.
std::vector<double> nats_by_chance(const CalibratedRecording& calibrated,
                                   const CappedContest& contest,
                                   const std::vector<CappedName>& names, std::uint64_t seed,
                                   int threads);

/// What one nameless world in forty reaches, of all in order.
double reached_by_chance(const std::vector<double>& nats);

/// How often such a world lets some name alone explain as large a share of its excess misfit, in
/// sample, as the best does of the recording's.
double chance_of_share(const CalibratedRecording& calibrated, const CappedContest& contest,
                       const std::vector<CappedName>& names, std::uint64_t seed);

/// How often chance reaches as much, what is judged being one more of its draws.
double chance_of(const std::vector<double>& by_chance, double reached);

}  // namespace regoplan
