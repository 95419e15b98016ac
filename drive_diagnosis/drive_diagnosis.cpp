#include "drive_diagnosis/drive_diagnosis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "drive_diagnosis/comparison/swapped_sides.h"
#include "drive_diagnosis/comparison/torque_sign.h"
#include "drive_diagnosis/differing_drives.h"
#include "drive_diagnosis/drive_claims.h"
#include "drive_diagnosis/instruments/rim_holes.h"
#include "drive_diagnosis/instruments/rim_sign.h"
#include "drive_diagnosis/instruments/rim_unit.h"
#include "drive_diagnosis/instruments/steering_sign.h"
#include "drive_diagnosis/instruments/stuck_rims.h"
#include "drive_diagnosis/instruments/torque_unit.h"
#include "drive_diagnosis/instruments/track_unit.h"
#include "drive_diagnosis/instruments/yaw_unit.h"
#include "drive_diagnosis/recording/drive_pace.h"
#include "drive_diagnosis/recording/position_lag.h"
#include "drive_diagnosis/recording/time_checks.h"
#include "drive_diagnosis/silent_effects.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

SideGeometry sides_of(const std::optional<Vehicle>& vehicle) {
  SideGeometry sides;
  if (!vehicle) return sides;
  for (const WheelMount& mount : vehicle->wheels) {
    if (mount.y_m > 0) sides.left_wheels.push_back(mount.name);
    if (mount.y_m < 0) sides.right_wheels.push_back(mount.name);
  }
  return sides;
}

/// Whether a position looks like degrees of longitude and latitude on a map in metres.
bool looks_geographic(const DriveWindow& window, const GridFrame& frame) {
  const bool map_far = std::abs(frame.west_m) > 400 || std::abs(frame.north_m) > 400;
  return map_far && std::abs(window.x_m) <= 180 && std::abs(window.y_m) <= 90;
}

/// Of the windows of a drive that have a position, how many lie where.
struct WindowsPlaced {
  int all = 0, on_map = 0, geographic = 0;
  int on_map_exchanged = 0;  ///< if x were y and y were x

  double share_on_map() const { return all > 0 ? static_cast<double>(on_map) / all : 0; }
};

/// What is wrong with where a drive lies.
std::string place_words(const WindowsPlaced& placed) {
  if (placed.geographic > 0) {
    return "positions look like degrees of longitude and latitude, the map is in metres: bring "
           "them to the map's coordinates; off the map, the measured attitude counts";
  }
  std::string text = fmt::format(
      "{:.0f} % of the way lies off the map, or where it knows no height: there the measured "
      "attitude counts",
      100 * (1 - placed.share_on_map()));
  constexpr double kMuch = 0.8;
  if (placed.on_map < kMuch * placed.all && placed.on_map_exchanged == placed.all) {
    return text + "; with x and y exchanged all of it would lie on the map: are they?";
  }
  if (placed.on_map > 0) return text;
  return text + "; are the positions in the map's coordinates, metres and no degrees?";
}

void check_place(const DriveSetup& setup, const std::vector<DriveRecording>& drives,
                 DriveDiagnosis& result) {
  std::vector<WindowsPlaced> places(drives.size());
  for (const DriveWindow& window : result.windows) {
    if (std::isnan(window.x_m)) continue;
    WindowsPlaced& place = places[window.drive];
    ++place.all;
    place.on_map += !std::isnan(setup.map.height_m(window.x_m, window.y_m));
    place.on_map_exchanged += !std::isnan(setup.map.height_m(window.y_m, window.x_m));
    place.geographic += looks_geographic(window, setup.map.elevation().frame);
  }
  WindowsPlaced all;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const WindowsPlaced& place = places[i];
    all.all += place.all;
    all.on_map += place.on_map;
    if (place.on_map == place.all) continue;
    result.findings.push_back({.id = place.geographic > 0 ? "other_coordinates" : "off_the_map",
                               .drive = drives[i].drive_id,
                               .text = place_words(place),
                               .value = place.share_on_map()});
  }
  result.share_on_map = all.share_on_map();
}

