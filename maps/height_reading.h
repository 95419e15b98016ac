#pragma once

#include <optional>

namespace regoplan {

/// What a person says of the heights in a file, in place of what the file says itself.
struct HeightReading {
  std::optional<double> scale = {};     ///< metres a unit of the file
  std::optional<double> offset_m = {};  ///< height of a stored 0
  std::optional<double> nodata = {};    ///< stored in cells without height
};

}  // namespace regoplan
