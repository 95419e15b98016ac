#include "diagnosis/condensed_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "terramech/input_error.h"

namespace regoplan {
namespace {

constexpr std::size_t kFewestConditions = 8;
constexpr double kDay_s = 86400;

using ChannelValues = std::array<double, kChannelCount>;

struct Usable {
  std::vector<std::size_t> runs;
  std::vector<ChannelValues> model;  // per run of the recording, at the prior means
  int untrusted = 0, without_forces = 0;
};

Usable usable_runs(const Recording& recording, const WheelModel& model) {
  Usable usable;
  ChannelValues none;
  none.fill(WheelRun::kNotMeasured);
  usable.model.assign(recording.runs.size(), none);
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    const WheelRun& run = recording.runs[i];
    const bool trusted = run.slip_ratio >= -0.9 && run.slip_ratio <= 0.95 &&
                         std::abs(run.slip_angle_rad) <= std::numbers::pi / 3 + 1e-9;
    if (!trusted) {
      ++usable.untrusted;
      continue;
    }
    const auto value =
        channels_at(model, run.load_n, run.slip_ratio, run.slip_angle_rad, run.conditions);
    if (!value) {
      ++usable.without_forces;
      continue;
    }
    usable.model[i] = *value;
    usable.runs.push_back(i);
  }
  return usable;
}

/// The day as a time where no time is recorded.
Recording with_times(Recording recording) {
  if (recording.runs.empty()) return recording;
  double first = INFINITY;
  for (const WheelRun& run : recording.runs) first = std::min(first, run.day);
  if (recording.columns.time) return recording;
  for (WheelRun& run : recording.runs) run.conditions.time_s = (run.day - first) * kDay_s;
  return recording;
}

/// Whether most side forces push the way the wheel moves.
bool side_is_turned(const Recording& recording, const std::vector<std::size_t>& used) {
  constexpr double kClearly_rad = 0.05;
  double along = 0, against = 0;
  for (const std::size_t i : used) {
    const WheelRun& run = recording.runs[i];
    const double fy = run.value(Channel::kFy);
    if (!std::isfinite(fy) || std::abs(run.slip_angle_rad) < kClearly_rad) continue;
    (fy * run.slip_angle_rad > 0 ? against : along) += std::abs(fy);
  }
  return along > 3 * against;
}

std::size_t days_of(const Recording& recording) {
  std::set<double> days;
  for (const WheelRun& run : recording.runs) days.insert(run.day);
  return days.size();
}

/// Between its smallest and its largest value.
double span_of(const Recording& recording, Channel channel) {
  double low = INFINITY, high = -INFINITY;
  for (const WheelRun& run : recording.runs) {
    if (!std::isfinite(run.value(channel))) continue;
    low = std::min(low, run.value(channel));
    high = std::max(high, run.value(channel));
  }
  return high - low;
}

std::string setup_note(const Recording& recording, const ChannelNoise& noise) {
  std::string text =
      fmt::format("{}: no replicates; noise {:.3g} from the setup, days by half of it (assumed)",
                  name(noise.channel), noise.constant);
  const double span = span_of(recording, noise.channel);
  if (noise.constant > span) {
    text +=
        fmt::format("; all its values lie within {:.3g}: is the unit of the noise right?", span);
  }
  return text;
}

std::string noise_note(const Recording& recording, const ChannelNoise& noise) {
  const std::string channel(name(noise.channel));
  switch (noise.source) {
    case NoiseSource::kSetup:
      return setup_note(recording, noise);
    case NoiseSource::kNeighbours:
      return fmt::format(
          "{}: neither replicates nor setup tell the noise; {:.3g} was taken from "
          "the scatter between neighbouring conditions, which is cautious: small "
          "effects stay unseen",
          channel, noise.constant);
    case NoiseSource::kReplicates:
      break;
  }
  std::string text = fmt::format("{}: one run scatters by {:.3g} ({} degrees of freedom)", channel,
                                 noise.constant, noise.degrees_of_freedom);
  if (noise.proportional > 0)
    text += fmt::format(", plus {:.2g} of the signal", noise.proportional);
  if (noise.day_offset > 0) {
    text +=
        fmt::format(", days differ by {:.3g}{}", noise.day_offset,
                    noise.day_assumed ? " (assumed: no condition was run on several days)" : "");
  }
  if (noise.day_gain > 0) text += fmt::format(", days by {:.2g} of the signal", noise.day_gain);
  if (!noise.outliers.empty()) {
    text += ", outliers:";
    for (const std::size_t run : noise.outliers) text += " " + recording.runs[run].run_id;
  }
  return text;
}

}  // namespace

