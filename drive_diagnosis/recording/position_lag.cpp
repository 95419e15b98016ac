#include "drive_diagnosis/recording/position_lag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "drive_diagnosis/recording/time_checks.h"

namespace regoplan {
namespace {

constexpr double kStep_s = 0.1, kReach_s = 3;

/// Whether wheel speeds are sampled often enough to place a position in time: held values do not.
bool wheels_are_fresh(const DriveRecording& drive) {
  std::size_t changes = 0, steps = 0;
  for (const DriveChannel* wheel : channels_of(drive, "wheel_speed_")) {
    for (std::size_t i = 1; i < wheel->values.size(); ++i) {
      if (std::isnan(wheel->values[i]) || wheel->values[i] == 0) continue;
      ++steps;
      changes += wheel->values[i] != wheel->values[i - 1];
    }
  }
  return 2 * changes > steps;
}

/// How far the wheels have rolled in the mean, whatever their direction, over time.
class RolledWay {
 public:
  explicit RolledWay(const DriveRecording& drive) {
    const double longest_s = gap_max_s(drive);
    const auto wheels = channels_of(drive, "wheel_speed_");
    double speed_before = 0;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      double sum = 0;
      int count = 0;
      for (const DriveChannel* wheel : wheels) {
        if (std::isnan(wheel->values[i])) continue;
        sum += std::abs(static_cast<double>(wheel->values[i]));
        ++count;
      }
      if (count == 0) continue;
      const double speed = sum / count;
      const double way = time_s_.empty() ? 0
                                         : way_.back() + (drive.time_s[i] - time_s_.back()) *
                                                             (speed + speed_before) / 2;
      const bool gap = !time_s_.empty() && drive.time_s[i] - time_s_.back() > longest_s;
      gaps_.push_back((gaps_.empty() ? 0 : gaps_.back()) + (gap ? 1 : 0));
      time_s_.push_back(drive.time_s[i]);
      way_.push_back(way);
      speed_before = speed;
    }
  }

  /// NaN where a part of the time lies before, behind or in a gap of what the wheels tell.
  double between(double from_s, double to_s) const {
    const auto from = sample_behind(from_s), to = sample_behind(to_s);
    if (!from || !to || gaps_[*from - 1] != gaps_[*to]) return NAN;
    return until(to_s, *to) - until(from_s, *from);
  }

 private:
  /// The first sample at or behind a time that has one before it.
  std::optional<std::size_t> sample_behind(double time_s) const {
    const auto next = std::ranges::lower_bound(time_s_, time_s);
    if (next == time_s_.begin() || next == time_s_.end()) return {};
    return static_cast<std::size_t>(next - time_s_.begin());
  }

  double until(double time_s, std::size_t k) const {
    return std::lerp(way_[k - 1], way_[k],
                     (time_s - time_s_[k - 1]) / (time_s_[k] - time_s_[k - 1]));
  }

  std::vector<double> time_s_, way_;
  std::vector<int> gaps_;  // before each sample
};

/// From one sensed position to another.
struct Leg {
  double from_s, to_s, length_m;
};

/// Legs of a second and little more, one behind the other, as far as the wheels tell of all the
/// time around them.
std::vector<Leg> legs_of(const DriveRecording& drive, const RolledWay& rolled) {
  // Between the rates that logs have: which legs there are hangs on no scatter of a stamp.
  constexpr double kShortest_s = 0.95, kLongest_s = 2.75;
  std::vector<Leg> legs;
  std::optional<std::size_t> from;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (std::isnan(drive.x_m[i])) continue;
    if (from && drive.time_s[i] - drive.time_s[*from] < kShortest_s) continue;
    if (from) {
      const Leg leg{drive.time_s[*from], drive.time_s[i],
                    std::hypot(drive.x_m[i] - drive.x_m[*from], drive.y_m[i] - drive.y_m[*from])};
      const bool whole = std::isfinite(rolled.between(leg.from_s - kReach_s, leg.to_s + kReach_s));
      if (whole && leg.to_s - leg.from_s < kLongest_s) legs.push_back(leg);
    }
    from = i;
  }
  return legs;
}

