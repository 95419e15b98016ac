#include "drive_diagnosis/instruments/stuck_rims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace regoplan {
namespace {

constexpr std::string_view kRimSpeeds = "wheel_speed_";

/// Rows from `first` up to `next`.
struct Rows {
  std::size_t first = 0, next = 0;
};

/// Whether any other wheel's speed takes many values there.
bool others_change(const DriveRecording& drive, const DriveChannel& stuck, const Rows& rows) {
  constexpr double kChanges = 0.5;  // share of the rows
  return std::ranges::any_of(channels_of(drive, kRimSpeeds), [&](const DriveChannel* other) {
    if (other->name == stuck.name) return false;
    std::size_t changes = 0;
    for (std::size_t i = rows.first + 1; i < rows.next; ++i) {
      changes += other->values[i] != other->values[i - 1];
    }
    return static_cast<double>(changes) > kChanges * static_cast<double>(rows.next - rows.first);
  });
}

std::vector<Rows> stuck_rows(const DriveRecording& drive, const DriveChannel& channel) {
  constexpr std::size_t kRows = 20;
  constexpr double kLeast_s = 5;
  std::vector<Rows> found;
  const std::size_t n = channel.values.size();
  for (std::size_t first = 0, next = 0; first < n; first = next) {
    for (next = first + 1; next < n && channel.values[next] == channel.values[first];) ++next;
    const Rows rows{.first = first, .next = next};
    // A wheel that stands tells 0, as it should.
    if (next - first < kRows || channel.values[first] == 0) continue;
    if (drive.time_s[next - 1] - drive.time_s[first] < kLeast_s) continue;
    if (others_change(drive, channel, rows)) found.push_back(rows);
  }
  return found;
}

}  // namespace

std::vector<DriveFinding> leave_stuck_rims_out(std::vector<DriveRecording>& drives) {
  std::vector<DriveFinding> findings;
  for (DriveRecording& drive : drives) {
    // All are judged before any is left out: those left out change no more.
    std::vector<std::pair<std::string, std::vector<Rows>>> stuck;
    for (const DriveChannel* channel : channels_of(drive, kRimSpeeds)) {
      stuck.emplace_back(channel->name, stuck_rows(drive, *channel));
    }
    for (const auto& [name, stretches] : stuck) {
      for (const Rows& rows : stretches) {
        std::vector<float>& values = drive.channel(name)->values;
        const auto begin = values.begin();
        findings.push_back(
            {.id = "stuck",
             .drive = drive.drive_id,
             .text = fmt::format("{} repeats {:.4g} from {:.1f} to {:.1f} s while other wheels "
                                 "change: left out, nothing is compared there",
                                 name, values[rows.first], drive.time_s[rows.first],
                                 drive.time_s[rows.next - 1]),
             .mended = true});
        std::fill(begin + static_cast<std::ptrdiff_t>(rows.first),
                  begin + static_cast<std::ptrdiff_t>(rows.next),
                  std::numeric_limits<float>::quiet_NaN());
      }
    }
  }
  return findings;
}

}  // namespace regoplan
