#pragma once

#include <vector>

#include "diagnosis/recording/condition_groups.h"

namespace regoplan {

struct NeighbourScatter {
  double deviation = 0;        ///< of one run; 0 where there are too few
  int degrees_of_freedom = 0;  ///< by which it is known
};

/// Scatter between neighbouring conditions of what the model leaves: each run against the mean of
/// its two nearest. Of normal noise its square lies a tenth to three fifths too high in the mean,
/// and scatters as with the degrees of freedom that are told
/// (`NeighbourScatter.IsKnownAsWellAsItSays`). \param value, model per run; values not measured
/// (NaN) do not count
NeighbourScatter neighbour_scatter(const std::vector<Condition>& conditions,
                                   const std::vector<double>& value,
                                   const std::vector<double>& model);

}  // namespace regoplan
