#pragma once

#include <string_view>
#include <vector>

namespace regoplan {

/// A number that `diagnose` tells of a name.
struct NamedNumber {
  std::string_view name;
  std::string_view unit;  ///< empty of a share; "of the column" where that depends on the column
};

/// A name that `diagnose` may give and that is no physics of a wheel, so that no model file has it.
struct OtherName {
  std::string_view id;
  std::string_view of;    ///< what it is a fault of: an instrument, the vehicle, the map, nothing
  std::string_view what;  ///< in a sentence
  std::string_view columns;  ///< of the recording or drive in which it shows; empty where in all
  std::vector<NamedNumber> numbers;
};

/// All of them: faults of instruments first, then of vehicles and maps, then the words of a
/// ranking.
const std::vector<OtherName>& other_names();

/// Null where `id` is none of them.
const OtherName* other_name(std::string_view id);

}  // namespace regoplan
