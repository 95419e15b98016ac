#include "drive_diagnosis/recording/time_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>

#include "drive_diagnosis/recording/fix_jumps.h"
#include "drive_diagnosis/recording/fix_scatter.h"
#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

template <class Number>
void keep(std::vector<Number>& values, const std::vector<bool>& kept) {
  std::size_t to = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) values[to++] = values[i];
  }
  values.resize(to);
}

void keep_rows(DriveRecording& drive, const std::vector<bool>& kept) {
  keep(drive.time_s, kept);
  keep(drive.x_m, kept);
  keep(drive.y_m, kept);
  for (DriveChannel& channel : drive.channels) keep(channel.values, kept);
}

/// From how many rows to the next time runs back.
std::size_t steps_back(const DriveRecording& drive) {
  std::size_t back = 0;
  for (std::size_t i = 1; i < drive.time_s.size(); ++i) {
    back += drive.time_s[i] < drive.time_s[i - 1] ? 1 : 0;
  }
  return back;
}

/// A log whose rows stand in reverse order is turned round; a clock that is set back stays.
bool turn_round(DriveRecording& drive) {
  const std::size_t back = steps_back(drive);
  constexpr double kMost = 0.9;
  const double steps = static_cast<double>(drive.time_s.size()) - 1;
  if (static_cast<double>(back) <= kMost * steps || back == 0) return false;
  std::ranges::reverse(drive.time_s);
  std::ranges::reverse(drive.x_m);
  std::ranges::reverse(drive.y_m);
  for (DriveChannel& channel : drive.channels) std::ranges::reverse(channel.values);
  return true;
}

template <class Number>
void put_in_order(std::vector<Number>& values, const std::vector<std::size_t>& order) {
  std::vector<Number> ordered;
  ordered.reserve(order.size());
  for (const std::size_t i : order) ordered.push_back(values[i]);
  values = std::move(ordered);
}

/// Puts rows in order of their time that are shuffled: more than one step in ten runs back, and
/// more than a few, though hardly two rows have the same time. The times of a clock that is set
/// back again and again are there twice. \returns how many steps ran back; 0 where the rows stay as
/// they are
std::size_t sort_shuffled(DriveRecording& drive) {
  constexpr std::size_t kStepsBackOneIn = 10, kStepsBackFew = 5, kSameTimesOneIn = 20;
  const std::size_t rows = drive.time_s.size(), back = steps_back(drive);
  if (kStepsBackOneIn * back <= rows || back <= kStepsBackFew) return 0;
  std::vector<std::size_t> order(rows);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return drive.time_s[i]; });
  std::size_t same = 0;
  for (std::size_t i = 1; i < rows; ++i) {
    same += drive.time_s[order[i]] == drive.time_s[order[i - 1]] ? 1 : 0;
  }
  if (kSameTimesOneIn * same > rows) return 0;
  put_in_order(drive.time_s, order);
  put_in_order(drive.x_m, order);
  put_in_order(drive.y_m, order);
  for (DriveChannel& channel : drive.channels) put_in_order(channel.values, order);
  return back;
}

void tell(DriveRecording& drive, std::string id, std::string text, double value,
          std::string unit = "") {
  drive.findings.push_back({.id = std::move(id),
                            .drive = drive.drive_id,
                            .text = std::move(text),
                            .value = value,
                            .unit = std::move(unit),
                            .mended = true});
}

/// From a fix to the next, what the drive moved beside what the steps before and after let expect.
struct FixStep {
  std::size_t to = 0;  ///< row of the later fix
  double dt_s = 0;
  double x_m = 0, y_m = 0;

  double size_m() const { return std::hypot(x_m, y_m); }
};

std::vector<FixStep> steps_of(const DriveRecording& drive) {
  constexpr std::size_t kAround = 3;
  std::vector<FixStep> moves;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (std::isnan(drive.x_m[i])) continue;
    if (last && drive.time_s[i] - drive.time_s[*last] <= kFixesApart_s) {
      moves.push_back({i, drive.time_s[i] - drive.time_s[*last], drive.x_m[i] - drive.x_m[*last],
                       drive.y_m[i] - drive.y_m[*last]});
    }
    last = i;
  }
  std::vector<FixStep> steps = moves;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    std::vector<double> east, north;
    for (std::size_t j = k >= kAround ? k - kAround : 0;
         j < std::min(k + kAround + 1, moves.size()); ++j) {
      if (j == k) continue;
      east.push_back(moves[j].x_m / moves[j].dt_s);
      north.push_back(moves[j].y_m / moves[j].dt_s);
    }
    if (east.empty()) continue;
    steps[k].x_m -= median_value(std::move(east)) * moves[k].dt_s;
    steps[k].y_m -= median_value(std::move(north)) * moves[k].dt_s;
  }
  return steps;
}

