#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnosis/recording/condition_groups.h"

namespace regoplan {

/// Measured runs of the conditions that have two and more.
struct Replicates {
  std::vector<std::vector<std::size_t>> groups;
  int contrasts = 0;
};

/// \param value of one channel per run, NaN where it was not measured
Replicates replicates_of(const std::vector<Condition>& conditions,
                         const std::vector<double>& value);

/// Whether the recording tells when each replicate was run: a time that all replicates of a
/// condition share belongs to the condition.
bool tells_times_of_replicates(const Recording& recording,
                               const std::vector<Condition>& conditions);

/// A recording with a day for each round of its replicates.
struct Rounds {
  Recording recording;  ///< its days are no column of it
  std::size_t count = 0;
  double share_repeated = 0;  ///< of the conditions: run more than once
};

/// Equal parts of the order of the runs, as many as any condition has replicates, taken for days;
/// nothing where the recording tells days itself or no condition was run twice.
std::optional<Rounds> rounds_as_days(const Recording& recording,
                                     const std::vector<Condition>& conditions);

/// Where the signal of a group lies, robustly.
double centre(const std::vector<std::size_t>& group, const std::vector<double>& value);

/// Replicates of one channel in rows, a run each.
struct ReplicateRows {
  std::vector<std::size_t> runs;
  std::vector<Eigen::Index> group;  ///< of each row, as they come
  Eigen::Index groups = 0;
  Eigen::VectorXd value;
  Eigen::VectorXd signal;  ///< where the run's group lies
  Eigen::MatrixXd of_day;  ///< rows x days, 1 where the run is of that day, or 0

  Eigen::Index contrasts() const { return value.size() - groups; }
  /// What is known per run of the recording, in rows.
  Eigen::VectorXd of(const std::vector<double>& per_run) const;
};

ReplicateRows rows_of(const Recording& recording, const Replicates& replicates,
                      const std::vector<double>& value);

}  // namespace regoplan
