#include "diagnosis/bed/compared_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "diagnosis/bed/scatter_of_difference.h"
#include "diagnosis/recording/replicates.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

constexpr std::size_t kFewestToCompare = 3;

/// Channels that test and references measure, nothing else.
Recording restricted(Recording recording, const std::vector<Channel>& channels) {
  for (WheelRun& run : recording.runs) {
    for (const Channel channel : recording.channels) {
      if (std::ranges::find(channels, channel) != channels.end()) continue;
      run.measured[static_cast<std::size_t>(channel)] = WheelRun::kNotMeasured;
    }
  }
  recording.channels = channels;
  return recording;
}

std::vector<std::vector<Channel>> channels_of(const std::vector<Reference>& references) {
  std::vector<std::vector<Channel>> channels;
  for (const Reference& reference : references) channels.push_back(reference.recording.channels);
  return channels;
}

bool all_have(const std::vector<std::vector<Channel>>& recordings, Channel channel) {
  return std::ranges::all_of(recordings, [channel](const std::vector<Channel>& channels) {
    return std::ranges::find(channels, channel) != channels.end();
  });
}

/// \throws InputError where there is none
std::vector<Channel> common_channels(const std::vector<Channel>& test,
                                     const std::vector<std::vector<Channel>>& references) {
  std::vector<Channel> common;
  std::ranges::copy_if(test, std::back_inserter(common),
                       [&](Channel channel) { return all_have(references, channel); });
  if (common.empty()) throw InputError("test and reference have no measured channel in common");
  return common;
}

/// Takes out the runs of passes that no reference drove, where the test drove a reference's pass
/// too: what another pass changes within the test is no difference between the series. Where all of
/// the test is of other passes, the pass is what differs, and it is compared as it stands.
/// \returns how many runs
int leave_foreign_passes_out(const std::vector<Reference>& references, Recording& test) {
  std::set<int> driven;
  for (const Reference& reference : references) {
    for (const WheelRun& run : reference.recording.runs) driven.insert(run.conditions.pass);
  }
  const auto is_foreign = [&](const WheelRun& run) {
    return !driven.contains(run.conditions.pass);
  };
  const auto foreign = static_cast<std::size_t>(std::ranges::count_if(test.runs, is_foreign));
  if (foreign + kFewestToCompare > test.runs.size()) return 0;
  for (WheelRun& run : test.runs) {
    if (is_foreign(run)) run.measured.fill(WheelRun::kNotMeasured);
  }
  return static_cast<int>(foreign);
}

/// A scatter of runs, and who tells it.
struct Lent {
  RunScatter scatter;
  NoiseLender lender = NoiseLender::kOtherSeries;
};

/// A recording that is compared, and what others tell of its noise.
struct Compared {
  std::string name;  // of a reference
  Recording recording;
  DiagnosisSetup setup;  // its own
  std::map<Channel, Lent> lent = {};
  CondensedRecording condensed = {};

  bool states(Channel channel) const { return setup.noise_standard_deviation.contains(channel); }
  bool lacks_replicates() const {
    return std::ranges::any_of(condensed.noise, [](const ChannelNoise& noise) {
      return noise.source == NoiseSource::kNeighbours;
    });
  }
};

void condense_with_lent(Compared& one, const std::stop_token& stop) {
  DiagnosisSetup with = one.setup;
  for (const auto& [channel, told] : one.lent) {
    if (with.noise_standard_deviation.try_emplace(channel, told.scatter.deviation).second)
      with.noise_lent[channel] = told.lender;
  }
  try {
    one.condensed = condense(one.recording, with, kFewestToCompare, stop);
  } catch (const InputError& bad) {
    if (one.name.empty()) throw;
    throw InputError(fmt::format("reference {}: {}", one.name, bad.what()));
  }
}

/// As recordings with replicates tell it, at their usual signal where it grows with that.
std::optional<RunScatter> told_by_replicates(const std::vector<Compared>& all, Channel channel) {
  double weight = 0, variance = 0;
  int most = 0;
  for (const Compared& one : all) {
    for (std::size_t c = 0; c < one.condensed.noise.size(); ++c) {
      const ChannelNoise& noise = one.condensed.noise[c];
      const bool tells = noise.source == NoiseSource::kReplicates || one.states(channel);
      if (noise.channel != channel || !tells) continue;
      const double own = std::max(1, noise.degrees_of_freedom);
      weight += own;
      variance += own * std::pow(usual_deviation(noise, one.condensed.adjusted[c]), 2);
      most = std::max(most, noise.degrees_of_freedom);
    }
  }
  if (weight == 0) return std::nullopt;
  return RunScatter{std::sqrt(variance / weight), most};
}