ChannelData means_of(const Recording& recording, const std::vector<Condition>& conditions,
                     const ChannelNoise& noise, const std::vector<double>& adjusted) {
  ChannelData data{.channel = noise.channel};
  struct Part {
    double day, weight;
  };
  std::vector<std::vector<Part>> parts;
  std::vector<double> means, own, scales;
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    double sum = 0, weights = 0;
    std::vector<Part> of_days;
    for (const std::size_t run : conditions[k].runs) {
      if (!std::isfinite(adjusted[run])) continue;
      const double w = noise.weight[run];
      sum += w * adjusted[run];
      weights += w;
      of_days.push_back({recording.runs[run].day, w});
    }
    if (weights == 0) continue;
    for (Part& part : of_days) part.weight /= weights;
    data.conditions.push_back(k);
    means.push_back(sum / weights);
    scales.push_back(run_deviation(noise, sum / weights));
    own.push_back(scales.back() * scales.back() / weights);
    parts.push_back(std::move(of_days));
  }
  const auto n = static_cast<Eigen::Index>(means.size());
  data.mean = Eigen::Map<const Eigen::VectorXd>(means.data(), n);
  data.noise = Eigen::Map<const Eigen::VectorXd>(own.data(), n).asDiagonal();
  const double offset2 = noise.day_offset * noise.day_offset;
  const double gain2 = noise.day_gain * noise.day_gain;
  if (offset2 + gain2 > 0) {
    for (Eigen::Index a = 0; a < n; ++a) {
      for (Eigen::Index b = 0; b < n; ++b) {
        double shared = 0;
        for (const Part& p : parts[static_cast<std::size_t>(a)]) {
          for (const Part& q : parts[static_cast<std::size_t>(b)]) {
            if (p.day == q.day) shared += p.weight * q.weight;
          }
        }
        data.noise(a, b) += shared * (offset2 + gain2 * data.mean[a] * data.mean[b]);
      }
    }
  }
  std::ranges::nth_element(scales, scales.begin() + n / 2);
  data.scale = scales[static_cast<std::size_t>(n / 2)];
  return data;
}

CondensedRecording condense(const Recording& raw, const DiagnosisSetup& setup) {
  CondensedRecording result;
  Recording recording = with_times(raw);
  const WheelModel model({.variant = setup.variant,
                          .wheel = setup.wheel,
                          .soil = setup.soil.mean,
                          .gravity_mps2 = setup.gravity_mps2});
  const Usable usable = usable_runs(recording, model);
  if (usable.untrusted > 0) {
    result.notes.push_back(
        fmt::format("{} runs lie where the model is not trusted (slip outside "
                    "-0.9 to 0.95, slip angle beyond 60 deg) and are not judged",
                    usable.untrusted));
  }
  if (usable.without_forces > 0) {
    result.notes.push_back(
        fmt::format("{} runs have no model forces at the prior means and are "
                    "not judged",
                    usable.without_forces));
  }
  result.used = usable.runs;
  if (side_is_turned(recording, usable.runs)) {
    result.side_sign = -1;
    result.notes.push_back(
        "fy_n opposes the convention (positive for a positive slip angle): it "
        "was turned for the analysis");
    for (WheelRun& run : recording.runs) run.measured[1] = -run.measured[1];
  }
  TestBed& bed = result.bed;
  bed.setup = setup;
  bed.conditions = group_conditions(recording, usable.runs);
  if (bed.conditions.size() < kFewestConditions) {
    throw InputError(
        fmt::format("recording: {} different conditions that the model can judge; a "
                    "diagnosis needs {} and more",
                    bed.conditions.size(), kFewestConditions));
  }
  result.condition.assign(recording.runs.size(), bed.conditions.size());
  std::vector<std::optional<ChannelValues>> at_means;
  for (std::size_t k = 0; k < bed.conditions.size(); ++k) {
    const Condition& at = bed.conditions[k];
    for (const std::size_t run : at.runs) result.condition[run] = k;
    at_means.push_back(
        channels_at(model, at.load_n, at.slip_ratio, at.slip_angle_rad, at.conditions));
  }
  for (const Channel channel : recording.channels) {
    const auto c = static_cast<std::size_t>(channel);
    std::vector<double> adjusted(recording.runs.size(), WheelRun::kNotMeasured);
    std::vector<double> modelled = adjusted;
    std::size_t measured = 0;
    for (const std::size_t run : usable.runs) {
      const auto& mean = at_means[result.condition[run]];
      const double moved = mean ? (*mean)[c] - usable.model[run][c] : 0;
      adjusted[run] = recording.runs[run].value(channel) + moved;
      modelled[run] = usable.model[run][c];
      if (std::isfinite(adjusted[run])) ++measured;
    }
    if (measured == 0) continue;
    result.noise.push_back(
        estimate_noise(recording, bed.conditions, channel, adjusted, modelled, setup));
    result.adjusted.push_back(std::move(adjusted));
  }
  if (result.noise.empty()) throw InputError("recording: no channel is measured");
  share_day_offsets(result.noise, days_of(recording));
  for (std::size_t c = 0; c < result.noise.size(); ++c) {
    result.notes.push_back(noise_note(recording, result.noise[c]));
    bed.channels.push_back(
        means_of(recording, bed.conditions, result.noise[c], result.adjusted[c]));
  }
  bed.accuracy = sufficient_accuracy(bed);
  result.correlation = noise_correlation(result.noise, bed.conditions, result.adjusted);
  return result;
}

}  // namespace regoplan
