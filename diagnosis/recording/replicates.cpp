#include "diagnosis/recording/replicates.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace regoplan {

Replicates replicates_of(const std::vector<Condition>& conditions,
                         const std::vector<double>& value) {
  Replicates all;
  for (const Condition& condition : conditions) {
    std::vector<std::size_t> measured;
    for (const std::size_t run : condition.runs) {
      if (std::isfinite(value[run])) measured.push_back(run);
    }
    if (measured.size() < 2) continue;
    all.contrasts += static_cast<int>(measured.size()) - 1;
    all.groups.push_back(std::move(measured));
  }
  return all;
}

bool tells_times_of_replicates(const Recording& recording,
                               const std::vector<Condition>& conditions) {
  if (!recording.columns.time) return false;
  return std::ranges::any_of(conditions, [&](const Condition& at) {
    return std::ranges::any_of(at.runs, [&](std::size_t run) {
      return recording.runs[run].conditions.time_s !=
             recording.runs[at.runs.front()].conditions.time_s;
    });
  });
}

std::optional<Rounds> rounds_as_days(const Recording& recording,
                                     const std::vector<Condition>& conditions) {
  const std::vector<WheelRun>& runs = recording.runs;
  const bool tells_days =
      std::ranges::any_of(runs, [&](const WheelRun& run) { return run.day != runs.front().day; });
  std::size_t most = 0;
  for (const Condition& at : conditions) most = std::max(most, at.runs.size());
  if (tells_days || most < 2) return std::nullopt;
  Rounds rounds{recording, most};
  rounds.recording.columns.day = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t round = i * most / runs.size();
    rounds.recording.runs[i].day = static_cast<double>(round);
  }
  const auto repeated = [](const Condition& at) { return at.runs.size() > 1; };
  rounds.share_repeated = static_cast<double>(std::ranges::count_if(conditions, repeated)) /
                          static_cast<double>(conditions.size());
  return rounds;
}

double centre(const std::vector<std::size_t>& group, const std::vector<double>& value) {
  std::vector<double> values;
  for (const std::size_t run : group) values.push_back(value[run]);
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

Eigen::VectorXd ReplicateRows::of(const std::vector<double>& per_run) const {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(runs.size()));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    rows[static_cast<Eigen::Index>(i)] = per_run[runs[i]];
  }
  return rows;
}

ReplicateRows rows_of(const Recording& recording, const Replicates& replicates,
                      const std::vector<double>& value) {
  ReplicateRows rows;
  std::vector<double> centres(value.size());
  for (const auto& group : replicates.groups) {
    rows.runs.insert(rows.runs.end(), group.begin(), group.end());
    rows.group.insert(rows.group.end(), group.size(), rows.groups++);
    for (const std::size_t run : group) centres[run] = centre(group, value);
  }
  rows.value = rows.of(value);
  rows.signal = rows.of(centres);
  std::map<double, Eigen::Index> days;
  for (const std::size_t run : rows.runs) {
    days.try_emplace(recording.runs[run].day, static_cast<Eigen::Index>(days.size()));
  }
  rows.of_day.setZero(rows.value.size(), static_cast<Eigen::Index>(days.size()));
  for (Eigen::Index i = 0; i < rows.value.size(); ++i) {
    rows.of_day(i, days.at(recording.runs[rows.runs[static_cast<std::size_t>(i)]].day)) = 1;
  }
  return rows;
}

}  // namespace regoplan
