#pragma once

#include <string>
#include <string_view>

#include "planner/problem/plan_result.h"

namespace regoplan {

/// What comes before the reason why a vehicle cannot stop where its path ends.
inline constexpr std::string_view kCannotStop = "the vehicle cannot stop at the end: ";

/// The unit in which a number stands in messages and files: degrees for radians, else SI.
struct ShownUnit {
  double per_si = 1;      ///< shown = per_si times the number in SI
  std::string_view name;  ///< `deg`, `m`, `m/s`, `1/m`; empty of a ratio or a margin
};

/// \param reason a `Rejection`'s name, `steering` or `deviation`
ShownUnit shown_unit(std::string_view reason);

/// A reason with what was found and what is allowed, as `slope 31.2 deg (allowed: at most 25 deg)`,
/// in as many digits as tell the two apart. A margin of minus infinity is one that no steady trim
/// gives; one that is not a number is not told.
std::string rejection_text(std::string_view reason, double value, double limit);

/// The same of a state, with its place: `... at (12.00, 3.50)`, and saying so where it is met while
/// stopping.
std::string rejection_text(const RejectedState& rejection);

}  // namespace regoplan
