#pragma once

#include <optional>
#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// The way that fixes of a position tell, in legs of a metre at least and of ten times what a fix
/// scatters: a parked vehicle makes none.
struct DrivenWay {
  double way_m = 0;
  /// The median over the legs: half of the way was gone faster. Nothing where there is no leg.
  std::optional<double> usual_speed_mps;
};

DrivenWay driven_way(const DriveRecording& drive);

/// A share by which speeds and rates that tell driving from standing are smaller for this drive
/// than for one that usually goes at .4 m/s or faster, of which it is 1. Never less than a
/// fiftieth: below 1 mm/s wheels have no slip to speak of.
double pace_of(const DriveRecording& drive);

/// How long the windows of each drive are: `shortest_s`, in which a vehicle at .2 m/s goes a metre.
/// Slower, a pose tells a speed only over a longer time: windows go on for a metre of the drive's
/// usual speed, or longer, up to four metres, where those of all drives would else be more than are
/// compared.
std::vector<double> window_lengths_s(const std::vector<DriveRecording>& drives, double shortest_s);

/// The most windows that a vehicle's model is compared with: the contest stays within seconds.
inline constexpr std::size_t kComparedMost = 150;

}  // namespace regoplan
