#include "drive_diagnosis/drive_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drive_diagnosis/position_lag.h"
#include "drive_diagnosis/swapped_sides.h"
#include "drive_diagnosis/time_checks.h"
#include "drive_diagnosis/torque_unit.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

constexpr double kTwoSided95 = 1.96;  ///< standard deviations of a normal number

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

void check_place(const DriveSetup& setup, const std::vector<DriveRecording>& drives,
                 DriveDiagnosis& result) {
  std::vector<int> inside(drives.size()), placed(drives.size()), geographic(drives.size());
  int all_inside = 0, all_placed = 0;
  for (const DriveWindow& window : result.windows) {
    if (std::isnan(window.x_m)) continue;
    ++placed[window.drive];
    ++all_placed;
    if (!std::isnan(setup.map.height_m(window.x_m, window.y_m))) {
      ++inside[window.drive];
      ++all_inside;
    }
    geographic[window.drive] += looks_geographic(window, setup.map.elevation().frame);
  }
  result.share_on_map = all_placed > 0 ? static_cast<double>(all_inside) / all_placed : 0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (placed[i] == 0 || inside[i] == placed[i]) continue;
    const double share = static_cast<double>(inside[i]) / placed[i];
    const std::string text =
        geographic[i] > 0
            ? "positions look like degrees of longitude and latitude, the map is in metres: bring "
              "them to the map's coordinates; off the map, the measured attitude counts"
            : fmt::format(
                  "{:.0f} % of the way lies off the map, or where it knows no height: there "
                  "the measured attitude counts{}",
                  100 * (1 - share),
                  inside[i] > 0 ? ""
                                : "; are the positions in the map's coordinates, metres "
                                  "and no degrees?");
    result.findings.push_back({.id = geographic[i] > 0 ? "other_coordinates" : "off_the_map",
                               .drive = drives[i].drive_id,
                               .text = text,
                               .value = share});
  }
}

/// Mountings that wander by day, or are not where the setup says.
void judge_mounting(const DriveSetup& setup, DriveDiagnosis& result) {
  struct Axis {
    const char* name;
    const std::optional<DriveEstimate> Mounting::*of;
    const double Mounting::*slope;
    const DriveEstimate& prior;
  };
  const std::array<Axis, 2> axes{
      {{"pitch", &Mounting::pitch_rad, &Mounting::pitch_slope, setup.mounting_pitch_rad},
       {"roll", &Mounting::roll_rad, &Mounting::roll_slope, setup.mounting_roll_rad}}};
  // Radians in a column of degrees rise by .017 of what the ground does.
  constexpr double kHardlyFollows = 0.1;
  DriveClaim claim{.id = "attitude_mounting", .equivalent = {"attitude_mounting"}};
  for (const Axis& axis : axes) {
    double sum = 0, weights = 0;
    for (const Mounting& day : result.mountings) {
      if (day.*axis.slope < -0.5) {
        result.findings.push_back(
            {.id = "sign",
             .drive = "",
             .text = fmt::format("{} falls where the ground rises (day {}): its sign is wrong, or "
                                 "the sensor looks backward",
                                 axis.name, day.day.empty() ? "not said" : day.day),
             .value = day.*axis.slope});
      } else if (std::abs(day.*axis.slope) < kHardlyFollows) {
        result.findings.push_back(
            {.id = "unit",
             .drive = "",
             .text =
                 fmt::format("{} rises {:.0f} times less than the ground (day {}): radians in a "
                             "column of degrees, or a sensor that stands still?",
                             axis.name, 1 / std::max(std::abs(day.*axis.slope), 1e-3),
                             day.day.empty() ? "not said" : day.day),
             .value = day.*axis.slope});
        continue;  // says nothing of how the sensor sits
      }
      const std::optional<DriveEstimate>& estimate = day.*axis.of;
      if (!estimate) continue;
      const double weight = 1 / std::max(estimate->std * estimate->std, 1e-8);
      sum += weight * estimate->value;
      weights += weight;
    }
    if (weights == 0) continue;
    const DriveEstimate mean{sum / weights, 1 / std::sqrt(weights)};
    constexpr double kSigmas = 4.5, kMapErr_rad = 0.5 * kDegree;
    const double sigmas = std::abs(mean.value - axis.prior.value) /
                          std::hypot(mean.std, std::hypot(axis.prior.std, kMapErr_rad));
    if (sigmas < kSigmas) continue;
    claim.sigmas = std::max(claim.sigmas, sigmas);
    claim.parameters[fmt::format("{}_deg", axis.name)] = {mean.value / kDegree, mean.std / kDegree};
    claim.channels.push_back(fmt::format("{}_deg", axis.name));
  }
  if (claim.parameters.empty()) return;
  claim.text = "the attitude sensor does not sit as it is said to: its readings less the ground's";
  for (const auto& [name, angle] : claim.parameters) {
    claim.text +=
        fmt::format("{} {} {:.2f} deg", name == claim.parameters.begin()->first ? "," : " and",
                    name.substr(0, name.size() - std::string_view("_deg").size()), angle.value);
  }
  result.claims.push_back(std::move(claim));
}

