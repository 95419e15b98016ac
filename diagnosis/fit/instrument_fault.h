#pragma once

#include <Eigen/Core>

#include "diagnosis/bed/wheel_bed.h"
#include "diagnosis/fit/effect.h"

namespace regoplan {

/// What an instrument's fault makes of values.
/// \param x the effect's coordinates \param values of all channels, one behind the other
void apply_fault(const TestBed& bed, const Effect& effect, const Eigen::VectorXd& x,
                 Eigen::VectorXd& values);

}  // namespace regoplan