/// How far the smoothing of poses reaches beyond a window, where a vehicle's model is compared.
constexpr double kBeyond = 0.3;

/// How long the windows of each drive are.
std::vector<double> lengths_s(const std::vector<DriveRecording>& drives, const DriveSetup& setup) {
  // Steering settles, and poses at 1 Hz give a speed.
  constexpr double kWithVehicle_s = 5, kWithout_s = 3;
  if (setup.window_s) return std::vector<double>(drives.size(), *setup.window_s);
  return window_lengths_s(drives, setup.vehicle ? kWithVehicle_s : kWithout_s);
}

/// Windows hold the means of the channels that a drive has when they are read.
std::vector<DriveWindow> windows_of(const std::vector<DriveRecording>& drives,
                                    const DriveSetup& setup) {
  const std::vector<double> windows_s = lengths_s(drives, setup);
  std::vector<DriveWindow> windows;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    std::ranges::move(drive_windows(drives[i], i, windows_s[i], setup.vehicle ? kBeyond : 0),
                      std::back_inserter(windows));
  }
  return windows;
}

/// Brings yaw to the map's sense and the vehicle's nose, where the drives show how.
void mend_yaw(const SensorChecks& checks, const DriveSetup& setup,
              std::vector<DriveRecording>& drives, std::vector<DriveWindow>& windows) {
  if (checks.yaw_sign == 1 && checks.yaw_offset_rad == 0) return;
  for (DriveRecording& drive : drives) {
    if (DriveChannel* yaw = drive.channel("yaw_rad")) {
      for (float& value : yaw->values) {
        value = static_cast<float>(checks.yaw_sign * static_cast<double>(value) +
                                   checks.yaw_offset_rad);
      }
    }
  }
  windows = windows_of(drives, setup);
}

/// Columns were turned round or converted: windows hold what they are by now.
void tell_mended(std::vector<DriveFinding> mended, const DriveSetup& setup,
                 const std::vector<DriveRecording>& drives, DriveDiagnosis& result) {
  if (mended.empty()) return;
  result.windows = windows_of(drives, setup);
  std::ranges::move(mended, std::back_inserter(result.findings));
}

/// Takes torques of wheels that are told with the other sign for what they are: of them a payload
/// would be made.
void mend_torque_signs(const DriveSetup& setup, const DriveDiagnosisOptions& options,
                       std::vector<DriveRecording>& drives, DriveDiagnosis& result) {
  if (!setup.vehicle || !any_has(drives, "torque_")) return;
  const std::vector<ReversedTorque> all =
      wheels_with_torque_reversed(drives, result.windows, setup.map, *setup.vehicle,
                                  setup.gravity_mps2, options.threads, options.stop);
  for (const ReversedTorque& reversed : all) {
    reverse_torque(reversed, drives, result.windows);
    const auto tell_of = [&](const std::string& drive) {
      result.findings.push_back(
          {.id = "sign",
           .drive = drive,
           .text = fmt::format("torque_{}_nm: the vehicle's model comes far nearer to it with the "
                               "other sign: taken so",
                               reversed.wheel),
           .mended = true});
    };
    if (reversed.drives.size() == drives.size()) {
      tell_of("");
    } else {
      for (const std::size_t drive : reversed.drives) tell_of(drives[drive].drive_id);
    }
  }
}

/// Torques that no soil takes say nothing: a payload would be made of them.
void leave_doubtful_torques_out(const DriveSetup& setup, std::vector<DriveRecording>& drives,
                                DriveDiagnosis& result) {
  if (!setup.vehicle) return;
  std::vector<DriveFinding> doubtful =
      doubtful_torque_units(drives, result.windows, *setup.vehicle, setup.gravity_mps2);
  if (doubtful.empty()) return;
  leave_torques_out(drives);
  result.windows = windows_of(drives, setup);
  std::ranges::move(doubtful, std::back_inserter(result.findings));
}

