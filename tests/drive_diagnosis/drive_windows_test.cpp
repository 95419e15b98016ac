#include "drive_diagnosis/recording/drive_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace regoplan {
namespace {

/// Goes straight on for some time, a row each step of a clock that ticks evenly but for some noise.
DriveRecording ticking(double first_s, double step_s, std::size_t rows, double off_s = 0) {
  DriveRecording drive{.drive_id = "d", .file = "d.csv"};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> off(-off_s, off_s);
  for (std::size_t i = 0; i < rows; ++i) {
    const double gone_s = static_cast<double>(i) * step_s;
    drive.time_s.push_back(first_s + gone_s + off(random));
    drive.x_m.push_back(gone_s);
    drive.y_m.push_back(0);
  }
  return drive;
}

/// How many rows there are in each window, and in what it is smoothed over.
std::vector<std::pair<long, long>> rows_of(const DriveRecording& drive) {
  const auto within = [&](double from_s, double to_s) {
    return std::ranges::count_if(drive.time_s,
                                 [&](double time_s) { return time_s >= from_s && time_s <= to_s; });
  };
  std::vector<std::pair<long, long>> rows;
  for (const DriveWindow& window : drive_windows(drive, 0, 5, 0.3)) {
    rows.emplace_back(within(window.start_s, window.end_s),
                      within(window.smoothed_from_s, window.smoothed_to_s));
  }
  return rows;
}

TEST(DriveWindows, HaveTheSameRowsWhereverTheClockBegins) {
  for (const double step_s : {0.05, 0.1, 0.2, 0.25, 0.5, 1.0}) {
    const auto rows = rows_of(ticking(0, step_s, 601));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(600 * step_s / 5));
    for (const double first_s : {0.1, 0.3, 0.9999999999999999, 1000.7, 1.79e9 + 0.1}) {
      EXPECT_EQ(rows_of(ticking(first_s, step_s, 601)), rows) << step_s << " " << first_s;
    }
  }
}

TEST(DriveWindows, HaveTheSameRowsWhereTheClockTicksUnevenly) {
  for (const double step_s : {0.1, 0.2, 1.0}) {
    EXPECT_EQ(rows_of(ticking(0, step_s, 601, 0.1 * step_s)), rows_of(ticking(0, step_s, 601)))
        << step_s;
  }
}

TEST(DriveWindows, AGapOfTenStepsEndsNoneWheneverTheClockBegins) {
  for (const double first_s : {0.0, 0.3, 0.9999999999999999, 1000.7, 1.79e9 + 0.1}) {
    DriveRecording drive = ticking(first_s, 0.1, 601);
    const auto taken_out = [](auto& values) {
      values.erase(values.begin() + 105, values.begin() + 114);
    };
    taken_out(drive.time_s);
    taken_out(drive.x_m);
    taken_out(drive.y_m);
    EXPECT_EQ(rows_of(drive).size(), 12u) << first_s;
  }
}

/// Straight on, then 2 rad round in a tight turn, then straight on.
TEST(DriveWindows, ATurnThatEndsWithinIsFollowed) {
  constexpr double kStep_s = 0.1, kFrom_s = 6, kTo_s = 11, kRate_rad_s = 0.4;
  DriveRecording drive{.drive_id = "d", .file = "d.csv"};
  DriveChannel yaw{.name = "yaw_rad", .values = {}};
  const auto yaw_at = [](double time_s) {
    return kRate_rad_s * std::clamp(time_s - kFrom_s, 0.0, kTo_s - kFrom_s);
  };
  double x_m = 0, y_m = 0;
  for (int i = 0; i <= 200; ++i) {
    const double time_s = i * kStep_s;
    drive.time_s.push_back(time_s);
    drive.x_m.push_back(x_m);
    drive.y_m.push_back(y_m);
    yaw.values.push_back(static_cast<float>(yaw_at(time_s)));
    x_m += kStep_s * std::cos(yaw_at(time_s + kStep_s / 2));
    y_m += kStep_s * std::sin(yaw_at(time_s + kStep_s / 2));
  }
  drive.channels.push_back(std::move(yaw));
  for (const DriveWindow& window : drive_windows(drive, 0, 5, 0.3)) {
    // What goes at 1 m/s along the yaw of each part is smoothed to the speed that is measured.
    double forward_mps = 0;
    for (const WindowPart& part : window.divided(48)) {
      EXPECT_NEAR(part.yaw_rad, yaw_at((part.start_s + part.end_s) / 2), 0.02) << part.start_s;
      forward_mps += part.track_share * std::cos(part.yaw_rad - window.yaw_rad);
    }
    EXPECT_NEAR(forward_mps, window.forward_mps, 0.005) << window.start_s;
  }
}

}  // namespace
}  // namespace regoplan
