#pragma once

#include <string>

#include "app/compare/comparison.h"

namespace regoplan {

/// Two results side by side, for people: one self-contained HTML page.
std::string comparison_report(const ComparedResult& a, const ComparedResult& b,
                              const Comparison& comparison);

}  // namespace regoplan