/// Where time or positions are told in another unit, speeds and the map say nothing: neither
/// claims nor a map are to be made of such a drive.
/// \returns whether each drive was left out
std::vector<bool> leave_doubtful_tracks_out(const DriveSetup& setup,
                                            std::vector<DriveRecording>& drives) {
  std::vector<bool> left_out;
  for (DriveRecording& drive : drives) {
    std::optional<DriveFinding> doubt =
        doubtful_track_unit(drive, setup.vehicle ? &*setup.vehicle : nullptr);
    left_out.push_back(doubt.has_value());
    if (!doubt) continue;
    drive.findings.push_back(*std::move(doubt));
    leave_samples_out(drive);
  }
  return left_out;
}

/// Columns of wheels that the vehicle does not have, as of names that are spelt otherwise, would be
/// left unused without a word.
void tell_unknown_wheels(const Vehicle& vehicle, DriveRecording& drive) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kOfWheels{
      {{"wheel_speed_", "_rad_s"}, {"steer_", "_rad"}, {"torque_", "_nm"}, {"sinkage_", "_m"}}};
  std::set<std::string> known, unknown;
  for (const WheelMount& wheel : vehicle.wheels) known.insert(wheel.name);
  for (const auto& [quantity, unit] : kOfWheels) {
    for (const DriveChannel* channel : channels_of(drive, quantity)) {
      const std::string wheel = channel->name.substr(
          quantity.size(), channel->name.size() - quantity.size() - unit.size());
      const bool is_side = quantity == "wheel_speed_" && (wheel == "left" || wheel == "right");
      if (!is_side && !known.contains(wheel)) unknown.insert(wheel);
    }
  }
  if (unknown.empty()) return;
  drive.findings.push_back(
      {.id = "unknown_wheel",
       .drive = drive.drive_id,
       .text = fmt::format("columns of {} are not used: the vehicle's wheels are {}",
                           fmt::join(unknown, ", "), fmt::join(known, ", "))});
}

void read_windows(std::vector<DriveRecording>& drives, const DriveSetup& setup,
                  const DriveDiagnosisOptions& options, DriveDiagnosis& result) {
  const double speed_max_mps = setup.vehicle ? setup.vehicle->speed_max_mps : 10;
  const std::vector<bool> left_out = leave_doubtful_tracks_out(setup, drives);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (options.progress) {
      options.progress("reading windows",
                       static_cast<double>(i) / static_cast<double>(drives.size()));
    }
    throw_if_stopped(options.stop);
    if (setup.vehicle) tell_unknown_wheels(*setup.vehicle, drives[i]);
    // Windows hold the means of the channels that a drive has when they are read.
    if (setup.uncertain.motor_constant) {
      tell_torques(setup.uncertain.motor_constant->value, drives[i]);
    }
    mend_positions(drives[i], speed_max_mps);
    mend_position_lag(drives[i]);
  }
  result.windows = windows_of(drives, setup);
  const std::vector<double> windows_s = lengths_s(drives, setup);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const bool has_window =
        std::ranges::find(result.windows, i, &DriveWindow::drive) != result.windows.end();
    if (!has_window && !left_out[i]) {
      drives[i].findings.push_back(
          {.id = "no_window",
           .drive = drives[i].drive_id,
           .text =
               fmt::format("{} samples, none of them {:.0f} s without a gap: nothing to compare",
                           drives[i].size(), windows_s[i])});
    }
    std::ranges::copy(drives[i].findings, std::back_inserter(result.findings));
  }
  const bool is_any_left = std::ranges::find(left_out, false) != left_out.end();
  if (result.windows.empty() && is_any_left) {
    throw InputError(fmt::format("{}: no {:.0f} s of driving without a gap in {} samples",
                                 drives.front().file, windows_s.front(), drives.front().size()));
  }
}

