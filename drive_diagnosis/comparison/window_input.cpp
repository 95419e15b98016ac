#include "drive_diagnosis/comparison/window_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "drive_diagnosis/instruments/rim_holes.h"

namespace regoplan {
namespace {

/// The mean over a time of the line through a channel's samples; before the first and after the
/// last of those within what the window is smoothed over, the channel keeps its value. NaN where it
/// has none there. The mean of the samples alone would be that of another time, by up to half the
/// time between two of them: where a vehicle brakes with .3 m/s2, of speeds .015 m/s off.
/// \param hole_s NaN too where a part lies in a hole between samples that is longer
double value_in(const DriveRecording& drive, const DriveWindow& window, const WindowPart& part,
                const std::string& name, double hole_s = std::numeric_limits<double>::infinity()) {
  const DriveChannel* channel = drive.channel(name);
  if (!channel) return kNotSampled;
  const auto begin =
      std::ranges::lower_bound(drive.time_s, window.smoothed_from_s) - drive.time_s.begin();
  double integral = 0, last_s = kNotSampled, last = kNotSampled;
  const auto add = [&](double to_s, double to) {
    const double from_s = std::max(part.start_s, last_s), until_s = std::min(part.end_s, to_s);
    if (!(until_s > from_s)) return;
    const auto at = [&](double time_s) {
      return last + (to - last) * (time_s - last_s) / (to_s - last_s);
    };
    integral += (until_s - from_s) * (at(from_s) + at(until_s)) / 2;
  };
  for (auto i = static_cast<std::size_t>(begin);
       i < drive.size() && drive.time_s[i] <= window.smoothed_to_s && !(last_s >= part.end_s);
       ++i) {
    const auto value = static_cast<double>(channel->values[i]);
    if (std::isnan(value)) continue;
    const double from_s = std::isnan(last_s) ? window.smoothed_from_s : last_s;
    if (drive.time_s[i] - from_s > hole_s && drive.time_s[i] > part.start_s) return kNotSampled;
    if (std::isnan(last_s)) {
      integral += value * std::max(0.0, std::min(part.end_s, drive.time_s[i]) - part.start_s);
    } else {
      add(drive.time_s[i], value);
    }
    last_s = drive.time_s[i];
    last = value;
  }
  if (std::isnan(last_s)) return kNotSampled;
  if (part.end_s > last_s && window.smoothed_to_s - last_s > hole_s) return kNotSampled;
  integral += last * std::max(0.0, part.end_s - std::max(part.start_s, last_s));
  return integral / (part.end_s - part.start_s);
}

/// The rim speed of a wheel, its own or its side's.
double rim_rad_s(const DriveRecording& drive, const DriveWindow& window, const WindowPart& part,
                 const WheelMount& mount) {
  const double own =
      value_in(drive, window, part, fmt::format("wheel_speed_{}_rad_s", mount.name), kRimHole_s);
  if (!std::isnan(own)) return own;
  return value_in(drive, window, part,
                  mount.y_m > 0 ? "wheel_speed_left_rad_s" : "wheel_speed_right_rad_s", kRimHole_s);
}

double steer_of(const DriveRecording& drive, const DriveWindow& window, const WindowPart& part,
                const Vehicle& vehicle, const WheelMount& mount) {
  if (!mount.steered) return 0;
  const double own = value_in(drive, window, part, fmt::format("steer_{}_rad", mount.name));
  if (!std::isnan(own)) return own;
  return steer_angle_rad(vehicle, mount, value_in(drive, window, part, "curvature_1pm"));
}

/// What the wheels are set to in a part of a window.
void set_wheels(const DriveRecording& drive, const DriveWindow& window, const Vehicle& vehicle,
                WindowInput::Place& place) {
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const WheelMount& mount = vehicle.wheels[i];
    place.rim_rad_s.at(i) = rim_rad_s(drive, window, place.part, mount);
    place.steer_rad.at(i) = steer_of(drive, window, place.part, vehicle, mount);
  }
  place.start.motion = rolling_motion(vehicle, place.rim_rad_s, place.steer_rad);
  place.near = place.start;
}

/// Accelerations of a place: how the motion of rolling wheels changes from its part's start to its
/// end. Wheels are sampled often, and without the scatter of fixes.
void accelerate(const DriveRecording& drive, const DriveWindow& window, const Vehicle& vehicle,
                WindowInput::Place& place) {
  const double length_s = place.part.end_s - place.part.start_s;
  const auto wheels_about = [&](double time_s) {
    WindowInput::Place there{
        .part = {.start_s = time_s - length_s / 2, .end_s = time_s + length_s / 2}};
    set_wheels(drive, window, vehicle, there);
    return there;
  };
  const WindowInput::Place from = wheels_about(place.part.start_s),
                           to = wheels_about(place.part.end_s);
  const BodyMotion &before = from.start.motion, &after = to.start.motion;
  place.acceleration_mps2 = (after.vx_mps - before.vx_mps) / length_s;
  place.yaw_acceleration_rps2 = (after.yaw_rate_rad_s - before.yaw_rate_rad_s) / length_s;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    place.rim_rad_s2.at(i) = (to.rim_rad_s.at(i) - from.rim_rad_s.at(i)) / length_s;
  }
}

