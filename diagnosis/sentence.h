#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace regoplan {

/// The finding in a sentence or two for a person: where, what, how sure, what else, what next.
std::string sentence_of(const Diagnosis& diagnosis);

/// A region in words: "slip_ratio 0.3 to 0.8, slip_angle_deg 16".
std::string words_of(const MismatchRegion& region);

}  // namespace regoplan
