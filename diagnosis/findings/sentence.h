#pragma once

#include <array>
#include <string>

#include "diagnosis/findings/findings.h"

namespace regoplan {

/// The finding in a sentence or two for a person: where, what, how sure, what else, what next.
std::string sentence_of(const Diagnosis& diagnosis);

/// "85 %"; "over 99 %" beyond that, as sentence, summary and page say of the same claim.
std::string probability_words(double probability);

/// The ends of a range to the third digit of the larger: what an end is short of it is no number to
/// read (-0.00057 of a slip ratio beside 0.501 is -0.001).
std::array<double, 2> to_digits_of_the_larger(double from, double to);

}  // namespace regoplan