DriveVerdict verdict_of(const DriveDiagnosis& diagnosis) {
  if (diagnosis.claims.empty()) {
    const bool compared =
        diagnosis.effects || (diagnosis.currents && diagnosis.currents->held_out.beats_constant);
    for (const std::string_view id : {"drives_differ", "no_name", "map_slopes"}) {
      if (is_found(diagnosis, id)) return DriveVerdict::kUndecided;
    }
    return compared ? DriveVerdict::kConsistent : DriveVerdict::kUndecided;
  }
  const bool a_class = std::ranges::any_of(
      diagnosis.claims, [](const DriveClaim& claim) { return claim.equivalent.size() > 1; });
  return a_class ? DriveVerdict::kClass : DriveVerdict::kNamed;
}

/// Takes swapped columns of wheels for what they are; told of wheel speeds, found of torques.
void mend_sides(const std::vector<WheelPair>& pairs, const DriveSetup& setup,
                const DriveDiagnosisOptions& options, std::vector<DriveRecording>& drives,
                DriveDiagnosis& result) {
  exchange("wheel_speed", pairs, drives);
  if (!setup.vehicle || !any_has(drives, "torque_")) return;
  if (!torques_are_swapped(drives, result.windows, setup.map, *setup.vehicle, setup.gravity_mps2,
                           pairs, options.threads, options.stop)) {
    return;
  }
  exchange("torque", pairs, drives);
  result.findings.push_back(
      {.id = "swapped_sides",
       .drive = "",
       .text = "torques: with their sides exchanged as the wheel speeds' were the vehicle's model "
               "comes nearer to them: the columns left and right are taken the other way round",
       .mended = true});
}

/// The same of two wheels across from each other.
void mend_pairs(const DriveSetup& setup, const DriveDiagnosisOptions& options,
                std::vector<DriveRecording>& drives, DriveDiagnosis& result) {
  if (!setup.vehicle) return;
  std::vector<WheelPair> pairs;
  for (const ExchangedRims& exchanged : exchanged_rims(drives, result.windows, *setup.vehicle)) {
    result.findings.push_back(exchanged_finding(exchanged));
    pairs.push_back(exchanged.wheels);
  }
  if (!pairs.empty()) mend_sides(pairs, setup, options, drives, result);
}

/// Of several drives, those that the vehicle's model is not held against, and those that lack a
/// channel which others have: it is then compared of none.
void tell_what_drives_lack(const std::vector<DriveRecording>& drives, const Vehicle& vehicle,
                           DriveDiagnosis& result) {
  std::vector<bool> is_compared(drives.size(), false);
  for (const std::size_t window : result.effects->compared.front().windows) {
    is_compared[result.windows[window].drive] = true;
  }
  std::vector<std::string> channels{"pitch_rad", "roll_rad"};
  for (const WheelMount& wheel : vehicle.wheels) {
    channels.push_back(fmt::format("torque_{}_nm", wheel.name));
  }
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (!is_compared[i]) {
      result.findings.push_back(
          {.id = "not_compared",
           .drive = drives[i].drive_id,
           .text = "no window of it could be held against the vehicle's model, which takes rim "
                   "speeds and steering on the map's ground: what is said is of the other drives"});
      continue;
    }
    std::vector<std::string> lacks;
    for (const std::string& channel : channels) {
      bool others_have = false;
      for (std::size_t k = 0; k < drives.size(); ++k) {
        others_have = others_have || (is_compared[k] && drives[k].channel(channel));
      }
      if (others_have && !drives[i].channel(channel)) lacks.push_back(channel);
    }
    if (lacks.empty()) continue;
    result.findings.push_back(
        {.id = "channel_missing",
         .drive = drives[i].drive_id,
         .text = fmt::format("as this drive lacks {}, none is compared of any drive: the others "
                             "may show more without it",
                             fmt::join(lacks, ", "))});
  }
}

