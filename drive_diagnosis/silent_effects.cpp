#include "drive_diagnosis/silent_effects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "drive_diagnosis/comparison/window_input.h"
#include "drive_diagnosis/drive_claims.h"

namespace regoplan {
namespace {

/// The speed below which wheels were taken to stand, the largest of all drives.
double standing_mps(const std::vector<DriveWindow>& windows) {
  double pace = 0;
  for (const DriveWindow& window : windows) pace = std::max(pace, window.pace);
  return kStanding_mps * pace;
}

/// Which columns windows lack, those together that as many lack.
std::string missing_text(const std::map<std::string, int>& columns) {
  std::map<int, std::vector<std::string>, std::greater<>> by_count;
  for (const auto& [column, windows] : columns) by_count[windows].push_back(column);
  std::vector<std::string> parts;
  for (const auto& [windows, names] : by_count) {
    parts.push_back(fmt::format("{} in {}", fmt::join(names, ", "), windows));
  }
  return parts.empty() ? "" : fmt::format(" (no value of {})", fmt::join(parts, "; of "));
}

std::string reason_text(LeftOut reason, const DriveDiagnosis& result) {
  switch (reason) {
    case LeftOut::kNoInput:
      return "without a pose, rim speeds or steering" +
             missing_text(result.windows_used->columns_missing);
    case LeftOut::kStanding:
      return fmt::format("standing (rims slower than {:.2g} m/s, or turning round)",
                         standing_mps(result.windows));
    case LeftOut::kOffMap:
      return "off the map";
    case LeftOut::kNoBalance:
      return "in which the vehicle's model has no motion";
    case LeftOut::kNoChannel:
      return "in which not all that is compared was measured";
    case LeftOut::kTooMany:
      return "beyond the most that are compared";
  }
  return {};
}

/// The windows that the vehicle's model says nothing of, and why.
std::string why_nothing_is_compared(const DriveDiagnosis& result) {
  const int compared = result.windows_used ? result.windows_used->compared : 0;
  std::string text =
      fmt::format("{} windows can be compared, at least {} are needed", compared, kWindowsLeast);
  if (!result.windows_used) return text;
  for (std::size_t i = 0; i < kLeftOutReasons; ++i) {
    const int count = result.windows_used->left_out.at(i);
    if (count > 0) {
      text += fmt::format(", {} {}", count, reason_text(static_cast<LeftOut>(i), result));
    }
  }
  return text;
}

/// As long as the least number of windows takes.
std::string least_time_text(const std::vector<DriveWindow>& windows) {
  double window_s = 0;
  for (const DriveWindow& window : windows) window_s = std::max(window_s, window.duration_s());
  const double minutes = std::max(1.0, std::ceil(window_s * kWindowsLeast / 60 - 0.01));
  return minutes == 1 ? "a minute" : fmt::format("{:.0f} minutes", minutes);
}

/// What would make most of the windows that were left out comparable.
std::string drive_that_decides(const DriveDiagnosis& result) {
  const std::string time = least_time_text(result.windows);
  std::string usual =
      time + " on the map with rim speed and steering of every wheel and the pose at 1 Hz";
  if (!result.windows_used) return usual;
  const auto& left_out = result.windows_used->left_out;
  const auto most = std::ranges::max_element(left_out);
  if (*most == 0) return usual;
  switch (static_cast<LeftOut>(most - left_out.begin())) {
    case LeftOut::kNoInput:
    case LeftOut::kTooMany:
      return usual;
    case LeftOut::kStanding:
      return fmt::format(
          "{} on the map without a stop, all wheels turning one way and faster than "
          "{:.2g} m/s",
          time, standing_mps(result.windows));
    case LeftOut::kOffMap:
      return fmt::format("{} on the map, or a map that reaches around this drive", time);
    case LeftOut::kNoBalance:
      return "a look at the vehicle's numbers, the map's soils and the unit of the rim speeds: "
             "with "
             "these, forces balance nowhere";
    case LeftOut::kNoChannel:
      return fmt::format(
          "{} on the map, every recorded torque and attitude sampled in every window", time);
  }
  return usual;
}

/// How long zones must be for these drives to show them.
std::string zones_shown_text(const std::vector<ZoneShown>& zones,
                             const std::vector<MapSoil>& soils) {
  const auto name_of = [&soils](int soil) { return soils[static_cast<std::size_t>(soil)].name; };
  std::string text;
  for (const ZoneShown& zone : zones) {
    text += text.empty() ? "" : "; ";
    text += zone.there ? name_of(*zone.there) : "a soil three standard deviations weaker";
    if (zone.here) text += " in place of " + name_of(*zone.here);
    text +=
        zone.least_m ? fmt::format(": from {:.0f} m on", *zone.least_m) : ": none that is sought";
  }
  return text;
}

/// Sizes of the faults of an id from which on they are shown, the least and the greatest.
std::string sizes_text(const std::vector<FaultShown>& faults, const std::string& id) {
  const FaultShown* least = nullptr;
  const FaultShown* greatest = nullptr;
  for (const FaultShown& fault : faults) {
    if (fault.id != id) continue;
    if (least == nullptr || fault.least < least->least) least = &fault;
    if (greatest == nullptr || fault.least > greatest->least) greatest = &fault;
  }
  std::string text = fmt::format("{} ({:.2g} of {}", id, least->least, least->parameter);
  if (greatest != least) {
    text += fmt::format(" to {:.2g} of {}", greatest->least, greatest->parameter);
  }
  return text + ")";
}

/// The wheels that are not steered, of a vehicle that steers others: how they stand is not sought.
std::string fixed_beside_steered(const Vehicle& vehicle) {
  if (vehicle.steering == Steering::kSkid) return "";
  std::vector<std::string> names;
  for (const WheelMount& mount : vehicle.wheels) {
    if (!mount.steered) names.push_back(mount.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// How large the vehicle's faults must be for these drives to show them.
SilentEffect smaller_faults(const std::vector<FaultShown>& faults) {
  SilentEffect silent{
      .why = "four of five faults would stand out, if they are as large as this or larger",
      .drive =
          "a longer drive (four times as long shows half of each), with bends either way and "
          "slopes along and across"};
  for (const FaultShown& fault : faults) {
    if (std::ranges::find(silent.ids, fault.id) != silent.ids.end()) continue;
    silent.why += silent.ids.empty() ? ": " : ", ";
    silent.why += sizes_text(faults, fault.id);
    silent.ids.push_back(fault.id);
  }
  return silent;
}

/// What the currents of both sides do not show, where they are told.
std::optional<SilentEffect> silent_currents(const std::vector<DriveRecording>& drives,
                                            const DriveDiagnosis& result) {
  if (!any_has(drives, "current_")) return {};
  SilentEffect silent{.ids = {"side_drag"},
                      .drive =
                          "more or longer drives over the same kinds of ground: straight on, "
                          "turns either way, slopes up and down"};
  if (result.currents && !result.currents->held_out.beats_constant) {
    silent.why = no_better_text(result.currents->held_out);
    return silent;
  }
  if (result.currents) return {};
  silent.why = fmt::format(
      "{} windows in {} parts (days, drives, or minutes of a drive) drive steadily with currents "
      "of both sides and attitude, at least {} in {} are needed",
      result.currents_used.windows, result.currents_used.parts, kCurrentWindows, kCurrentParts);
  return silent;
}

/// What takes torques to be told, but for what is claimed of currents.
SilentEffect silent_without_torques(const DriveDiagnosis& result) {
  SilentEffect silent{.ids = {},
                      .why = "no wheel torques are recorded, or they are left out",
                      .drive = "torque or current of every wheel, 100 s on firm level ground"};
  for (const char* id : {"wheel_drag", "cg_offset", "payload"}) {
    const bool is_claimed = std::ranges::any_of(result.claims, [id](const DriveClaim& claim) {
      return std::ranges::find(claim.equivalent, id) != claim.equivalent.end();
    });
    if (!is_claimed) silent.ids.emplace_back(id);
  }
  return silent;
}

}  // namespace

std::optional<std::string> nearest_text(const DriveDiagnosis& result) {
  if (!result.effects || result.verdict == DriveVerdict::kUndecided) return {};
  if (result.effects->unnamed) return {};  // it stands out
  const VehicleFinding& nearest = result.effects->strongest_left;
  constexpr double kSeldom = 0.05;
  if (chance_of(nearest) > kSeldom) return {};
  const std::string size = nearest.id == "soil_zone" ? "" : ": " + fault_text(nearest);
  return fmt::format(
      "nearest to a claim, and not enough for one, is {}{}; by chance alone {} would show as much",
      fmt::join(nearest.equivalent, " or "), size, chance_text(nearest));
}

void say_what_is_silent(const DriveSetup& setup, const std::vector<DriveRecording>& drives,
                        DriveDiagnosis& result) {
  if (!setup.vehicle) {
    result.silent.push_back(
        {{"soil_zone", "zone_border", "map_offset", "wheel_radius", "steering_offset", "payload",
          "tow_drag"},
         "the scenario has no vehicle, so nothing predicts speeds and torques",
         "the same drives with a vehicle file: mass, wheels, centre of gravity"});
  }
  if (setup.vehicle && !result.effects) {
    result.silent.push_back({{"soil_zone", "zone_border", "map_offset", "wheel_radius",
                              "steering_offset", "payload", "tow_drag"},
                             why_nothing_is_compared(result),
                             drive_that_decides(result)});
    if (result.windows.empty()) {
      result.silent.back().why = "the unit of the time or of the positions is in doubt";
      result.silent.back().drive =
          "the same drives with time in s and positions in m (--columns multiplies a column by its "
          "scale)";
    }
  }
  if (auto currents = silent_currents(drives, result)) {
    // The first tells what would decide: without a vehicle that is currents, where there are any.
    const auto at = setup.vehicle ? result.silent.end() : result.silent.begin();
    result.silent.insert(at, *std::move(currents));
  }
  const bool has_zone =
      result.effects && std::ranges::any_of(result.effects->found, [](const VehicleFinding& found) {
        return found.zone.has_value();
      });
  if (result.effects && !has_zone && !result.effects->zones_shown.empty()) {
    result.silent.push_back(
        {{"soil_zone"},
         "four of five zones of another soil would stand out at nine of ten places, if they are as "
         "long as this or longer: " +
             zones_shown_text(result.effects->zones_shown, setup.map.soils()),
         "torque of every wheel, and attitude by which the map's slopes are told from soil (a "
         "window's mean to 0.1 deg)"});
  }
  if (result.effects && !result.effects->faults_shown.empty()) {
    result.silent.push_back(smaller_faults(result.effects->faults_shown));
  }
  if (result.effects && !result.effects->has_heights) {
    result.silent.push_back(
        {{"map_heights"},
         "pitch and roll are not told, or do not go with the map's ground: slopes that are off by "
         "a factor look like torques that are",
         "the same drives with pitch and roll, over ground that rises and falls"});
  }
  const std::string fixed = setup.vehicle ? fixed_beside_steered(*setup.vehicle) : "";
  if (result.effects && !fixed.empty()) {
    result.silent.push_back(
        {{"steering_offset"},
         "wheels that are not steered are taken to be mounted straight ahead: " + fixed,
         "none: a look at how these wheels are mounted"});
  }
  if (!any_has(drives, "torque_")) result.silent.push_back(silent_without_torques(result));
  const std::string slips =
      "100 s with the wheels of one axle slowed to 0.9-0.35 of their speed, and a steeper climb "
      "(up to 23 deg), with sinkage recorded";
  result.silent.push_back(
      {{"slip_sinkage", "grousers", "lateral_digging", "rear_contact", "max_stress_angle",
        "front_bulldozing", "side_pileup", "skid_branch", "sidewall_shear"},
       result.effects
           ? "at the slips driven these change what is measured by less than 4 standard deviations"
           : "no slip is known, as no vehicle's model was compared with these drives",
       result.effects ? slips : "with a vehicle file, rim speeds and steering: " + slips});
}

}  // namespace regoplan
