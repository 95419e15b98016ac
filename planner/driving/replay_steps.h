#pragma once

namespace regoplan {

/// How finely a control history is driven again, and how often the margins are judged on the way.
struct ReplaySteps {
  double coarse_s = 0;        ///< the search's step; segments are whole multiples of it
  int fine_per_coarse = 1;    ///< integrator steps in it; every one is checked against the limits
  int coarse_per_margin = 1;  ///< margins every so many coarse steps, and at the end
};

}  // namespace regoplan
