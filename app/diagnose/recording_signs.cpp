#include "app/diagnose/recording_signs.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/bed/turned_channels.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

constexpr double kClearSlip = 0.1;

/// Runs in which a channel's sign is clear, and those in which it is the other one.
struct Opposition {
  int clear = 0, against = 0;
  std::size_t first = 0;  ///< of those against

  bool is_throughout() const {
    constexpr int kFewest = 4;
    return clear >= kFewest && 5 * against >= 4 * clear;
  }
};

/// \param applies of a run
template <class Applies>
Opposition opposition(const ModelledRecording& recording, Channel channel, Applies applies) {
  constexpr double kClear_share = 0.05;
  Opposition found;
  for (std::size_t i = 0; i < recording.runs().size(); ++i) {
    const WheelRun& run = recording.runs()[i];
    const double expected = recording.modelled(i, channel);
    if (!recording.is_comparable(i, channel) || !applies(run)) continue;
    if (std::abs(expected) < kClear_share * recording.reach(i, channel)) continue;
    ++found.clear;
    if (run.value(channel) * expected >= 0) continue;
    if (found.against++ == 0) found.first = i;
  }
  return found;
}

Opposition opposition(const ModelledRecording& recording, Channel channel) {
  return opposition(recording, channel, [](const WheelRun&) { return true; });
}

/// No wheel that carries a load stands above the soil.
void refuse_wheels_above_the_soil(const ModelledRecording& recording) {
  constexpr double kClear_share = 0.01, kThroughout = 9;
  double above_m = 0, below_m = 0;
  int measured = 0;
  std::vector<std::size_t> above;
  for (std::size_t i = 0; i < recording.runs().size(); ++i) {
    const double sinkage_m = recording.runs()[i].value(Channel::kSinkage);
    if (std::isnan(sinkage_m)) continue;
    ++measured;
    if (sinkage_m < 0) above.push_back(i);
    (sinkage_m < 0 ? above_m : below_m) += std::abs(sinkage_m);
  }
  const bool clearly =
      above_m > kClear_share * recording.wheel().radius_m * static_cast<double>(above.size());
  if (!clearly || above_m <= kThroughout * below_m) return;
  throw InputError(fmt::format(
      "{}: sinkage_m: {} is not valid (allowed: from 0, the depth below the soil that was not "
      "driven on); it is negative in {} of {} runs; suspected: an axis that points up, or "
      "its zero",
      recording.place(above.front()), recording.runs()[above.front()].value(Channel::kSinkage),
      above.size(), measured));
}

/// Whether drawbar pull changes from run to run the other way than the model's, and falls from
/// held-back wheels to driving ones or opposes the model throughout. Loose soil, in which driving
/// wheels need a push, does the last only.
bool pull_is_turned(const ModelledRecording& recording, const Opposition& pull) {
  constexpr double kOtherWay = -0.5;
  if (!recording.is_measured(Channel::kFx) || recording.correlation(Channel::kFx) > kOtherWay) {
    return false;
  }
  std::vector<std::size_t> comparable;
  for (std::size_t i = 0; i < recording.runs().size(); ++i) {
    if (recording.is_comparable(i, Channel::kFx)) comparable.push_back(i);
  }
  return pull.is_throughout() || drawbar_falls_with_slip(recording.file().recording, comparable);
}

/// Drawbar pull and torque that both oppose the model: it is the slip that has the other sign.
void refuse_slip_of_the_other_sign(const ModelledRecording& recording) {
  const Opposition pull = opposition(recording, Channel::kFx);
  const Opposition torque = opposition(recording, Channel::kTorque, [](const WheelRun& run) {
    return std::abs(run.slip_ratio) > kClearSlip;
  });
  if (!pull_is_turned(recording, pull) || !torque.is_throughout()) return;
  throw InputError(fmt::format(
      "{}: slip_ratio: {} is not valid (allowed: above 0 where the wheel drives, below 0 where "
      "it is held back); fx_n and torque_nm say the other in {} of {} runs; suspected: "
      "slip_ratio of the other sign",
      recording.place(torque.first), recording.runs()[torque.first].slip_ratio, torque.against,
      torque.clear));
}

std::string sentence(const ModelledRecording& recording, Channel channel, const Opposition& found,
                     std::string_view convention, std::string_view suspected) {
  return fmt::format(
      "{}: {} opposes {}; is {} turned round? In {} of {} runs where its sign is clear.",
      recording.place(found.first), name(channel), convention, suspected, found.against,
      found.clear);
}

}  // namespace

std::vector<std::string> doubtful_signs(const ModelledRecording& recording) {
  refuse_wheels_above_the_soil(recording);
  refuse_slip_of_the_other_sign(recording);
  std::vector<std::string> doubtful;
  const auto doubt = [&](Channel channel, const Opposition& found, std::string_view convention,
                         std::string_view suspected) {
    doubtful.push_back(sentence(recording, channel, found, convention, suspected));
  };
  constexpr const char* kAxis = "an axis of the sensor";
  // One of the two alone cannot tell its own sign from the slip's.
  const bool slip_is_told =
      recording.is_measured(Channel::kFx) && recording.is_measured(Channel::kTorque);
  const char* turned = slip_is_told ? kAxis : "an axis of the sensor, or the sign of slip_ratio,";
  const Opposition pull = opposition(recording, Channel::kFx);
  if (pull_is_turned(recording, pull)) {
    doubt(Channel::kFx, pull, "a wheel that drives (positive) or is held back (negative)", turned);
  }
  const Opposition side = opposition(recording, Channel::kFy);
  if (side.is_throughout()) {
    doubt(Channel::kFy, side,
          "the convention (positive for a positive slip angle: it opposes the lateral motion)",
          kAxis);
  }
  const Opposition torque = opposition(
      recording, Channel::kTorque, [](const WheelRun& run) { return run.slip_ratio > kClearSlip; });
  if (torque.is_throughout()) {
    doubt(Channel::kTorque, torque, "a driving wheel (positive)", turned);
  }
  return doubtful;
}

}  // namespace regoplan
