#include "diagnosis/bed/condensed_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "diagnosis/bed/turned_channels.h"
#include "diagnosis/recording/course_note.h"
#include "diagnosis/recording/run_times.h"
#include "diagnosis/recording/thresholds.h"
#include "diagnosis/recording/untold_days.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/interruption.h"
#include "terramech/parameters/trusted_range.h"

namespace regoplan {
namespace {

using ChannelValues = std::array<double, kChannelCount>;

struct Usable {
  std::vector<std::size_t> runs;
  std::vector<ChannelValues> model;  // per run of the recording, at the prior means
  int untrusted = 0, without_forces = 0;
};

Usable usable_runs(const Recording& recording, const WheelModel& model,
                   const std::stop_token& stop) {
  Usable usable;
  ChannelValues none;
  none.fill(WheelRun::kNotMeasured);
  usable.model.assign(recording.runs.size(), none);
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    const WheelRun& run = recording.runs[i];
    throw_if_stopped(stop);
    if (!is_trusted(run.slip_ratio, run.slip_angle_rad)) {
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

void note_left_out(const Usable& usable, std::vector<std::string>& notes) {
  if (usable.untrusted > 0) {
    notes.push_back(fmt::format(
        "{} runs lie where the model is not trusted (slip outside {} to {}, slip angle "
        "beyond {:.0f} deg) and are not judged",
        usable.untrusted, kTrustedSlip_min, kTrustedSlip_max, kTrustedSlipAngle_rad / kDegree));
  }
  if (usable.without_forces > 0) {
    notes.push_back(
        fmt::format("{} runs have no model forces at the prior means and are "
                    "not judged",
                    usable.without_forces));
  }
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

std::string given_note(const Recording& recording, const DiagnosisSetup& setup,
                       const ChannelNoise& noise) {
  const auto lent = setup.noise_lent.find(noise.channel);
  const bool is_given = lent == setup.noise_lent.end();
  const std::string_view from = is_given ? "the setup"
                                : lent->second == NoiseLender::kOtherSeries
                                    ? "the series that it is compared with"
                                    : "what a smooth difference of both leaves";
  std::string text =
      fmt::format("{}: too few replicates; noise {:.3g} from {}, days by half of it (assumed)",
                  name(noise.channel), noise.constant, from);
  const double span = span_of(recording, noise.channel);
  if (is_given && noise.constant > span) {
    text +=
        fmt::format("; all its values lie within {:.3g}: is the unit of the noise right?", span);
  }
  return text;
}

std::string noise_note(const Recording& recording, const DiagnosisSetup& setup,
                       const ChannelNoise& noise) {
  const std::string channel(name(noise.channel));
  switch (noise.source) {
    case NoiseSource::kSetup:
      return given_note(recording, setup, noise);
    case NoiseSource::kNeighbours:
      return fmt::format(
          "{}: too few replicates, and no setup, tell the noise; {:.3g} was taken from "
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

/// Runs in groups, each channel moved to its group's means.
struct Grouped {
  std::vector<Condition> conditions;
  std::vector<std::size_t> condition;  // per run
  std::vector<ChannelRuns> channels;
};

Grouped group(const Recording& recording, const Usable& usable, const WheelModel& model,
              const std::vector<int>& block, Places places = Places::kApart) {
  Grouped result{.conditions = group_conditions(recording, usable.runs, block, places)};
  result.condition.assign(recording.runs.size(), result.conditions.size());
  std::vector<std::optional<ChannelValues>> at_means;
  for (std::size_t k = 0; k < result.conditions.size(); ++k) {
    const Condition& at = result.conditions[k];
    for (const std::size_t run : at.runs) result.condition[run] = k;
    at_means.push_back(
        channels_at(model, at.load_n, at.slip_ratio, at.slip_angle_rad, at.conditions));
  }
  for (const Channel channel : recording.channels) {
    const auto c = static_cast<std::size_t>(channel);
    std::vector<double> adjusted(recording.runs.size(), WheelRun::kNotMeasured);
    std::vector<double> modelled = adjusted;
    bool measured = false;
    for (const std::size_t run : usable.runs) {
      const auto& mean = at_means[result.condition[run]];
      const double moved = mean ? (*mean)[c] - usable.model[run][c] : 0;
      adjusted[run] = recording.runs[run].value(channel) + moved;
      modelled[run] = usable.model[run][c];
      measured = measured || std::isfinite(adjusted[run]);
    }
    if (measured) result.channels.push_back({channel, std::move(adjusted), std::move(modelled)});
  }
  return result;
}

/// Per channel and run.
std::vector<std::vector<double>> values_of(const std::vector<ChannelRuns>& channels) {
  std::vector<std::vector<double>> values;
  for (const ChannelRuns& channel : channels) values.push_back(channel.adjusted);
  return values;
}

/// Runs by which scatter is told where the recording has next to no replicates on one place of the
/// bed: those of other places, as a wheel that rolls on is never twice on the same. Samples of one
/// run are none.
std::optional<Grouped> replicates_elsewhere(const Recording& recording, const Usable& usable,
                                            const WheelModel& model, const Grouped& grouped) {
  if (!recording.columns.position) return std::nullopt;
  std::size_t repeated = 0;
  for (const Condition& at : grouped.conditions) repeated += at.runs.size() - 1;
  std::set<std::string_view> ids;
  for (const std::size_t run : usable.runs) ids.insert(recording.runs[run].run_id);
  if (repeated >= static_cast<std::size_t>(kEnoughReplicates) || ids.size() < usable.runs.size())
    return std::nullopt;
  Grouped together = group(recording, usable, model, {}, Places::kTogether);
  if (together.conditions.size() == grouped.conditions.size()) return std::nullopt;
  return together;
}

/// What may change in the course of a recording: every channel by as much, by a share of itself, or
/// as other soil numbers would have it.
std::vector<CourseKind> course_kinds(const Recording& recording, const Usable& usable,
                                     const Grouped& grouped, const DiagnosisSetup& setup,
                                     const std::stop_token& stop) {
  CourseKind offset{.name = "offset"}, gain{.name = "gain"};
  for (const ChannelRuns& channel : grouped.channels) {
    offset.of_channel.emplace_back(recording.runs.size(), 1.0);
    gain.of_channel.push_back(channel.modelled);
  }
  std::vector<CourseKind> kinds{std::move(offset), std::move(gain)};
  const auto add = [&](std::string kind, double cohesion, double limit, double stiffness) {
    Soil soil = setup.soil.mean;
    soil.cohesion_pa *= cohesion * limit;
    soil.friction_angle_rad = std::atan(limit * std::tan(soil.friction_angle_rad));
    soil.kc *= stiffness;
    soil.kphi *= stiffness;
    const WheelModel changed({.variant = setup.variant,
                              .wheel = setup.wheel,
                              .soil = soil,
                              .gravity_mps2 = setup.gravity_mps2});
    CourseKind by_soil{.name = std::move(kind)};
    for (const ChannelRuns& channel : grouped.channels) {
      std::vector<double> change(recording.runs.size(), 0.0);
      for (const std::size_t run : usable.runs) {
        throw_if_stopped(stop);
        const WheelRun& at = recording.runs[run];
        const auto value =
            channels_at(changed, at.load_n, at.slip_ratio, at.slip_angle_rad, at.conditions);
        const auto c = static_cast<std::size_t>(channel.channel);
        if (value) change[run] = (*value)[c] - usable.model[run][c];
      }
      by_soil.of_channel.push_back(std::move(change));
    }
    kinds.push_back(std::move(by_soil));
  };
  if (setup.soil.mean.cohesion_pa > 0) add("cohesion", 1.3, 1, 1);
  add("strength", 1, 1.1, 1);
  add("stiffness", 1, 1, 1.3);
  return kinds;
}

/// Each condition stands where its runs do in the mean.
void place_in_time(const Course& course, std::vector<Condition>& conditions) {
  for (Condition& at : conditions) {
    for (const std::size_t run : at.runs) {
      at.when += course.value[run] / static_cast<double>(at.runs.size());
    }
  }
}

/// When it was that replicates differ from all others, and the rest of the time where it lies on
/// one side of that: either may be what is off. Nothing where they follow something else, or where
/// times do not tell the two apart, as of clocks that start anew each day.
std::vector<Span> times_apart_s(const Recording& recording, const Usable& usable,
                                const Course& course) {
  if (!course.for_a_time()) return {};
  Span apart, rest;
  const auto time_s = [&](std::size_t run) { return recording.runs[run].conditions.time_s; };
  for (const std::size_t run : usable.runs) {
    (course.value[run] > 0 ? apart : rest).take(time_s(run));
  }
  for (const std::size_t run : usable.runs) {
    if (course.value[run] > 0) continue;
    if (time_s(run) >= apart.low && time_s(run) <= apart.high) return {};
  }
  if (rest.low < apart.low && rest.high > apart.high) return {apart};
  return {apart, rest};
}

/// Moves every run to the mean of what it follows.
void take_off(const Course& course, const std::vector<ChannelNoise>& noise,
              std::vector<ChannelRuns>& channels) {
  for (std::size_t c = 0; c < channels.size(); ++c) {
    double mean = 0;
    for (const double t : course.trend[c]) mean += t / static_cast<double>(course.trend[c].size());
    for (std::size_t run = 0; run < course.trend[c].size(); ++run) {
      channels[c].adjusted[run] -= noise[c].trend * (course.trend[c][run] - mean);
    }
  }
}

}  // namespace

ChannelData means_of(const std::vector<double>& day, const std::vector<Condition>& conditions,
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
      of_days.push_back({day[run], w});
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

CondensedRecording condense(const Recording& raw, const DiagnosisSetup& setup, std::size_t fewest,
                            std::stop_token stop) {
  CondensedRecording result;
  Recording recording = with_days(with_times(raw));
  const auto base_model =
      std::make_shared<const WheelModel>(WheelModelSpec{.variant = setup.variant,
                                                        .wheel = setup.wheel,
                                                        .soil = setup.soil.mean,
                                                        .gravity_mps2 = setup.gravity_mps2});
  const WheelModel& model = *base_model;
  const Usable usable = usable_runs(recording, model, stop);
  note_left_out(usable, result.notes);
  result.used = usable.runs;
  for (const TurnedChannel& turned : turned_channels(recording, usable.runs)) {
    result.turned.push_back(turned.channel);
    result.notes.push_back(fmt::format("{} opposes {}: it was turned for the analysis",
                                       name(turned.channel), turned.opposes));
    for (WheelRun& run : recording.runs) {
      double& value = run.measured[static_cast<std::size_t>(turned.channel)];
      value = -value;
    }
  }
  TestBed& bed = result.bed;
  bed.setup = setup;
  bed.base_model = base_model;
  Grouped grouped = group(recording, usable, model, {});
  if (grouped.conditions.size() < fewest) {
    throw InputError(
        fmt::format("recording: {} different condition{} that the model can judge; a "
                    "diagnosis needs {} and more",
                    grouped.conditions.size(), grouped.conditions.size() == 1 ? "" : "s", fewest));
  }
  auto elsewhere = replicates_elsewhere(recording, usable, model, grouped);
  const Grouped& replicated = elsewhere ? *elsewhere : grouped;
  if (elsewhere) {
    result.notes.emplace_back(
        "replicates lie at different positions: their scatter is told as if these were alike");
  }
  if (auto untold =
          untold_days(recording, replicated.conditions, replicated.channels, setup, stop)) {
    result.notes.push_back(fmt::format(
        "replicates differ by their round: {} days that the recording does not tell were assumed "
        "({:.0f} nats over scatter alone); a column `day` or `time_s` decides",
        untold->rounds.count, untold->gain_nats));
    recording = std::move(untold->rounds.recording);
  }
  for (const WheelRun& run : recording.runs) result.day.push_back(run.day);
  result.course =
      likeliest_course(recording, replicated.conditions, replicated.channels,
                       course_kinds(recording, usable, replicated, setup, stop), setup, stop);
  if (result.course && !(result.course->gain_nats > Thresholds::kCourse_nats)) {
    if (result.course->gain_nats > Thresholds::kDoubtfulCourse_nats) {
      result.notes.push_back(doubtful_course_note(*result.course));
    }
    result.course.reset();
  }
  for (std::size_t c = 0; c < replicated.channels.size(); ++c) {
    const ChannelRuns& runs = replicated.channels[c];
    result.noise.push_back(
        estimate_noise(recording, replicated.conditions, runs, setup,
                       result.course ? result.course->trend[c] : std::vector<double>{}, stop));
  }
  if (result.course) result.notes.push_back(course_note(*result.course, result.noise));
  if (result.course && result.course->in_time()) {
    if (!tells_times(recording)) {
      bed.times_are_assumed = true;
      recording = with_even_times(std::move(recording), replicated.conditions);
      result.notes.emplace_back(
          "the recording tells no times: runs are taken to follow each other evenly, a round of "
          "replicates a day");
    }
    grouped = group(recording, usable, model, blocks_of(*result.course));
    place_in_time(*result.course, grouped.conditions);
    bed.times_apart_s = times_apart_s(recording, usable, *result.course);
  } else if (result.course && result.course->after_run()) {
    take_off(*result.course, result.noise, grouped.channels);
  }
  bed.conditions = std::move(grouped.conditions);
  result.condition = std::move(grouped.condition);
  result.adjusted = values_of(grouped.channels);
  if (result.noise.empty()) throw InputError("recording: no channel is measured");
  share_day_offsets(result.noise);
  for (std::size_t c = 0; c < result.noise.size(); ++c) {
    result.notes.push_back(noise_note(recording, setup, result.noise[c]));
    bed.channels.push_back(
        means_of(result.day, bed.conditions, result.noise[c], result.adjusted[c]));
  }
  bed.accuracy = sufficient_accuracy(bed);
  bed.stop = std::move(stop);
  if (elsewhere && result.course) take_off(*result.course, result.noise, elsewhere->channels);
  result.correlation = elsewhere ? noise_correlation(result.noise, elsewhere->conditions,
                                                     values_of(elsewhere->channels))
                                 : noise_correlation(result.noise, bed.conditions, result.adjusted);
  return result;
}

}  // namespace regoplan
