#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "drive_diagnosis/comparison/compared_channel.h"
#include "drive_diagnosis/comparison/vehicle_trials.h"
#include "drive_diagnosis/comparison/window_comparison.h"
#include "drive_diagnosis/comparison/window_prediction.h"
#include "drive_diagnosis/instruments/mounting.h"
#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {

/// A stretch of a drive whose soil is otherwise than the map says.
struct SoilZoneFound {
  std::size_t drive = 0;
  std::size_t first = 0, last = 0;           ///< windows
  double starts_s = 0, ends_s = 0;           ///< the most likely
  std::array<double, 2> start_s{}, end_s{};  ///< 95 % of where it starts and ends
  bool at_border = false;                    ///< it starts or ends where the map's soil changes
  int soil = 0;                              ///< of the map, that most of it is said to be
  std::optional<int> like;                   ///< the map's soil that is there, where it is one
  UncertainSoil estimate;                    ///< the soil that is there
  /// What a wheel that pulls nothing takes to roll there more than on the map's soil, as a share of
  /// its load: its torque over its radius.
  DriveEstimate resistance;
};

/// A fault by one number, fitted by itself.
struct FaultEstimate {
  std::string id, parameter;
  DriveEstimate size;
};

/// A fault of the vehicle, or a zone.
struct VehicleFinding {
  std::string id, parameter;
  double size = 0, std = 0;  ///< of the parameter
  double sigmas = 0;
  double gain = 0, chance = 0;          ///< twice nats of evidence; what chance gives in a thousand
  std::vector<std::string> equivalent;  ///< ids that explain as much, `id` first
  std::vector<FaultEstimate> instead;   ///< hardly told from it, each fitted in its place
  std::optional<SoilZoneFound> zone;
};

/// How large a fault must be for these drives to show four of five.
struct FaultShown {
  std::string id, parameter;
  double least = 0;  ///< of the parameter, of either sign
};

/// How long a zone of another soil must be for these drives to show four of five at nine of ten
/// places.
struct ZoneShown {
  std::optional<int> here;        ///< the map's soil that is said to lie there; nothing: any
  std::optional<int> there;       ///< that lies there instead; nothing: one far weaker
  std::optional<double> least_m;  ///< nothing: none of those that are sought
};

/// A soil of the map that was driven on, as the drives tell it.
struct SoilFitted {
  std::size_t soil = 0;    ///< of the map
  UncertainSoil estimate;  ///< with what is left of its spread
  /// By how many nats numbers fitted to the other stretches of the drives make held-out stretches
  /// likelier than the map's own make them.
  double held_out_nats = 0;

  /// What predicts the drives no better than the map does is nothing to plan with.
  bool is_handed_back() const { return held_out_nats > 0; }
};

/// What the vehicle's windows say.
struct VehicleEffects {
  std::vector<VehicleFinding> found;
  VehicleFinding strongest_left;  ///< what did not stand out
  /// What did, and is of a size that cannot be, as a drag of less than nothing: no name explains
  /// it.
  std::optional<VehicleFinding> unnamed;
  /// Zones in which a wheel takes no more otherwise than a claimed wheel law does by itself on a
  /// wheel that bears a quarter more or less than the others: none is claimed.
  std::vector<VehicleFinding> zones_within_law;
  /// Beside what was found; without those that are shown at no usual size.
  std::vector<FaultShown> faults_shown;
  std::vector<ZoneShown> zones_shown;  ///< beside what was found
  UncertainVehicle vehicle;  ///< of the numbers that nobody knew well, what the drives say
  std::vector<SoilFitted> soils_fitted;  ///< none where too few windows lie outside zones
  std::vector<MapSoil> soils;  ///< of the map, those that are handed back as they are fitted
  int windows = 0;             ///< that were compared
  std::vector<std::string> channels;
  std::vector<double> noise;      ///< of each channel
  std::vector<double> rms;        ///< of the residuals, of what is said to be
  std::vector<double> rms_after;  ///< with what was found and estimated
  bool has_torque = false;
  bool has_heights = false;  ///< those of the map were among what may be otherwise
  /// How far the map's slopes are off the ground's, along and across, root mean square.
  std::array<double, 2> slope_errors{};
  std::vector<ComparedChannel> compared;  ///< window by window, in the order of `channels`
};

/// As many windows must be compared at least.
inline constexpr std::size_t kWindowsLeast = 12;

/// What became of the windows, and what they say where there are enough to be compared.
struct VehicleComparison {
  WindowsUsed windows;
  std::optional<VehicleEffects> effects;
};

struct EffectSearchSettings {
  UncertainVehicle uncertain = {};
  std::uint64_t seed = 1;
  int threads = 2;  ///< changes no result
  std::stop_token stop = {};
  std::function<void(std::string_view stage, double share)> progress = {};
  /// What is known already, in a sentence, while the rest is sought.
  std::function<void(const std::string& text)> news = {};
};

/// Compares windows with the vehicle's model on the map: speed along and across, yaw rate,
/// attitude, torque of each wheel. What a sound vehicle, its sensors and the map's soils may be off
/// is estimated along. \throws Interrupted
VehicleComparison find_vehicle_effects(const std::vector<DriveRecording>& drives,
                                       const std::vector<DriveWindow>& windows,
                                       const TerrainMap& map, const Vehicle& vehicle,
                                       double gravity_mps2, const EffectSearchSettings& settings);

}  // namespace regoplan