/// What the windows of all drives say together.
void compare(std::vector<DriveRecording>& drives, const DriveSetup& setup,
             const DriveDiagnosisOptions& options, DriveDiagnosis& result) {
  leave_doubtful_torques_out(setup, drives, result);
  const SideGeometry sides = sides_of(setup.vehicle);
  tell_mended(mend_yaw_in_radians(drives, result.windows), setup, drives, result);
  std::ranges::move(rim_holes(drives), std::back_inserter(result.findings));
  tell_mended(leave_stuck_rims_out(drives), setup, drives, result);
  tell_mended(mend_rim_signs(drives, result.windows, sides), setup, drives, result);
  if (setup.vehicle) {
    tell_mended(mend_rim_units(drives, result.windows, setup.vehicle->wheel.radius_m), setup,
                drives, result);
  }
  SensorChecks checks = check_sensors(drives, result.windows, sides);
  mend_yaw(checks, setup, drives, result.windows);
  std::ranges::move(checks.findings, std::back_inserter(result.findings));
  throw_if_stopped(options.stop);
  check_place(setup, drives, result);
  if (checks.wheel_sides_swapped) {
    const Vehicle* vehicle = setup.vehicle ? &*setup.vehicle : nullptr;
    mend_sides(sides_across(vehicle), setup, options, drives, result);
  }
  mend_pairs(setup, options, drives, result);
  if (setup.vehicle && !is_found(result, "yaw_unreliable")) {
    tell_mended(mend_steering(drives, result.windows, *setup.vehicle), setup, drives, result);
  }
  for (DriveWindow& window : result.windows) window.sensed_speed_mps /= checks.sensed_speed_per_mps;
  mend_torque_signs(setup, options, drives, result);
  result.mountings = find_mountings(drives, result.windows, setup.map);
  throw_if_stopped(options.stop);
  judge_mounting(setup, result);
  CurrentComparison currents = diagnose_currents(drives, result.windows, result.mountings,
                                                 checks.current_sides_swapped, options.stop);
  result.currents_used = currents.used;
  result.currents = std::move(currents.currents);
  if (result.currents) judge_currents(result);
  if (setup.vehicle && !is_found(result, "yaw_unreliable")) {
    VehicleComparison comparison =
        find_vehicle_effects(drives, result.windows, setup.map, *setup.vehicle, setup.gravity_mps2,
                             {.uncertain = setup.uncertain,
                              .seed = options.seed,
                              .threads = options.threads,
                              .stop = options.stop,
                              .progress = options.progress,
                              .news = options.news});
    result.windows_used = comparison.windows;
    result.effects = std::move(comparison.effects);
  }
  if (result.effects) {
    tell_what_drives_lack(drives, *setup.vehicle, result);
    std::vector<DriveFinding> differing = differing_drives(drives, result.windows, *result.effects);
    // A fault of some drives looks like a smaller one of all of them, or like a zone.
    if (differing.empty()) {
      claim_effects(setup, drives, result);
      claim_soils(setup, result);
      if (result.effects->unnamed) {
        result.findings.push_back(unnamed_finding(*result.effects->unnamed));
      }
      for (const VehicleFinding& zone : result.effects->zones_within_law) {
        result.findings.push_back(zone_within_law_finding(zone, drives));
      }
    }
    std::ranges::move(differing, std::back_inserter(result.findings));
    if (auto slopes = slopes_finding(*result.effects))
      result.findings.push_back(*std::move(slopes));
  }
  say_what_is_silent(setup, drives, result);
  result.verdict = verdict_of(result);
}

}  // namespace

bool is_found(const DriveDiagnosis& diagnosis, std::string_view finding) {
  return std::ranges::find(diagnosis.findings, finding, &DriveFinding::id) !=
         diagnosis.findings.end();
}

std::string_view name(DriveVerdict verdict) {
  constexpr std::array<std::string_view, 4> kNames{"undecided", "consistent", "named", "class"};
  return kNames.at(static_cast<std::size_t>(verdict));
}

DriveDiagnosis diagnose_drives(std::vector<DriveRecording> drives, const DriveSetup& setup,
                               const DriveDiagnosisOptions& options) {
  DriveDiagnosis result;
  try {
    read_windows(drives, setup, options, result);
    compare(drives, setup, options, result);
  } catch (const Interrupted&) {
    result.interrupted = true;
  }
  return result;
}

}  // namespace regoplan
