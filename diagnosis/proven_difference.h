#pragma once

#include <cstdint>

#include "diagnosis/names/calibrated_recording.h"

namespace regoplan {

/// What a fit leaves of a difference, against noise. What shifts a channel by less than one run
/// scatters stands out along its own direction long before it does in the misfit of all: both are
/// tested, each at half of the level, and `p_value` is of both; `f` and `critical` are of the
/// misfit. Where no replicates tell outliers, one run of a channel proves nothing by itself.
/// \throws Interrupted
LackOfFit lack_of_difference(const CalibratedRecording& calibrated, const CandidateFit& fit,
                             std::uint64_t seed);

/// Whether it is more than noise leaves: of two recordings a difference, of a fit a part of it that
/// has no name.
bool is_proven(const LackOfFit& lack);

/// Whether what claims leave of a difference is a part of it without a name: more than noise, and a
/// share that would be worth a further name. A form that is not quite that of the wheel leaves less
/// of a large difference, and stands out from little noise all the same.
bool leaves_a_part(const LackOfFit& left, const std::vector<Claim>& claims);

/// The least that a p value leaves to chance, by the bound of Sellke, Bayarri & Berger (2001, The
/// American Statistician 55, 62-71), with prior odds by which none and some are as likely as each
/// other where a difference begins to be told.
double probability_of_no_difference(double p);

}  // namespace regoplan