/// What is left of the legs' lengths beside a factor on what the wheels rolled so much before: sum
/// of squares without the twentieth part that fits worst (jumps).
double misfit(const std::vector<Leg>& legs, const RolledWay& rolled, double lag_s) {
  std::vector<double> way(legs.size());
  double cross = 0, square = 0;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    way[i] = rolled.between(legs[i].from_s - lag_s, legs[i].to_s - lag_s);
    if (std::isnan(way[i])) return INFINITY;
    cross += way[i] * legs[i].length_m;
    square += way[i] * way[i];
  }
  const double factor = square > 0 ? cross / square : 0;
  std::vector<double> squares(legs.size());
  for (std::size_t i = 0; i < legs.size(); ++i) {
    squares[i] = std::pow(legs[i].length_m - factor * way[i], 2);
  }
  const auto kept = static_cast<std::ptrdiff_t>(squares.size() - squares.size() / 20);
  std::ranges::nth_element(squares, squares.begin() + kept - 1);
  double sum = 0;
  for (auto it = squares.begin(); it != squares.begin() + kept; ++it) sum += *it;
  return sum;
}

}  // namespace

std::optional<double> position_lag_s(const DriveRecording& drive) {
  constexpr std::size_t kFewest = 30;
  constexpr double kLongest_s = 1e5;
  if (!wheels_are_fresh(drive)) return {};
  if (drive.size() == 0 || drive.time_s.back() - drive.time_s.front() > kLongest_s) return {};
  const RolledWay rolled(drive);
  const std::vector<Leg> legs = legs_of(drive, rolled);
  if (legs.size() < kFewest) return {};
  const double at_zero = misfit(legs, rolled, 0);
  double least = at_zero, lag_s = 0;
  const int reach = static_cast<int>(std::lround(kReach_s / kStep_s)) - 1;
  for (int k = -reach; k <= reach; ++k) {
    const double left = misfit(legs, rolled, k * kStep_s);
    if (left >= least) continue;
    least = left;
    lag_s = k * kStep_s;
  }
  // The body follows its wheels by some tenths of a second. Chosen above what 60 drives without a
  // lag show: 31 nats and a factor of 1.4 at most.
  constexpr double kLeast_s = 0.5, kLeast_nats = 50, kLeastFactor = 2;
  const double gain_nats = static_cast<double>(legs.size()) / 2 * std::log(at_zero / least);
  const bool clear = gain_nats > kLeast_nats && at_zero > kLeastFactor * least;
  if (!clear || std::abs(lag_s) < kLeast_s) return {};
  return lag_s;
}

void mend_position_lag(DriveRecording& drive) {
  const auto lag_s = position_lag_s(drive);
  if (!lag_s) return;
  std::vector<double> x(drive.size(), NAN), y(drive.size(), NAN);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (std::isnan(drive.x_m[i])) continue;
    const double true_s = drive.time_s[i] - *lag_s;
    if (true_s < drive.time_s.front() || true_s > drive.time_s.back()) continue;
    auto row = static_cast<std::size_t>(std::ranges::lower_bound(drive.time_s, true_s) -
                                        drive.time_s.begin());
    if (row > 0 && true_s - drive.time_s[row - 1] < drive.time_s[row] - true_s) --row;
    constexpr double kNear_s = 0.5;  // farther only where rows are missing
    if (std::abs(drive.time_s[row] - true_s) > kNear_s) continue;
    x[row] = drive.x_m[i];
    y[row] = drive.y_m[i];
  }
  drive.x_m = std::move(x);
  drive.y_m = std::move(y);
  drive.findings.push_back(
      {.id = "lag",
       .drive = drive.drive_id,
       .text = fmt::format("positions come {:.1f} s {} the wheel speeds that made them; they are "
                           "taken back to their time",
                           std::abs(*lag_s), *lag_s > 0 ? "after" : "before"),
       .value = *lag_s,
       .unit = "s",
       .mended = true});
}

}  // namespace regoplan
