#include "drive_diagnosis/instruments/rim_holes.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace regoplan {
namespace {

struct Hole {
  double from_s = 0, to_s = 0;
};

std::vector<Hole> holes_of(const DriveRecording& drive, const DriveChannel& rim) {
  std::vector<Hole> holes;
  std::optional<double> last_s;  // when it told a speed
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (std::isnan(rim.values[i])) continue;
    // Where the recording itself pauses, no wheel has a hole of its own.
    const bool goes_on = i > 0 && drive.time_s[i] - drive.time_s[i - 1] <= kRimHole_s;
    const double from_s = last_s.value_or(drive.time_s.front());
    if (goes_on && drive.time_s[i] - from_s > kRimHole_s)
      holes.push_back({from_s, drive.time_s[i]});
    last_s = drive.time_s[i];
  }
  if (last_s && drive.time_s.back() - *last_s > kRimHole_s) {
    holes.push_back({*last_s, drive.time_s.back()});
  }
  return holes;
}

}  // namespace

std::vector<DriveFinding> rim_holes(const std::vector<DriveRecording>& drives) {
  std::vector<DriveFinding> findings;
  for (const DriveRecording& drive : drives) {
    if (drive.size() == 0) continue;
    for (const DriveChannel* rim : channels_of(drive, "wheel_speed_")) {
      const std::vector<Hole> holes = holes_of(drive, *rim);
      if (holes.empty()) continue;
      const Hole& first = holes.front();
      findings.push_back(
          {.id = "hole",
           .drive = drive.drive_id,
           .text = fmt::format(
               "{} tells nothing from {:.1f} to {:.1f} s{}: nothing is compared there", rim->name,
               first.from_s, first.to_s,
               holes.size() == 1 ? "" : fmt::format(", and in {} more places", holes.size() - 1))});
    }
  }
  return findings;
}

}  // namespace regoplan
