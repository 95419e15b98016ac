#pragma once

#include "diagnosis/bed/condensed_recording.h"

namespace regoplan {

/// Weighs down outliers that replicates cannot tell: runs that stand alone or two together, and
/// whose mean lies more than 4 standard deviations from what a smooth surface through the other
/// conditions' residuals predicts. At most a twelfth of a channel's conditions.
/// \param prediction of the calibrated model, in the order of TestBed::measured()
CondensedRecording strays_weighed_down(const Recording& recording, CondensedRecording condensed,
                                       const Eigen::VectorXd& prediction);

}  // namespace regoplan
