#include "drive_diagnosis/instruments/yaw_unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// So many seconds at 1 m/s on a curve that begins along a heading, yaw within a degree. \param
/// told what the column of degrees has, by the yaw in radians
DriveRecording on_a_curve(double heading_rad, double curvature_1pm, double duration_s,
                          double (*told)(double yaw_rad)) {
  DriveRecording drive{.drive_id = "d"};
  DriveChannel yaw{.name = "yaw_rad", .values = {}};
  double x_m = 0, y_m = 0;
  for (double t = 0; t < duration_s; t += 0.5) {
    const double now_rad = std::remainder(heading_rad + curvature_1pm * t, 2 * std::numbers::pi);
    drive.time_s.push_back(t);
    drive.x_m.push_back(x_m);
    drive.y_m.push_back(y_m);
    yaw.values.push_back(static_cast<float>(told(now_rad + kDegree * std::sin(7 * t))));
    x_m += 0.5 * std::cos(now_rad);
    y_m += 0.5 * std::sin(now_rad);
  }
  drive.channels = {std::move(yaw)};
  return drive;
}

double in_degrees(double yaw_rad) {
  return yaw_rad;  // the reader has made radians of them
}
double in_radians(double yaw_rad) {
  return yaw_rad * kDegree;  // the reader has taken them for degrees
}

constexpr double kWindow_s = 5;

TEST(YawUnit, RadiansInAColumnOfDegreesAreTakenForWhatTheyAre) {
  for (const double heading_rad : {0.8, 3.0, -2.2}) {
    for (const double curvature_1pm : {0.0, 0.02, -0.05}) {
      // A quarter of what correlations of the turns from window to window need.
      constexpr double kShort_s = 60;
      std::vector<DriveRecording> drives{
          on_a_curve(heading_rad, curvature_1pm, kShort_s, in_radians)};
      const DriveRecording sound = on_a_curve(heading_rad, curvature_1pm, kShort_s, in_degrees);
      const std::vector<DriveFinding> found =
          mend_yaw_in_radians(drives, drive_windows(drives[0], 0, kWindow_s));
      ASSERT_EQ(found.size(), 1u) << heading_rad << " " << curvature_1pm;
      EXPECT_EQ(found[0].id, "unit");
      EXPECT_TRUE(found[0].mended);
      for (std::size_t i = 0; i < sound.size(); ++i) {
        EXPECT_NEAR(drives[0].channel("yaw_rad")->values[i], sound.channels[0].values[i], 1e-5);
      }
    }
  }
}

TEST(YawUnit, IsNotDoubtedOfYawsInDegreesNorOfSensorsThatLookAside) {
  for (const double heading_rad : {0.02, 0.8, 3.0}) {
    for (const double curvature_1pm : {0.0, 0.02}) {
      for (const double off_rad : {0.0, 0.4, std::numbers::pi / 2}) {
        DriveRecording drive = on_a_curve(heading_rad, curvature_1pm, 60, in_degrees);
        for (float& value : drive.channels[0].values) value += static_cast<float>(off_rad);
        EXPECT_FALSE(yaw_is_in_radians(drive, 0, drive_windows(drive, 0, kWindow_s)))
            << heading_rad << " " << curvature_1pm << " " << off_rad;
      }
    }
  }
}

}  // namespace
}  // namespace regoplan
