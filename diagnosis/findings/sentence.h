#pragma once

#include <string>

#include "diagnosis/findings/findings.h"

namespace regoplan {

/// The finding in a sentence or two for a person: where, what, how sure, what else, what next.
std::string sentence_of(const Diagnosis& diagnosis);

/// "85 %"; "over 99 %" beyond that, as sentence, summary and page say of the same claim.
std::string probability_words(double probability);

}  // namespace regoplan