/// As the few replicates of each tell it together, where they are enough then.
std::optional<RunScatter> told_together(const std::vector<Compared>& all, Channel channel) {
  double squares = 0;
  int contrasts = 0;
  for (const Compared& one : all) {
    for (std::size_t c = 0; c < one.condensed.noise.size(); ++c) {
      if (one.condensed.noise[c].channel != channel) continue;
      const std::vector<double>& value = one.condensed.adjusted[c];
      const Replicates replicates = replicates_of(one.condensed.bed.conditions, value);
      contrasts += replicates.contrasts;
      for (const std::vector<std::size_t>& group : replicates.groups) {
        double mean = 0;
        for (const std::size_t run : group) mean += value[run] / static_cast<double>(group.size());
        for (const std::size_t run : group) squares += std::pow(value[run] - mean, 2);
      }
    }
  }
  if (contrasts < kEnoughReplicates || squares == 0) return std::nullopt;
  return RunScatter{std::sqrt(squares / contrasts), contrasts};
}

/// One run scatters alike on all: who has no replicates, or too few, learns it from the others.
std::map<Channel, Lent> lent_by(const std::vector<Compared>& all,
                                const std::vector<Channel>& channels) {
  std::map<Channel, Lent> lent;
  for (const Channel channel : channels) {
    auto told = told_by_replicates(all, channel);
    if (!told) told = told_together(all, channel);
    if (told) lent.emplace(channel, Lent{*told});
  }
  return lent;
}

/// As neighbouring conditions of the others tell it at most, for who has too few of his own.
void lend_neighbour_scatter(const std::vector<Compared>& from, Compared& to) {
  const auto is_measured = [](const WheelRun& run) {
    return std::ranges::any_of(run.measured, [](double value) { return std::isfinite(value); });
  };
  const auto runs = std::ranges::count_if(to.recording.runs, is_measured);
  if (static_cast<std::size_t>(runs) >= kFewestConditions) return;
  std::map<Channel, Lent> most;
  for (const Compared& one : from) {
    for (const ChannelNoise& noise : one.condensed.noise) {
      if (noise.source != NoiseSource::kNeighbours) continue;
      RunScatter& told = most[noise.channel].scatter;
      if (noise.constant > told.deviation)
        told = {noise.constant, noise.neighbour_degrees_of_freedom};
    }
  }
  to.lent.merge(most);
}

/// Where nobody's replicates tell a channel's scatter: what a smooth difference of the test, the
/// last of all, from that reference leaves which has the most conditions like its own, where that
/// is less than what neighbouring conditions of each tell.
void lend_scatter_of_difference(const std::vector<Compared>& all, std::map<Channel, Lent>& lent) {
  const CondensedRecording& test = all.back().condensed;
  std::vector<RunScatter> best(test.noise.size());
  if (lent.size() == best.size()) return;
  // Of equally many the larger, so that the order of references does not count.
  const auto tells_less = [](const RunScatter& a, const RunScatter& b) {
    return std::pair(a.degrees_of_freedom, a.deviation) <
           std::pair(b.degrees_of_freedom, b.deviation);
  };
  for (std::size_t r = 0; r + 1 < all.size(); ++r) {
    const auto told = scatter_of_difference(test, all[r].condensed);
    for (std::size_t c = 0; c < best.size(); ++c) {
      best[c] = std::max(best[c], told[c].value_or(RunScatter{}), tells_less);
    }
  }
  for (std::size_t c = 0; c < best.size(); ++c) {
    const bool is_less = std::ranges::all_of(all, [&](const Compared& one) {
      return best[c].deviation < one.condensed.noise[c].constant;
    });
    if (best[c].deviation > 0 && is_less)
      lent.try_emplace(test.noise[c].channel, Lent{best[c], NoiseLender::kDifference});
  }
}

