#include "drive_diagnosis/comparison/channel_samples.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {

double sample_std(const DriveRecording& drive, const std::string& name) {
  const DriveChannel* channel = drive.channel(name);
  if (!channel) return 0;
  std::vector<double> time_s, values;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const auto value = static_cast<double>(channel->values[i]);
    if (std::isnan(value) || value == 0) continue;
    time_s.push_back(drive.time_s[i]);
    values.push_back(value);
  }
  return scatter_of_samples(time_s, values);
}

int samples_in(const DriveRecording& drive, const DriveWindow& window, const std::string& name) {
  const DriveChannel* channel = drive.channel(name);
  int samples = 0;
  for (std::size_t i = 0; channel && i < drive.size(); ++i) {
    const bool is_within = drive.time_s[i] >= window.start_s && drive.time_s[i] <= window.end_s;
    if (is_within && !std::isnan(channel->values[i])) ++samples;
  }
  return samples;
}

double mean_size(const DriveRecording& drive, const DriveWindow& window, const std::string& name) {
  const DriveChannel* channel = drive.channel(name);
  if (!channel) return 0;
  const auto begin = std::ranges::lower_bound(drive.time_s, window.start_s) - drive.time_s.begin();
  double squares = 0;
  int count = 0;
  for (auto i = static_cast<std::size_t>(begin);
       i < drive.size() && drive.time_s[i] <= window.end_s; ++i) {
    const auto value = static_cast<double>(channel->values[i]);
    if (std::isnan(value)) continue;
    squares += value * value;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(squares / count);
}

double step_error(const DriveRecording& drive, const DriveWindow& window, const std::string& name,
                  double sample_std) {
  const DriveChannel* channel = drive.channel(name);
  if (!channel) return 0;
  const auto begin = std::ranges::lower_bound(drive.time_s, window.start_s) - drive.time_s.begin();
  double squares = 0, last_s = NAN, last = NAN;
  for (auto i = static_cast<std::size_t>(begin);
       i < drive.size() && drive.time_s[i] <= window.end_s; ++i) {
    const auto value = static_cast<double>(channel->values[i]);
    if (std::isnan(value)) continue;
    if (!std::isnan(last)) {
      const double length_s = drive.time_s[i] - last_s;
      squares +=
          ((value - last) * (value - last) - 2 * sample_std * sample_std) * length_s * length_s;
    }
    last_s = drive.time_s[i];
    last = value;
  }
  return std::sqrt(std::max(0.0, squares)) / 2 / (window.end_s - window.start_s);
}

}  // namespace regoplan
