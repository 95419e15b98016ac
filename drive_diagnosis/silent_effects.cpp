#include "drive_diagnosis/silent_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace regoplan {
namespace {

/// Counts windows that the vehicle's model says nothing of.
std::string why_nothing_is_compared(const DriveDiagnosis& result) {
  std::string text =
      "fewer than 12 windows drive with rim speeds, steering, heading and known ground";
  if (!result.windows_used) return text;
  for (std::size_t i = 0; i < kLeftOutReasons; ++i) {
    const int count = result.windows_used->left_out.at(i);
    if (count > 0) text += fmt::format(", {} {}", count, name(static_cast<LeftOut>(i)));
  }
  return text;
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

}  // namespace

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
    result.silent.push_back(
        {{"soil_zone", "zone_border", "map_offset", "wheel_radius", "steering_offset", "payload",
          "tow_drag"},
         why_nothing_is_compared(result),
         "a minute on the map with rim speed and steering of every wheel and the pose at 1 Hz"});
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
  if (!any_has(drives, "torque_")) {
    result.silent.push_back({{"wheel_drag", "cg_offset", "payload"},
                             "no wheel torques are recorded, or they are left out",
                             "torque or current of every wheel, 100 s on firm level ground"});
  }
  result.silent.push_back(
      {{"slip_sinkage", "grousers", "lateral_digging", "rear_contact", "max_stress_angle",
        "front_bulldozing", "side_pileup", "skid_branch", "sidewall_shear", "slip drift"},
       "at the slips driven these change what is measured by less than 4 standard deviations",
       "100 s with the wheels of one axle slowed to 0.9-0.35 of their speed, and a steeper climb "
       "(up to 23 deg), with sinkage recorded"});
}

}  // namespace regoplan
