#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/bed/wheel_bed.h"

namespace regoplan {

/// One column of the operating space: its value at each condition, in the file's unit.
struct ConditionAxis {
  std::string column;
  std::vector<double> value;
  std::vector<std::size_t> level;  ///< of each condition, 0 the lowest
  std::size_t levels = 0;
};

/// The columns that vary: `slip_ratio`, `slip_angle_deg`, `abs_slip_angle_deg` (where both sides
/// were tested), `load_n`, `speed_mps`, `pass`, `position_m`, `time_s`. Levels of slip and the like
/// that lie close together count as one.
std::vector<ConditionAxis> condition_axes(const TestBed& bed);

/// `after_slip_ratio`, the slip of the run before, which a bed may remember; nothing where it does
/// not vary.
std::optional<ConditionAxis> memory_axis(const TestBed& bed);

/// Whether the replicates of a condition had the same slip before them. Where they had not, their
/// mean is a slip that no run came after: it is no place to point at.
bool follows_one_slip(const Condition& condition);

}  // namespace regoplan
