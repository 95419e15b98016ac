#include "diagnosis/recording/run_times.h"

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

constexpr double kDay_s = 86400;

}  // namespace

Recording with_times(Recording recording) {
  if (recording.runs.empty()) return recording;
  double first = INFINITY;
  for (const WheelRun& run : recording.runs) first = std::min(first, run.day);
  if (recording.columns.time) return recording;
  for (WheelRun& run : recording.runs) run.conditions.time_s = (run.day - first) * kDay_s;
  return recording;
}

Recording with_days(Recording recording) {
  constexpr double kNight_s = 6 * 3600;
  if (!recording.columns.time || recording.columns.day) return recording;
  std::vector<double> times_s;
  for (const WheelRun& run : recording.runs) times_s.push_back(run.conditions.time_s);
  std::ranges::sort(times_s);
  std::vector<double> mornings_s;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    if (times_s[i] - times_s[i - 1] > kNight_s) mornings_s.push_back(times_s[i]);
  }
  for (WheelRun& run : recording.runs) {
    const auto later = std::ranges::upper_bound(mornings_s, run.conditions.time_s);
    run.day = static_cast<double>(later - mornings_s.begin());
  }
  recording.columns.day = true;
  return recording;
}

bool tells_times(const Recording& recording) {
  return std::ranges::any_of(recording.runs, [&](const WheelRun& run) {
    return run.conditions.time_s != recording.runs.front().conditions.time_s;
  });
}

Recording with_even_times(Recording recording, const std::vector<Condition>& conditions) {
  std::size_t rounds = 1;
  for (const Condition& at : conditions) rounds = std::max(rounds, at.runs.size());
  const auto step_s =
      kDay_s * static_cast<double>(rounds) / static_cast<double>(recording.runs.size());
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    recording.runs[i].conditions.time_s = static_cast<double>(i) * step_s;
  }
  return recording;
}

}  // namespace regoplan
