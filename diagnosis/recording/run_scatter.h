#pragma once

namespace regoplan {

/// What runs of a channel scatter by.
struct RunScatter {
  double deviation = 0;        ///< standard deviation of one run
  int degrees_of_freedom = 0;  ///< by which it is known
};

}  // namespace regoplan