/// What a window gives in so many parts; nothing where it lacks something.
std::optional<WindowInput> input_in(std::size_t parts, const DriveRecording& drive,
                                    const DriveWindow& window, const Vehicle& vehicle) {
  WindowInput input{
      .yaw_rad = window.yaw_rad, .forward_mps = window.forward_mps, .pace = window.pace};
  double all = window.yaw_rad;
  for (const WindowPart& part : window.divided(parts)) {
    WindowInput::Place& place = input.places.emplace_back();
    place.part = part;
    set_wheels(drive, window, vehicle, place);
    accelerate(drive, window, vehicle, place);
    all += place.part.x_m + place.part.y_m + place.part.yaw_rad;
    for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
      all += place.rim_rad_s.at(i) + place.steer_rad.at(i);
    }
  }
  if (!std::isfinite(all)) return {};
  return input;
}

/// Whether wheels begin or end to brake or to gain speed within a window.
bool jerks(const WindowInput& input, double gravity_mps2) {
  constexpr double kJerk = 0.06;  // of gravity: beyond the scatter of wheel speeds
  for (std::size_t j = 1; j < input.places.size(); ++j) {
    const double by_mps2 =
        input.places[j].acceleration_mps2 - input.places[j - 1].acceleration_mps2;
    if (std::abs(by_mps2) > kJerk * gravity_mps2) return true;
  }
  return false;
}

}  // namespace

bool stands(const WindowInput& input) {
  const double way = std::copysign(1.0, input.places.front().start.motion.vx_mps);
  const double least_mps = kStanding_mps * input.pace;
  return std::ranges::any_of(input.places, [&](const WindowInput::Place& place) {
    return way * place.start.motion.vx_mps < least_mps;
  });
}

std::vector<std::string> columns_missing(const DriveRecording& drive, const DriveWindow& window,
                                         const Vehicle& vehicle) {
  const WindowPart whole = window.divided(1).front();
  std::vector<std::string> columns;
  const auto miss = [&](double value, std::string column) {
    if (!std::isfinite(value)) columns.push_back(std::move(column));
  };
  miss(whole.x_m, "x_m");
  miss(whole.y_m, "y_m");
  miss(window.yaw_rad + whole.yaw_rad, "yaw_deg");
  for (const WheelMount& mount : vehicle.wheels) {
    miss(rim_rad_s(drive, window, whole, mount), fmt::format("wheel_speed_{}_rad_s", mount.name));
  }
  for (const WheelMount& mount : vehicle.wheels) {
    miss(steer_of(drive, window, whole, vehicle, mount), fmt::format("steer_{}_deg", mount.name));
  }
  return columns;
}

std::optional<WindowInput> input_of(const DriveRecording& drive, const DriveWindow& window,
                                    const Vehicle& vehicle, double gravity_mps2) {
  constexpr std::size_t kParts = 16, kFine = 48;
  auto input = input_in(kParts, drive, window, vehicle);
  if (!input || !jerks(*input, gravity_mps2)) return input;
  auto fine = input_in(kFine, drive, window, vehicle);
  return fine && !stands(*fine) ? fine : input;
}

}  // namespace regoplan
