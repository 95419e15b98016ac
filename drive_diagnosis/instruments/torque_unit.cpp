#include "drive_diagnosis/instruments/torque_unit.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

namespace regoplan {
namespace {

constexpr std::string_view kTorque = "torque_";

/// Root mean square over the windows of one drive that move; nothing where those are too few, or
/// where all stand at 0: a dead sensor has no unit.
std::optional<double> torque_rms_nm(const DriveRecording& drive, std::size_t index,
                                    const std::vector<DriveWindow>& windows,
                                    const Vehicle& vehicle) {
  constexpr double kMoves_mps = 0.02;
  constexpr int kFewest = 12;
  double squares = 0;
  int count = 0;
  for (const DriveWindow& window : windows) {
    if (window.drive != index || !(std::abs(window.forward_mps) > kMoves_mps * window.pace)) {
      continue;
    }
    for (const WheelMount& wheel : vehicle.wheels) {
      const double torque_nm =
          channel_mean(drive, window, fmt::format("{}{}_nm", kTorque, wheel.name));
      if (std::isnan(torque_nm)) continue;
      squares += torque_nm * torque_nm;
      ++count;
    }
  }
  if (count < kFewest || squares == 0) return std::nullopt;
  return std::sqrt(squares / count);
}

}  // namespace

std::vector<DriveFinding> doubtful_torque_units(const std::vector<DriveRecording>& drives,
                                                const std::vector<DriveWindow>& windows,
                                                const Vehicle& vehicle, double gravity_mps2) {
  constexpr double kLeast = 1e-3, kMost = 3;
  const double slides_nm = vehicle.mass_kg * gravity_mps2 /
                           static_cast<double>(vehicle.wheels.size()) * vehicle.wheel.radius_m;
  std::vector<DriveFinding> findings;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const auto rms_nm = torque_rms_nm(drives[i], i, windows, vehicle);
    if (!rms_nm || (*rms_nm > kLeast * slides_nm && *rms_nm < kMost * slides_nm)) continue;
    findings.push_back(
        {.id = "unit",
         .drive = drives[i].drive_id,
         .text = fmt::format("torques of {:.3g} N m (root mean square), where {:.3g} N m would "
                             "slide a wheel: {} in a column of N m? Torques are left out",
                             *rms_nm, slides_nm, *rms_nm < slides_nm ? "kN m" : "N mm or currents"),
         .value = *rms_nm,
         .unit = "N m"});
  }
  return findings;
}

void leave_torques_out(std::vector<DriveRecording>& drives) {
  for (DriveRecording& drive : drives) {
    std::erase_if(drive.channels,
                  [](const DriveChannel& channel) { return channel.name.starts_with(kTorque); });
  }
}

}  // namespace regoplan
