#pragma once

#include <vector>

#include "diagnosis/recording/condition_groups.h"

namespace regoplan {

struct NeighbourScatter {
  double deviation = 0;        ///< of one run; 0 where there are too few
  int degrees_of_freedom = 0;  ///< by which it is known
};

/// Scatter between neighbouring conditions of what the model leaves: each run against the mean of
/// its two nearest.
/// \param value, model per run; values not measured (NaN) do not count
NeighbourScatter neighbour_scatter(const std::vector<Condition>& conditions,
                                   const std::vector<double>& value,
                                   const std::vector<double>& model);

}  // namespace regoplan