/// By how much positions may be off without being wrong: half a metre, and of a vehicle so slow
/// that this were much, what it goes in five seconds, as far as fixes do not scatter by more.
double slack_of_m(const DriveRecording& drive, double speed_max_mps) {
  constexpr double kMost_m = 0.5, kTime_s = 5, kScatters = 12;
  const double scatter_m = fix_scatter(drive).position_m;
  return std::min(kMost_m, std::max(kTime_s * speed_max_mps, kScatters * scatter_m));
}

/// Takes back steps that no vehicle of that speed can make and that fixes do not scatter by: from
/// there on the positions have another datum.
void take_steps_back(DriveRecording& drive, double speed_max_mps) {
  constexpr double kScatters = 12;
  const std::vector<FixStep> steps = steps_of(drive);
  if (steps.empty()) return;
  std::vector<double> sizes;
  for (const FixStep& step : steps) sizes.push_back(step.size_m());
  const double scatter_m = median_value(std::move(sizes));
  const double slack_m = slack_of_m(drive, speed_max_mps);
  std::size_t count = 0;
  double largest_m = 0, at_s = 0;
  for (const FixStep& step : steps) {
    const double size_m = step.size_m();
    if (size_m <= std::max(speed_max_mps * step.dt_s + slack_m, kScatters * scatter_m)) continue;
    for (std::size_t i = step.to; i < drive.size(); ++i) {
      drive.x_m[i] -= step.x_m;
      drive.y_m[i] -= step.y_m;
    }
    ++count;
    if (size_m <= largest_m) continue;
    largest_m = size_m;
    at_s = drive.time_s[step.to];
  }
  if (count == 0) return;
  tell(drive, "position_step",
       fmt::format("positions step {} (the largest by {:.3g} m at {:.2f} s) as if their datum "
                   "changed: taken back, so that the track goes on where it was",
                   count == 1 ? "once" : fmt::format("{} times", count), largest_m, at_s),
       largest_m, "m");
}

/// Fixes farther from the median of those around than the vehicle can be.
std::vector<FixJump> far_fixes(const DriveRecording& drive, const std::vector<std::size_t>& fresh,
                               double speed_max_mps) {
  constexpr std::size_t kAround = 3;
  const double slack_m = slack_of_m(drive, speed_max_mps);
  std::vector<FixJump> far;
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    std::vector<double> xs, ys;
    double reach_s = 0;
    for (std::size_t j = k >= kAround ? k - kAround : 0;
         j < std::min(k + kAround + 1, fresh.size()); ++j) {
      if (j == k) continue;
      xs.push_back(drive.x_m[fresh[j]]);
      ys.push_back(drive.y_m[fresh[j]]);
      reach_s = std::max(reach_s, std::abs(drive.time_s[fresh[j]] - drive.time_s[fresh[k]]));
    }
    if (xs.size() < 4) continue;
    const double off_m = std::hypot(drive.x_m[fresh[k]] - median_value(std::move(xs)),
                                    drive.y_m[fresh[k]] - median_value(std::move(ys)));
    if (off_m > 2 * speed_max_mps * reach_s + slack_m) {
      far.push_back({.row = fresh[k], .off_m = off_m});
    }
  }
  return far;
}

void leave_out(const std::vector<FixJump>& jumps, DriveRecording& drive,
               std::vector<std::size_t>& fresh) {
  for (const FixJump& jump : jumps) drive.x_m[jump.row] = drive.y_m[jump.row] = kNotSampled;
  std::erase_if(fresh, [&](std::size_t row) { return std::isnan(drive.x_m[row]); });
}

void tell_jumps(std::vector<FixJump> jumps, DriveRecording& drive) {
  constexpr std::size_t kTold = 5;
  std::ranges::sort(jumps, {}, &FixJump::row);
  std::vector<std::string> times_s;
  for (const FixJump& jump : jumps) {
    if (times_s.size() < kTold) times_s.push_back(fmt::format("{:.2f}", drive.time_s[jump.row]));
  }
  const FixJump& largest = *std::ranges::max_element(jumps, {}, &FixJump::off_m);
  std::string text =
      jumps.size() == 1
          ? fmt::format("1 position jumps (by {:.3g} m at {} s) and is left out", largest.off_m,
                        times_s.front())
          : fmt::format(
                "{} positions jump (at {}{} s; the largest by {:.3g} m at {:.2f} s) and are "
                "left out",
                jumps.size(), fmt::join(times_s, ", "), jumps.size() > kTold ? ", ..." : "",
                largest.off_m, drive.time_s[largest.row]);
  tell(drive, "position_jump", std::move(text), largest.off_m, "m");
}

}  // namespace

