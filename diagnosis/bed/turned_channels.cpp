#include "diagnosis/bed/turned_channels.h"

#include <array>
#include <cmath>

namespace regoplan {
namespace {

constexpr double kClearSlip = 0.1;

/// A channel whose sign the wheel's motion tells: that of a number of the run, where it is clear.
struct SignConvention {
  Channel channel;
  double WheelRun::*motion;
  double clearly_from, clearly_below;  ///< of the motion; between them nothing is told
  std::string_view text;
};

constexpr std::array kSignConventions{
    // a wheel that drives may sink in so deep that it needs a push
    SignConvention{Channel::kFx, &WheelRun::slip_ratio, INFINITY, -kClearSlip,
                   "a wheel that is held back (negative)"},
    SignConvention{Channel::kFy, &WheelRun::slip_angle_rad, 0.05, -0.05,
                   "the convention (positive for a positive slip angle)"},
    // a wheel that is held back may be driven all the same
    SignConvention{Channel::kTorque, &WheelRun::slip_ratio, kClearSlip, -INFINITY,
                   "a driving wheel (positive)"}};

/// Whether most of a channel's values have the other sign.
bool is_opposed(const Recording& recording, const std::vector<std::size_t>& used,
                const SignConvention& convention) {
  double as_told = 0, turned = 0;
  for (const std::size_t i : used) {
    const WheelRun& run = recording.runs[i];
    const double value = run.value(convention.channel), motion = run.*convention.motion;
    if (!std::isfinite(value)) continue;
    if (motion < convention.clearly_from && motion > convention.clearly_below) continue;
    (value * motion > 0 ? as_told : turned) += std::abs(value);
  }
  return turned > 3 * as_told;
}

}  // namespace

bool drawbar_falls_with_slip(const Recording& recording, const std::vector<std::size_t>& used) {
  double driving = 0, held_back = 0;
  int driving_runs = 0, held_back_runs = 0;
  for (const std::size_t i : used) {
    const WheelRun& run = recording.runs[i];
    const double pull = run.value(Channel::kFx) / run.load_n;
    if (!std::isfinite(pull) || std::abs(run.slip_ratio) < kClearSlip) continue;
    (run.slip_ratio > 0 ? driving : held_back) += pull;
    ++(run.slip_ratio > 0 ? driving_runs : held_back_runs);
  }
  return driving_runs > 0 && held_back_runs > 0 &&
         driving / driving_runs < held_back / held_back_runs;
}

std::vector<TurnedChannel> turned_channels(const Recording& recording,
                                           const std::vector<std::size_t>& used) {
  std::vector<TurnedChannel> turned;
  for (const SignConvention& convention : kSignConventions) {
    if (!is_opposed(recording, used, convention)) continue;
    if (convention.channel == Channel::kFx && !drawbar_falls_with_slip(recording, used)) continue;
    turned.push_back({convention.channel, convention.text});
  }
  return turned;
}

}  // namespace regoplan
