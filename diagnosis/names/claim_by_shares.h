#pragma once

#include <optional>
#include <vector>

#include "diagnosis/names/partial_claim.h"

namespace regoplan {

/// A class of names for a mismatch of which the best explains a third and more however conditions
/// are held out, but so might some name of a nameless one: no single name. In it are those
/// of which some form reaches the share of the best in some way to hold out, the best four. Further
/// classes follow as long as their best adds its part: at most three. Which of a class stands for
/// it, and bears what follows, is what explains most together with what follows: each is tried, and
/// the two best sequences go on (a beam search); a further name, and one in the place of the best
/// of its class, must be worth it. Names that together predict a channel worse than the calibrated
/// model are not taken. \returns nothing where none explains as much, where one stands alone, or
/// where none is left
std::optional<PartialClaim> claim_by_shares(const CalibratedRecording& calibrated,
                                            const std::vector<Effect>& effects, int threads);

}  // namespace regoplan
