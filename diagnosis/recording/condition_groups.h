#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "diagnosis/recording/recording.h"

namespace regoplan {

/// One commanded condition and its replicates.
struct Condition {
  double load_n = 0;  ///< mean of its runs, as slip and slip angle
  double slip_ratio = 0;
  double slip_angle_rad = 0;
  WheelConditions conditions;
  std::string wheel;
  double day = 0;                 ///< of its first run
  bool one_day = true;            ///< whether all its runs are of that day
  double when = 0;                ///< where time is a place: 0 for the first run, 1 for the last
  double after_slip_ratio = 0;    ///< mean slip of the runs before its own; 0 before the first
  double after_slip_range = 0;    ///< from the least to the most of these
  std::vector<std::size_t> runs;  ///< indices into the recording
};

/// Whether runs at other places of the bed may be replicates.
enum class Places { kApart, kTogether };

/// Groups runs into replicates: slip ratio within 0.01 and slip angle within 0.5 deg of each
/// other, pass, speed, position and wheel alike, and loads of one level (levels are where the
/// sorted loads of all runs leave a gap of 8 %). Time and wheel angle do not part replicates.
/// \param used which runs to group
/// \param block per run, where time is a place: runs of different blocks are no replicates
/// \param places kTogether: position parts no replicates either; the position of a condition is
/// that of its first run
std::vector<Condition> group_conditions(const Recording& recording,
                                        const std::vector<std::size_t>& used,
                                        const std::vector<int>& block = {},
                                        Places places = Places::kApart);

/// Level of each value: a new one begins where the sorted values leave a gap above `gap`.
std::vector<std::size_t> levels(const std::vector<double>& values, double gap);

}  // namespace regoplan
