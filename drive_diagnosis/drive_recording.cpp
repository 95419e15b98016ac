#include "drive_diagnosis/drive_recording.h"

#include <algorithm>

namespace regoplan {

const DriveChannel* DriveRecording::channel(std::string_view name) const {
  const auto found = std::ranges::find(channels, name, &DriveChannel::name);
  return found == channels.end() ? nullptr : &*found;
}

DriveChannel* DriveRecording::channel(std::string_view name) {
  const auto found = std::ranges::find(channels, name, &DriveChannel::name);
  return found == channels.end() ? nullptr : &*found;
}

std::vector<const DriveChannel*> channels_of(const DriveRecording& drive, std::string_view prefix) {
  std::vector<const DriveChannel*> found;
  for (const DriveChannel& channel : drive.channels) {
    if (channel.name.starts_with(prefix)) found.push_back(&channel);
  }
  return found;
}

}  // namespace regoplan
