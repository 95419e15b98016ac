// What samples of a channel tell of a window's mean, and what they leave unknown.
#include "drive_diagnosis/comparison/channel_samples.h"

#include <gtest/gtest.h>

#include <random>

namespace regoplan {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr std::size_t kSamples = 51;

/// A torque of 10 N m that falls by a step in the middle of five seconds.
DriveRecording fallen(double step_nm, double scatter_nm) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  DriveRecording drive;
  DriveChannel torque{.name = "torque_left_nm"};
  for (std::size_t i = 0; i < kSamples; ++i) {
    drive.time_s.push_back(kPeriod_s * static_cast<double>(i));
    const double value = 10 - (i > kSamples / 2 ? step_nm : 0) + scatter_nm * normal(random);
    torque.values.push_back(static_cast<float>(value));
  }
  drive.channels.push_back(torque);
  return drive;
}

double error_of(double step_nm, double scatter_nm) {
  const DriveRecording drive = fallen(step_nm, scatter_nm);
  const DriveWindow window{.start_s = 0, .end_s = kPeriod_s * (kSamples - 1)};
  return step_error(drive, window, "torque_left_nm", scatter_nm);
}

TEST(ChannelSamples, LeaveUnknownWhenWithinAStepTheChannelFell) {
  // At the step's first or at its last moment: half of it, for a fiftieth of the window.
  EXPECT_NEAR(error_of(4, 0), 4.0 / 2 / 50, 1e-6);
  EXPECT_DOUBLE_EQ(error_of(0, 0), 0);
}

TEST(ChannelSamples, ThatScatterAreNoSteps) {
  constexpr double kScatter_nm = 0.5;
  EXPECT_LT(error_of(0, kScatter_nm), 0.5 * kScatter_nm / std::sqrt(kSamples));
}

}  // namespace
}  // namespace regoplan