void claim_side_drag(DriveDiagnosis& result) {
  const CurrentDiagnosis& currents = *result.currents;
  if (!currents.side_drag) return;
  const bool left = currents.left_excess_a.value > 0;
  const double sign = left ? 1 : -1;
  std::array<double, 2> interval{sign * currents.left_excess_ci95_a[0],
                                 sign * currents.left_excess_ci95_a[1]};
  std::ranges::sort(interval);
  result.claims.push_back(
      {.id = "side_drag",
       .parameters = {{"excess_a",
                       {sign * currents.left_excess_a.value, currents.left_excess_a.std}}},
       .equivalent = currents.equivalent,
       .channels = {"current_left_a", "current_right_a"},
       .sigmas = std::abs(currents.left_excess_a.value) / currents.left_excess_a.std,
       .text = fmt::format("the {} side takes {:.1f} A ({:.1f} to {:.1f}) more than the other "
                           "straight ahead on the level",
                           left ? "left" : "right", sign * currents.left_excess_a.value,
                           interval[0], interval[1])});
  result.where.push_back({.channel = left ? "current_left_a" : "current_right_a",
                          .where = "straight ahead on the level, all days",
                          .effect = sign * currents.left_excess_a.value,
                          .ci95 = interval,
                          .p_value = std::erfc(result.claims.back().sigmas / std::sqrt(2.0))});
}

bool any_has(const std::vector<DriveRecording>& drives, std::string_view prefix) {
  return std::ranges::any_of(drives, [prefix](const DriveRecording& drive) {
    return !channels_of(drive, prefix).empty();
  });
}

/// Where on the map a zone lies that a drive went through.
DriveMismatch mismatch_of(const DriveDiagnosis& result, const std::vector<DriveRecording>& drives,
                          const VehicleFinding& finding) {
  const SoilZoneFound& zone = *finding.zone;
  std::array<double, 2> x_m{1e18, -1e18}, y_m{1e18, -1e18};
  for (std::size_t i = zone.first; i <= zone.last; ++i) {
    const DriveWindow& window = result.windows[i];
    x_m = {std::min(x_m[0], window.x_m), std::max(x_m[1], window.x_m)};
    y_m = {std::min(y_m[0], window.y_m), std::max(y_m[1], window.y_m)};
  }
  return {
      .channel = "soil",
      .where = fmt::format("drive {}, {:.1f} s ({:.1f} to {:.1f}) to {:.1f} s ({:.1f} to {:.1f})",
                           drives[zone.drive].drive_id, zone.starts_s, zone.start_s[0],
                           zone.start_s[1], zone.ends_s, zone.end_s[0], zone.end_s[1]),
      .region = {{"x_m", x_m},
                 {"y_m", y_m},
                 {"time_s", {zone.starts_s, zone.ends_s}},
                 {"start_s", zone.start_s},
                 {"end_s", zone.end_s}},
      .effect = finding.size,
      .ci95 = {finding.size - kTwoSided95 * finding.std, finding.size + kTwoSided95 * finding.std},
      // Beyond what one contest in a thousand gains, gains fall off as exp(-gain / 2).
      .p_value = 1e-3 * std::exp((finding.chance - finding.gain) / 2)};
}

