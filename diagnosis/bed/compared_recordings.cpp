#include "diagnosis/bed/compared_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

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

std::vector<Channel> common_channels(const Recording& test,
                                     const std::vector<Reference>& references) {
  std::vector<Channel> common;
  for (const Channel channel : test.channels) {
    const bool everywhere = std::ranges::all_of(references, [&](const Reference& reference) {
      return std::ranges::find(reference.recording.channels, channel) !=
             reference.recording.channels.end();
    });
    if (everywhere) common.push_back(channel);
  }
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

bool lacks_replicates(const ChannelNoise& noise) {
  return noise.source == NoiseSource::kNeighbours;
}

/// One run scatters alike on all: who has no replicates learns it from the others, as it is at
/// their usual signal where it grows with that, and as all of them together tell it.
/// \param borrower which of them borrows; none where it is not among them
void lend_noise(const std::vector<CondensedRecording>& from, std::optional<std::size_t> borrower,
                DiagnosisSetup& to) {
  struct Told {
    double weight = 0, variance = 0;
  };
  std::map<Channel, Told> told;
  for (std::size_t r = 0; r < from.size(); ++r) {
    if (r == borrower) continue;
    for (std::size_t c = 0; c < from[r].noise.size(); ++c) {
      const ChannelNoise& noise = from[r].noise[c];
      if (lacks_replicates(noise)) continue;
      const double weight = std::max(1, noise.degrees_of_freedom);
      told[noise.channel].weight += weight;
      told[noise.channel].variance +=
          weight * std::pow(usual_deviation(noise, from[r].adjusted[c]), 2);
    }
  }
  for (const auto& [channel, by] : told) {
    to.noise_standard_deviation.try_emplace(channel, std::sqrt(by.variance / by.weight));
  }
}

/// References condensed, each with the scatter of the others where it has no replicates.
std::vector<CondensedRecording> condensed(const std::vector<Reference>& references,
                                          const std::vector<Channel>& channels,
                                          const std::stop_token& stop) {
  const auto condensed_with = [&](const Reference& reference, const DiagnosisSetup& setup) {
    try {
      return condense(restricted(reference.recording, channels), setup, kFewestToCompare, stop);
    } catch (const InputError& bad) {
      throw InputError(fmt::format("reference {}: {}", reference.name, bad.what()));
    }
  };
  std::vector<CondensedRecording> alone;
  for (const Reference& reference : references) {
    alone.push_back(condensed_with(reference, reference.setup));
  }
  std::vector<CondensedRecording> all = alone;
  for (std::size_t r = 0; r < references.size(); ++r) {
    if (references.size() == 1 || std::ranges::none_of(alone[r].noise, lacks_replicates)) continue;
    DiagnosisSetup setup = references[r].setup;
    lend_noise(alone, r, setup);
    all[r] = condensed_with(references[r], setup);
  }
  return all;
}

/// The scatter of both together, where one of them by chance shows less.
void pool_noise(std::vector<CondensedRecording*> recordings) {
  for (std::size_t c = 0; c < recordings.front()->noise.size(); ++c) {
    double sum = 0, degrees = 0;
    for (const CondensedRecording* one : recordings) {
      const ChannelNoise& noise = one->noise[c];
      sum += noise.degrees_of_freedom * noise.constant * noise.constant;
      degrees += noise.degrees_of_freedom;
    }
    if (degrees == 0) continue;
    const double pooled = std::sqrt(sum / degrees);
    for (CondensedRecording* one : recordings) {
      ChannelNoise& noise = one->noise[c];
      if (noise.constant >= pooled) continue;
      const double factor = pooled / noise.constant;
      noise.constant *= factor;
      noise.proportional *= factor;
      noise.day_offset *= factor;
      noise.day_gain *= factor;
      one->bed.channels[c].noise *= factor * factor;
      one->bed.channels[c].scale *= factor;
    }
  }
}

/// Noise that was lent is known as well as the lender's replicates tell it, not exactly.
/// \param own noise that the test's setup itself states
void lend_doubt(const std::vector<CondensedRecording>& references,
                const std::map<Channel, double>& own, CondensedRecording& test) {
  for (ChannelNoise& noise : test.noise) {
    if (noise.source != NoiseSource::kSetup || own.contains(noise.channel)) continue;
    for (const CondensedRecording& reference : references) {
      const auto lender = std::ranges::find(reference.noise, noise.channel, &ChannelNoise::channel);
      if (lender == reference.noise.end()) continue;
      noise.degrees_of_freedom = std::max(noise.degrees_of_freedom, lender->degrees_of_freedom);
    }
  }
}

std::string foreign_passes_note(int runs) {
  return fmt::format(
      "{} runs are of a pass that no reference drove and are not compared: another pass is no "
      "difference between two series; alone against the reference it would be compared",
      runs);
}

}  // namespace

ComparedRecordings read_alike(const Recording& test, const DiagnosisSetup& setup,
                              const std::vector<Reference>& references,
                              const std::stop_token& stop) {
  const std::vector<Channel> channels = common_channels(test, references);
  ComparedRecordings compared{.recording = restricted(test, channels)};
  const int foreign = leave_foreign_passes_out(references, compared.recording);
  DiagnosisSetup test_setup = setup;
  compared.references = condensed(references, channels, stop);
  lend_noise(compared.references, std::nullopt, test_setup);
  compared.test = condense(compared.recording, test_setup, kFewestToCompare, stop);
  std::vector<CondensedRecording*> all{&compared.test};
  for (CondensedRecording& reference : compared.references) all.push_back(&reference);
  pool_noise(all);
  lend_doubt(compared.references, setup.noise_standard_deviation, compared.test);
  compared.notes = test.warnings;
  compared.notes.insert(compared.notes.end(), compared.test.notes.begin(),
                        compared.test.notes.end());
  if (test.channels.size() > channels.size()) {
    compared.notes.push_back("channels that the reference lacks are not compared");
  }
  if (foreign > 0) compared.notes.push_back(foreign_passes_note(foreign));
  return compared;
}

}  // namespace regoplan
