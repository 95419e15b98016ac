#pragma once

#include <vector>

#include "diagnosis/recording/condition_groups.h"

namespace regoplan {

/// The day as a time where no time is recorded.
Recording with_times(Recording recording);

/// Where times are recorded and no days: a pause of a night begins the next one.
Recording with_days(Recording recording);

/// Whether anything tells one run's time from another's.
bool tells_times(const Recording& recording);

/// Times where none are told: as if the runs had followed each other evenly, a round of replicates
/// a day.
Recording with_even_times(Recording recording, const std::vector<Condition>& conditions);

}  // namespace regoplan