std::string resistance_text(const VehicleFinding& finding) {
  const DriveEstimate& resistance = finding.zone->resistance;
  const double low = 100 * (resistance.value - kTwoSided95 * resistance.std);
  const double high = 100 * (resistance.value + kTwoSided95 * resistance.std);
  const bool open = low < 0 && high > 0;
  return fmt::format("{} {:.1f} % of its load {} to roll there (95 %: {:.1f} to {:.1f}{})",
                     open ? "a wheel may take" : "a wheel takes", 100 * std::abs(resistance.value),
                     resistance.value < 0 ? "less" : "more", low, high,
                     open ? ", so that by this number alone it may be none" : "");
}

std::string zone_text(const VehicleFinding& finding, const TerrainMap& map,
                      const std::string& where) {
  const SoilZoneFound& zone = *finding.zone;
  const std::vector<MapSoil>& soils = map.soils();
  const std::string& said = soils[static_cast<std::size_t>(zone.soil)].name;
  const std::string what =
      zone.like ? fmt::format("{} in place of", soils[static_cast<std::size_t>(*zone.like)].name)
                : "other soil than";
  return fmt::format("{} {} in {}, {:.1f} standard deviations from nothing; {}", what, said, where,
                     finding.sigmas, resistance_text(finding));
}

void claim_effects(const DriveSetup& setup, const std::vector<DriveRecording>& drives,
                   DriveDiagnosis& result) {
  const VehicleEffects& effects = *result.effects;
  for (const VehicleFinding& finding : effects.found) {
    DriveClaim claim{.id = finding.id,
                     .parameters = {{finding.parameter, {finding.size, finding.std}}},
                     .equivalent = finding.equivalent,
                     .channels = effects.channels,
                     .sigmas = finding.sigmas};
    claim.text =
        fmt::format("{} = {:.3g} (95 %: {:.3g} to {:.3g}), {:.1f} standard deviations from nothing",
                    finding.parameter, finding.size, finding.size - kTwoSided95 * finding.std,
                    finding.size + kTwoSided95 * finding.std, finding.sigmas);
    if (finding.zone) {
      if (finding.zone->at_border &&
          std::ranges::find(claim.equivalent, "zone_border") == claim.equivalent.end()) {
        claim.equivalent.emplace_back("zone_border");
      }
      DriveMismatch where = mismatch_of(result, drives, finding);
      claim.text = zone_text(finding, setup.map, where.where);
      result.where.push_back(std::move(where));
    }
    result.claims.push_back(std::move(claim));
  }
}

/// How far the smoothing of poses reaches beyond a window, where a vehicle's model is compared.
constexpr double kBeyond = 0.3;

