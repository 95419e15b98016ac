#pragma once

#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/scoring.h"

namespace regoplan {

/// Conditions within the rig's limits (those of the recording, moderately extended), three
/// replicates each, and further sensors at the recorded conditions, ranked by how far they are
/// expected to part the names: the expected log likelihood ratio between two of them, each with
/// what its fit leaves uncertain, averaged over the pairs. Nats; best first, at most 6, none that
/// parts no pair.
/// \param rivals fitted, one a name, the likeliest first
std::vector<Experiment> next_experiments(const FitProblem& problem,
                                         const std::vector<ScoredId>& rivals);

}  // namespace regoplan