/// Noise that was lent is known as well as the lenders tell it, not exactly.
void lend_doubt(Compared& to) {
  for (ChannelNoise& noise : to.condensed.noise) {
    const auto told = to.lent.find(noise.channel);
    if (noise.source != NoiseSource::kSetup || to.states(noise.channel) || told == to.lent.end())
      continue;
    noise.degrees_of_freedom =
        std::max(noise.degrees_of_freedom, told->second.scatter.degrees_of_freedom);
  }
}

/// The scatter of both together, where one of them by chance shows less.
void pool_noise(std::vector<Compared>& all) {
  for (std::size_t c = 0; c < all.front().condensed.noise.size(); ++c) {
    double sum = 0;
    int degrees = 0;
    for (const Compared& one : all) {
      const ChannelNoise& noise = one.condensed.noise[c];
      sum += noise.degrees_of_freedom * noise.constant * noise.constant;
      degrees += noise.degrees_of_freedom;
    }
    if (degrees == 0) continue;
    const double pooled = std::sqrt(sum / degrees);
    for (Compared& one : all) {
      ChannelNoise& noise = one.condensed.noise[c];
      if (noise.constant >= pooled) continue;
      const double factor = pooled / noise.constant;
      noise.constant *= factor;
      noise.proportional *= factor;
      noise.day_offset *= factor;
      noise.day_gain *= factor;
      // as all of them tell it; who states the scatter still knows it
      if (noise.degrees_of_freedom > 0) noise.degrees_of_freedom = degrees;
      one.condensed.bed.channels[c].noise *= factor * factor;
      one.condensed.bed.channels[c].scale *= factor;
    }
  }
}

/// Condensed, each with the scatter of the others where it has no replicates.
/// \param all the references, then the test
void condense_alike(const std::vector<Channel>& channels, const std::stop_token& stop,
                    std::vector<Compared>& all) {
  Compared test = std::move(all.back());
  all.pop_back();
  for (Compared& reference : all) condense_with_lent(reference, stop);
  test.lent = lent_by(all, channels);
  lend_neighbour_scatter(all, test);
  condense_with_lent(test, stop);
  all.push_back(std::move(test));
  std::map<Channel, Lent> lent = lent_by(all, channels);
  lend_scatter_of_difference(all, lent);
  for (Compared& one : all) {
    if (!one.lacks_replicates()) continue;
    one.lent = lent;
    condense_with_lent(one, stop);
  }
  pool_noise(all);
  for (Compared& one : all) lend_doubt(one);
}

std::string foreign_passes_note(int runs) {
  return fmt::format(
      "{} runs are of a pass that no reference drove and are not compared: another pass is no "
      "difference between two series; alone against the reference it would be compared",
      runs);
}

}  // namespace

std::string not_compared(const std::vector<Channel>& test,
                         const std::vector<std::vector<Channel>>& references) {
  std::string text;
  for (const Channel channel : test) {
    if (!all_have(references, channel))
      text += fmt::format("{}{}", text.empty() ? "" : ", ", name(channel));
  }
  return text.empty() ? text : "not compared, as a reference lacks it: " + text;
}

ComparedRecordings read_alike(const Recording& test, const DiagnosisSetup& setup,
                              const std::vector<Reference>& references,
                              const std::stop_token& stop) {
  const std::vector<std::vector<Channel>> of_references = channels_of(references);
  const std::vector<Channel> channels = common_channels(test.channels, of_references);
  ComparedRecordings compared{.recording = restricted(test, channels)};
  const int foreign = leave_foreign_passes_out(references, compared.recording);
  std::vector<Compared> all;
  for (const Reference& reference : references) {
    all.push_back({reference.name, restricted(reference.recording, channels), reference.setup});
  }
  all.push_back({"", compared.recording, setup});
  condense_alike(channels, stop, all);
  compared.test = std::move(all.back().condensed);
  all.pop_back();
  for (Compared& reference : all) compared.references.push_back(std::move(reference.condensed));
  compared.notes = test.warnings;
  compared.notes.insert(compared.notes.end(), compared.test.notes.begin(),
                        compared.test.notes.end());
  const std::string apart = not_compared(test.channels, of_references);
  if (!apart.empty()) compared.notes.push_back(apart);
  if (foreign > 0) compared.notes.push_back(foreign_passes_note(foreign));
  return compared;
}

}  // namespace regoplan
