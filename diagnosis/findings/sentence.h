#pragma once

#include <string>

#include "diagnosis/findings/findings.h"

namespace regoplan {

/// The finding in a sentence or two for a person: where, what, how sure, what else, what next.
std::string sentence_of(const Diagnosis& diagnosis);

}  // namespace regoplan
