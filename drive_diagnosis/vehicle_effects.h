#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "drive_diagnosis/drive_windows.h"
#include "drive_diagnosis/effect_contest.h"
#include "drive_diagnosis/window_prediction.h"

namespace regoplan {

/// A stretch of a drive whose soil is otherwise than the map says.
struct SoilZoneFound {
  std::size_t drive = 0;
  std::size_t first = 0, last = 0;           ///< windows
  std::array<double, 2> start_s{}, end_s{};  ///< 95 % of where it starts and ends
  bool at_border = false;                    ///< it starts or ends where the map's soil changes
};

/// What the vehicle's windows say.
struct VehicleEffects {
  std::vector<EffectColumn> columns;  ///< without their numbers
  std::vector<EffectFound> found;
  std::vector<std::optional<SoilZoneFound>> zones;  ///< of each found
  int windows = 0;                                  ///< that could be predicted
  std::vector<std::string> channels;
  std::vector<double> noise, rms;  ///< of each channel: from neighbours, and of the residuals
  bool has_torque = false;
};

/// Compares windows with the vehicle's model on the map: speed along, yaw rate, torque of each
/// wheel. Noise comes from differences of neighbouring windows, correlated along the way. Nothing
/// where fewer than 12 windows can be predicted: no rim speeds, no steering, off the map.
std::optional<VehicleEffects> find_vehicle_effects(const std::vector<DriveRecording>& drives,
                                                   const std::vector<DriveWindow>& windows,
                                                   const TerrainMap& map, const Vehicle& vehicle,
                                                   double gravity_mps2, std::uint64_t seed,
                                                   std::stop_token stop);

}  // namespace regoplan
