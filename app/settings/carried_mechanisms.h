#pragma once

#include <string>
#include <vector>

#include "terramech/mechanisms/mechanism.h"

namespace regoplan {

/// Takes away what a model file says of the test bed that it was fitted on, and not of wheel and
/// soil: a tilt of its bed, loads and speeds told wrongly, a place along it. A vehicle's own loads,
/// speeds and slopes are known.
/// \param file of the model, for the notices
/// \returns a notice for each that was taken away, and for each that stays and does nothing in a
/// plan, which knows one pass of each wheel and no time of day
std::vector<std::string> leave_test_bed_behind(std::vector<Mechanism>& mechanisms,
                                               const std::string& file);

}  // namespace regoplan
