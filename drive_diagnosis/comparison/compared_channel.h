#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace regoplan {

/// What was measured of one quantity in each window that is compared, and what a model says of it.
struct ComparedChannel {
  std::string name;                  ///< ends in its unit: `yaw_rate_rad_s`
  std::vector<std::size_t> windows;  ///< indices; the values below stand in their order
  std::vector<double> measured;
  std::vector<double> model;      ///< of map and vehicle as they are said to be; empty without them
  std::vector<double> corrected;  ///< with what was found and estimated, or fitted without them
  double noise = 0;               ///< one standard deviation; 0 where nothing says
};

}  // namespace regoplan
