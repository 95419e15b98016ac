#pragma once

#include <string>
#include <utility>
#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/recording/drive_windows.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Names of a wheel of the left side and of the one across from it.
using WheelPair = std::pair<std::string, std::string>;

/// All of a vehicle, whose wheels of the left have the nearest of the right across from them.
std::vector<WheelPair> wheels_across(const Vehicle& vehicle);

/// Two wheels whose columns of speed are exchanged.
struct ExchangedRims {
  WheelPair wheels;
  double correlation = 0;  ///< of the yaw rate with how much faster the right one is told
};

/// Pairs whose right wheel is told slower in left turns while some other pair's is told faster.
/// Where all are, sides are exchanged or the yaw's sign is wrong, which `check_sensors` judges.
std::vector<ExchangedRims> exchanged_rims(const std::vector<DriveRecording>& drives,
                                          const std::vector<DriveWindow>& windows,
                                          const Vehicle& vehicle);

/// What is to be told of them.
DriveFinding exchanged_finding(const ExchangedRims& exchanged);

}  // namespace regoplan
