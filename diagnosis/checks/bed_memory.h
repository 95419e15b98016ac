#pragma once

#include "diagnosis/fit/candidate_fit.h"

namespace regoplan {

/// Standard deviations by which what a fit leaves follows the slip of the run before, as a bed
/// would that is weaker or softer, or a channel that is off, the more the wheel before slipped: the
/// clearest of some ten ways. What a smooth surface over the runs' own conditions tells does not
/// count. Where every replicate repeats the order of the runs, replicates do not show it.
double deviations_of_memory(const FitProblem& problem, const CandidateFit& fit);

}  // namespace regoplan
