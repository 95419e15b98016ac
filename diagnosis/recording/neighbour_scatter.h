#pragma once

#include <vector>

#include "diagnosis/recording/condition_groups.h"
#include "diagnosis/recording/run_scatter.h"

namespace regoplan {

/// Scatter between neighbouring conditions of what the model leaves: each run against the mean of
/// its two nearest. Of normal noise its square lies a tenth to three fifths too high in the mean,
/// and scatters as with the degrees of freedom that are told (tested).
/// \param value per run; not measured (NaN) does not count
/// \param model per run
/// \return a deviation of 0 with fewer than 4 runs
RunScatter neighbour_scatter(const std::vector<Condition>& conditions,
                             const std::vector<double>& value, const std::vector<double>& model);

}  // namespace regoplan
