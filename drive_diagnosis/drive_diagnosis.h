#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "drive_diagnosis/current_model.h"
#include "drive_diagnosis/instruments/mounting.h"
#include "drive_diagnosis/instruments/sensor_checks.h"
#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/vehicle_effects.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// What is known before the drives are looked at.
struct DriveSetup {
  TerrainMap map;
  std::optional<Vehicle> vehicle;  ///< without one, only what needs none is looked at
  UncertainVehicle uncertain;      ///< of its numbers, those that nobody knows well
  double gravity_mps2 = 0;
  DriveEstimate mounting_pitch_rad{0, 0.035};  ///< how the attitude sensor is said to sit
  DriveEstimate mounting_roll_rad{0, 0.035};
  /// How long all windows are; nothing: as long as the drives' speeds take (`window_lengths_s`).
  std::optional<double> window_s = {};
};

/// A name for what is otherwise than the model has it.
struct DriveClaim {
  std::string id;
  std::map<std::string, DriveEstimate> parameters;
  std::vector<std::string>
      equivalent;                      ///< ids that these drives cannot tell apart, `id` among them
  std::vector<FaultEstimate> instead;  ///< hardly told from it, each fitted in its place
  std::vector<std::string> channels;
  double sigmas = 0;  ///< how far it is from nothing
  std::string text;
};

/// Where measurement and model differ.
struct DriveMismatch {
  std::string channel;
  std::string where;  ///< in words
  std::map<std::string, std::array<double, 2>> region;
  double effect = 0;  ///< measured - model, in the channel's unit
  std::array<double, 2> ci95{};
  double p_value = 1;
};

/// What these drives cannot show, and the drive that would.
struct SilentEffect {
  std::vector<std::string> ids;
  std::string why;
  std::string drive;
};

/// Of drives: undecided where nothing is claimed and neither vehicle nor currents could be
/// compared, or the model of currents does no better than a constant; a class where their claims
/// cannot tell names apart.
enum class DriveVerdict { kUndecided, kConsistent, kNamed, kClass };

/// `undecided`, `consistent`, `named`, `class`.
std::string_view name(DriveVerdict verdict);

struct DriveDiagnosis {
  DriveVerdict verdict = DriveVerdict::kUndecided;
  std::vector<DriveClaim> claims;
  std::vector<DriveMismatch> where;
  std::vector<DriveFinding> findings;
  std::vector<Mounting> mountings;
  CurrentsUsed currents_used;
  std::optional<CurrentDiagnosis> currents;
  std::optional<WindowsUsed>
      windows_used;  ///< by the vehicle's model; nothing where it was not asked
  std::optional<VehicleEffects> effects;
  std::vector<SilentEffect> silent;
  std::vector<DriveWindow> windows;
  double share_on_map = 0;  ///< of the windows with a position: where the map knows the height
  bool interrupted = false;
};

struct DriveDiagnosisOptions {
  std::uint64_t seed = 1;
  int threads = 2;  ///< changes no result
  /// A request ends the diagnosis within a second with what was found by then, marked interrupted.
  std::stop_token stop = {};
  std::function<void(std::string_view stage, double share)> progress = {};
  /// What is known already, in a sentence, while the rest is sought.
  std::function<void(const std::string& text)> news = {};
};

/// Whether a finding of that id is told.
bool is_found(const DriveDiagnosis& diagnosis, std::string_view finding);

/// Compares drives with what model and map say of them, window by window. Deterministic for a seed.
/// \param drives with clocks that rise (`mend_time`); positions are mended here
/// \throws InputError where no drive has a window
DriveDiagnosis diagnose_drives(std::vector<DriveRecording> drives, const DriveSetup& setup,
                               const DriveDiagnosisOptions& options);

}  // namespace regoplan