double median_step_s(const DriveRecording& drive) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < drive.size(); ++i) {
    const double step_s = drive.time_s[i] - drive.time_s[i - 1];
    if (step_s > 0) steps.push_back(step_s);
  }
  return steps.empty() ? 0.1 : median_value(std::move(steps));
}

double clock_slack_s(const DriveRecording& drive) {
  constexpr double kOfStep = 0.25;
  return kOfStep * median_step_s(drive);
}

double gap_max_s(const DriveRecording& drive) {
  return std::max(1.0, 10 * median_step_s(drive)) + clock_slack_s(drive);
}

void mend_time(DriveRecording& drive) {
  if (turn_round(drive)) {
    tell(drive, "time_reversed", "the rows stand in reverse order of time: turned round",
         static_cast<double>(drive.size()));
  } else if (const std::size_t back = sort_shuffled(drive); back > 0) {
    tell(drive, "time_out_of_order",
         fmt::format(
             "the rows do not stand in order of time, which runs back from {} of {} rows to the "
             "next: sorted by time",
             back, drive.size()),
         static_cast<double>(back));
  }
  std::vector<double>& time = drive.time_s;
  const double step_s = median_step_s(drive);
  std::vector<bool> kept(time.size(), true);
  double shift_s = 0, last_s = -std::numeric_limits<double>::infinity();
  std::size_t out_of_order = 0, repeated = 0, resets = 0;
  double back_s = 0, first_at_s = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double raw_s = time[i];
    double now_s = raw_s + shift_s;
    if (!(now_s > last_s)) {
      constexpr std::size_t kAhead = 3;
      bool returns = now_s == last_s;
      for (std::size_t j = i + 1; j < std::min(i + 1 + kAhead, time.size()); ++j) {
        returns = returns || time[j] + shift_s > last_s;
      }
      if (returns) {
        ++(now_s == last_s ? repeated : out_of_order);
        kept[i] = false;
        continue;
      }
      if (resets++ == 0) {
        first_at_s = last_s;
        back_s = last_s - now_s;
      }
      shift_s = last_s + step_s - raw_s;
      now_s = last_s + step_s;
    }
    time[i] = last_s = now_s;
  }
  keep_rows(drive, kept);
  if (out_of_order > 0) {
    tell(drive, "time_out_of_order",
         fmt::format("{} rows stand out of order in time and are left out", out_of_order),
         static_cast<double>(out_of_order));
  }
  if (repeated > 0) {
    tell(drive, "time_repeated",
         fmt::format("{} rows repeat the time of the row before and are left out", repeated),
         static_cast<double>(repeated));
  }
  if (resets > 0) {
    tell(drive, "time_runs_back",
         fmt::format("the clock runs back {} times (first by {:.3g} s at {:.3f} s); what follows "
                     "counts on from there",
                     resets, back_s, first_at_s),
         back_s, "s");
  }
}

void mend_positions(DriveRecording& drive, double speed_max_mps) {
  std::size_t stale = 0, sampled = 0;
  std::vector<std::size_t> fresh;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (std::isnan(drive.x_m[i]) || std::isnan(drive.y_m[i])) {
      drive.x_m[i] = drive.y_m[i] = kNotSampled;
      continue;
    }
    ++sampled;
    if (!fresh.empty() && drive.x_m[i] == drive.x_m[fresh.back()] &&
        drive.y_m[i] == drive.y_m[fresh.back()] && i - fresh.back() < 100) {
      ++stale;
      // The last of the repeats stays the anchor, so that a parked vehicle counts as repeating.
      drive.x_m[i] = drive.y_m[i] = kNotSampled;
      continue;
    }
    fresh.push_back(i);
  }
  if (2 * stale > sampled) {
    tell(drive, "stale_position",
         fmt::format("{} of {} positions repeat the one before and are not used", stale, sampled),
         static_cast<double>(stale) / static_cast<double>(sampled));
  }
  std::vector<FixJump> jumps = fix_jumps(drive, fresh, speed_max_mps);
  leave_out(jumps, drive, fresh);
  std::vector<FixJump> far = far_fixes(drive, fresh, speed_max_mps);
  leave_out(far, drive, fresh);
  std::ranges::move(far, std::back_inserter(jumps));
  if (!jumps.empty()) tell_jumps(std::move(jumps), drive);
  take_steps_back(drive, speed_max_mps);
}

}  // namespace regoplan
