#include "diagnosis/recording/condition_groups.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace regoplan {
namespace {

constexpr double kSameSlip = 0.01 + 1e-9;
constexpr double kSameAngle_rad = 0.5 * std::numbers::pi / 180 + 1e-9;
constexpr double kLoadGap = 0.08;

/// Whether a run may stand with one of the group.
bool agree(const WheelRun& a, const WheelRun& b, Places places) {
  return std::abs(a.slip_ratio - b.slip_ratio) <= kSameSlip &&
         std::abs(a.slip_angle_rad - b.slip_angle_rad) <= kSameAngle_rad &&
         a.conditions.pass == b.conditions.pass &&
         a.conditions.speed_mps == b.conditions.speed_mps &&
         (places == Places::kTogether || a.conditions.position_m == b.conditions.position_m) &&
         a.conditions.heading_rad == b.conditions.heading_rad && a.wheel == b.wheel;
}

/// Of each run the slip of the one before in the order of the runs, 0 where there is none. Samples
/// of one run follow the same.
std::vector<double> slips_before(const std::vector<WheelRun>& runs) {
  std::vector<double> before(runs.size(), 0.0);
  for (std::size_t i = 1; i < runs.size(); ++i) {
    before[i] = runs[i].run_id == runs[i - 1].run_id ? before[i - 1] : runs[i - 1].slip_ratio;
  }
  return before;
}

}  // namespace

std::vector<std::size_t> levels(const std::vector<double>& values, double gap) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<std::size_t> level(values.size(), 0);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const bool apart = values[order[i]] - values[order[i - 1]] > gap;
    level[order[i]] = level[order[i - 1]] + (apart ? 1 : 0);
  }
  return level;
}

std::vector<Condition> group_conditions(const Recording& recording,
                                        const std::vector<std::size_t>& used,
                                        const std::vector<int>& block, Places places) {
  std::vector<double> log_loads;
  for (const std::size_t run : used) log_loads.push_back(std::log(recording.runs[run].load_n));
  const std::vector<std::size_t> load_level = levels(log_loads, std::log1p(kLoadGap));
  std::vector<Condition> groups;
  std::vector<std::size_t> group_level;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const WheelRun& run = recording.runs[used[i]];
    std::size_t g = 0;
    const auto fits = [&](std::size_t k) {
      return group_level[k] == load_level[i] && std::ranges::all_of(groups[k].runs, [&](auto r) {
               return agree(recording.runs[r], run, places) &&
                      (block.empty() || block[r] == block[used[i]]);
             });
    };
    while (g < groups.size() && !fits(g)) ++g;
    if (g == groups.size()) {
      groups.emplace_back().wheel = run.wheel;
      groups.back().conditions = run.conditions;
      group_level.push_back(load_level[i]);
    }
    groups[g].runs.push_back(used[i]);
  }
  const std::vector<double> slip_before = slips_before(recording.runs);
  for (Condition& group : groups) {
    const double share = 1.0 / static_cast<double>(group.runs.size());
    // What is added to the first time, so that the mean of equal times is that time.
    const double first_s = recording.runs[group.runs.front()].conditions.time_s;
    group.conditions.time_s = first_s;
    group.day = recording.runs[group.runs.front()].day;
    const auto [least, most] = std::ranges::minmax(
        group.runs, {}, [&slip_before](std::size_t r) { return slip_before[r]; });
    group.after_slip_range = slip_before[most] - slip_before[least];
    for (const std::size_t r : group.runs) {
      const WheelRun& run = recording.runs[r];
      group.load_n += share * run.load_n;
      group.slip_ratio += share * run.slip_ratio;
      group.slip_angle_rad += share * run.slip_angle_rad;
      group.conditions.time_s += share * (run.conditions.time_s - first_s);
      group.after_slip_ratio += share * slip_before[r];
      group.one_day = group.one_day && run.day == recording.runs[group.runs.front()].day;
    }
  }
  return groups;
}

}  // namespace regoplan