/// Windows hold the means of the channels that a drive has when they are read.
std::vector<DriveWindow> windows_of(const std::vector<DriveRecording>& drives,
                                    const DriveSetup& setup) {
  std::vector<DriveWindow> windows;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    std::ranges::move(drive_windows(drives[i], i, setup.window_s, setup.vehicle ? kBeyond : 0),
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

bool is_found(const DriveDiagnosis& result, std::string_view id) {
  return std::ranges::any_of(result.findings,
                             [id](const DriveFinding& finding) { return finding.id == id; });
}

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

/// What nobody should expect these drives to show.
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

void read_windows(std::vector<DriveRecording>& drives, const DriveSetup& setup,
                  const DriveDiagnosisOptions& options, DriveDiagnosis& result) {
  const double speed_max_mps = setup.vehicle ? setup.vehicle->speed_max_mps : 10;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (options.progress) {
      options.progress("reading windows",
                       static_cast<double>(i) / static_cast<double>(drives.size()));
    }
    throw_if_stopped(options.stop);
    // Windows hold the means of the channels that a drive has when they are read.
    if (setup.uncertain.motor_constant) {
      tell_torques(setup.uncertain.motor_constant->value, drives[i]);
    }
    mend_positions(drives[i], speed_max_mps);
    mend_position_lag(drives[i]);
    std::vector<DriveWindow> windows =
        drive_windows(drives[i], i, setup.window_s, setup.vehicle ? kBeyond : 0);
    if (windows.empty()) {
      drives[i].findings.push_back(
          {.id = "no_window",
           .drive = drives[i].drive_id,
           .text =
               fmt::format("{} samples, none of them {:.0f} s without a gap: nothing to compare",
                           drives[i].size(), setup.window_s)});
    }
    std::ranges::move(windows, std::back_inserter(result.windows));
    std::ranges::copy(drives[i].findings, std::back_inserter(result.findings));
  }
  if (result.windows.empty()) {
    throw InputError(fmt::format("{}: no {:.0f} s of driving without a gap in {} samples",
                                 drives.front().file, setup.window_s, drives.front().size()));
  }
}

DriveVerdict verdict_of(const DriveDiagnosis& diagnosis) {
  if (diagnosis.claims.empty()) {
    const bool compared = diagnosis.effects || diagnosis.currents;
    return compared ? DriveVerdict::kConsistent : DriveVerdict::kUndecided;
  }
  const bool a_class = std::ranges::any_of(
      diagnosis.claims, [](const DriveClaim& claim) { return claim.equivalent.size() > 1; });
  return a_class ? DriveVerdict::kClass : DriveVerdict::kNamed;
}

/// Takes swapped columns of wheels for what they are; told of wheel speeds, found of torques.
void mend_sides(const DriveSetup& setup, const DriveDiagnosisOptions& options,
                std::vector<DriveRecording>& drives, DriveDiagnosis& result) {
  const Vehicle* vehicle = setup.vehicle ? &*setup.vehicle : nullptr;
  exchange_sides("wheel_speed", vehicle, drives);
  if (vehicle == nullptr || !any_has(drives, "torque_")) return;
  if (!torques_are_swapped(drives, result.windows, setup.map, *vehicle, setup.gravity_mps2,
                           options.threads, options.stop)) {
    return;
  }
  exchange_sides("torque", vehicle, drives);
  result.findings.push_back(
      {.id = "swapped_sides",
       .drive = "",
       .text = "torques: with their sides exchanged as the wheel speeds' were the vehicle's model "
               "comes nearer to them: the columns left and right are taken the other way round",
       .mended = true});
}

/// What the windows of all drives say together.
void compare(std::vector<DriveRecording>& drives, const DriveSetup& setup,
             const DriveDiagnosisOptions& options, DriveDiagnosis& result) {
  leave_doubtful_torques_out(setup, drives, result);
  SensorChecks checks = check_sensors(drives, result.windows, sides_of(setup.vehicle));
  mend_yaw(checks, setup, drives, result.windows);
  for (DriveWindow& window : result.windows) window.sensed_speed_mps /= checks.sensed_speed_per_mps;
  std::ranges::move(checks.findings, std::back_inserter(result.findings));
  throw_if_stopped(options.stop);
  check_place(setup, drives, result);
  if (checks.wheel_sides_swapped) mend_sides(setup, options, drives, result);
  result.mountings = find_mountings(drives, result.windows, setup.map);
  throw_if_stopped(options.stop);
  judge_mounting(setup, result);
  result.currents = diagnose_currents(drives, result.windows, result.mountings,
                                      checks.current_sides_swapped, options.seed, options.stop);
  if (result.currents) claim_side_drag(result);
  if (setup.vehicle && !is_found(result, "yaw_unreliable")) {
    VehicleComparison comparison =
        find_vehicle_effects(drives, result.windows, setup.map, *setup.vehicle, setup.gravity_mps2,
                             {.uncertain = setup.uncertain,
                              .seed = options.seed,
                              .threads = options.threads,
                              .stop = options.stop});
    result.windows_used = comparison.windows;
    result.effects = std::move(comparison.effects);
  }
  if (result.effects) claim_effects(setup, drives, result);
  say_what_is_silent(setup, drives, result);
  result.verdict = verdict_of(result);
}

}  // namespace

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
