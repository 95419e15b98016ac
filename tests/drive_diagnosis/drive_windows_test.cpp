#include "drive_diagnosis/recording/drive_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace regoplan
