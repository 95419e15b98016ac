#include "drive_diagnosis/torque_unit.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace regoplan {
namespace {

constexpr std::string_view kTorque = "torque_";

}  // namespace

std::optional<DriveFinding> doubtful_torque_unit(const std::vector<DriveRecording>& drives,
                                                 const std::vector<DriveWindow>& windows,
                                                 const Vehicle& vehicle, double gravity_mps2) {
  constexpr double kMoves_mps = 0.02, kLeast = 1e-3, kMost = 3;
  constexpr int kFewest = 12;  // windows of a wheel
  double squares = 0;
  int count = 0;
  for (const DriveWindow& window : windows) {
    if (!(std::abs(window.forward_mps) > kMoves_mps)) continue;
    for (const WheelMount& wheel : vehicle.wheels) {
      const double torque_nm =
          channel_mean(drives[window.drive], window, fmt::format("{}{}_nm", kTorque, wheel.name));
      if (std::isnan(torque_nm)) continue;
      squares += torque_nm * torque_nm;
      ++count;
    }
  }
  if (count < kFewest) return std::nullopt;
  const double slides_nm = vehicle.mass_kg * gravity_mps2 /
                           static_cast<double>(vehicle.wheels.size()) * vehicle.wheel.radius_m;
  const double rms_nm = std::sqrt(squares / count), share = rms_nm / slides_nm;
  if (share > kLeast && share < kMost) return std::nullopt;
  return DriveFinding{
      .id = "unit",
      .drive = "",
      .text = fmt::format(
          "torques of {:.3g} N m (root mean square), where {:.3g} N m would slide a wheel: {} in a "
          "column of N m? They are left out",
          rms_nm, slides_nm, share < 1 ? "kN m" : "N mm or currents"),
      .value = rms_nm,
      .unit = "N m",
      .mended = false};
}

void leave_torques_out(std::vector<DriveRecording>& drives) {
  for (DriveRecording& drive : drives) {
    std::erase_if(drive.channels,
                  [](const DriveChannel& channel) { return channel.name.starts_with(kTorque); });
  }
}

}  // namespace regoplan
