#include "drive_diagnosis/recording/drive_recording.h"

#include <algorithm>
#include <iterator>

namespace regoplan {

const DriveChannel* DriveRecording::channel(std::string_view name) const {
  const auto found = std::ranges::find(channels, name, &DriveChannel::name);
  return found == channels.end() ? nullptr : &*found;
}

DriveChannel* DriveRecording::channel(std::string_view name) {
  const auto found = std::ranges::find(channels, name, &DriveChannel::name);
  return found == channels.end() ? nullptr : &*found;
}

void tell_torques(double motor_constant, DriveRecording& drive) {
  constexpr std::string_view kCurrent = "current_", kAmpere = "_a";
  const auto factor = static_cast<float>(motor_constant);
  const auto scale = [factor](DriveChannel& channel) {
    for (float& value : channel.values) value *= factor;
  };
  std::vector<DriveChannel> told;
  for (DriveChannel& channel : drive.channels) {
    const std::string_view name = channel.name;
    if (name.starts_with("torque_")) scale(channel);
    if (!name.starts_with(kCurrent) || !name.ends_with(kAmpere)) continue;
    const std::string_view of =
        name.substr(kCurrent.size(), name.size() - kCurrent.size() - kAmpere.size());
    if (of == "left" || of == "right") continue;  // of a side: no wheel's torque
    DriveChannel torque{.name = "torque_" + std::string(of) + "_nm", .values = channel.values};
    if (drive.channel(torque.name)) continue;
    scale(torque);
    told.push_back(std::move(torque));
  }
  std::ranges::move(told, std::back_inserter(drive.channels));
}

std::vector<const DriveChannel*> channels_of(const DriveRecording& drive, std::string_view prefix) {
  std::vector<const DriveChannel*> found;
  for (const DriveChannel& channel : drive.channels) {
    if (channel.name.starts_with(prefix)) found.push_back(&channel);
  }
  return found;
}

std::vector<std::string> channel_names(const std::vector<DriveRecording>& drives,
                                       std::string_view prefix) {
  std::vector<std::string> names;
  for (const DriveRecording& drive : drives) {
    for (const DriveChannel* channel : channels_of(drive, prefix)) {
      if (std::ranges::find(names, channel->name) == names.end()) names.push_back(channel->name);
    }
  }
  return names;
}

bool any_has(const std::vector<DriveRecording>& drives, std::string_view prefix) {
  return std::ranges::any_of(drives, [prefix](const DriveRecording& drive) {
    return !channels_of(drive, prefix).empty();
  });
}

}  // namespace regoplan
