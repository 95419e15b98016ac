#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/problem/rejection.h"

namespace regoplan {

/// What comes before the reason why a vehicle cannot stop where its path ends.
inline constexpr std::string_view kCannotStop = "the vehicle cannot stop at the end: ";

/// A reason with what was found and what is allowed, as `slope 31.2 deg (allowed: at most 25 deg)`,
/// in as many digits as tell the two apart. A margin without a number is one that no steady trim
/// gives.
std::string rejection_text(Rejection reason, const std::optional<Exceeded>& exceeded);

/// The same of a state, with its place: `... at (12.00, 3.50)`, and saying so where it is met while
/// stopping.
std::string rejection_text(const RejectedState& rejection);

}  // namespace regoplan
