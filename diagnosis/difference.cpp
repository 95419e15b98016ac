#include "diagnosis/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "diagnosis/checks/location.h"
#include "diagnosis/checks/shared_shortcomings.h"
#include "diagnosis/fit/unnamed_correction.h"
#include "diagnosis/names/capped_contest.h"
#include "diagnosis/names/claim.h"
#include "diagnosis/names/correction.h"
#include "diagnosis/names/name_share.h"
#include "diagnosis/names/next_experiment.h"
#include "diagnosis/names/partial_claim.h"
#include "diagnosis/recording/thresholds.h"
#include "diagnosis/stages.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

constexpr std::size_t kFewestToCompare = 3;
constexpr int kWorlds = 79;  // nameless differences

/// The test and what it is compared with, under one setting of the base model.
struct Treatment {
  SharedBase base = SharedBase::kPriorMeans;
  Eigen::VectorXd measured, shared, noise_variance;
  std::unique_ptr<CalibratedRecording> calibrated;
  LackOfFit lack;
  std::unique_ptr<CappedContest> contest;
  std::vector<CappedName> names;

  const CappedName* find(const std::string& id) const {
    const auto found = std::ranges::find(names, id, &CappedName::id);
    return found == names.end() ? nullptr : &*found;
  }
};

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

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  int count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value * value;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

/// One run scatters alike on both: who has no replicates learns it from the other, as it is at the
/// lender's usual signal where it grows with that.
void lend_noise(const CondensedRecording& from, DiagnosisSetup& to) {
  for (std::size_t c = 0; c < from.noise.size(); ++c) {
    const ChannelNoise& noise = from.noise[c];
    if (noise.source == NoiseSource::kNeighbours) continue;
    to.noise_standard_deviation.try_emplace(
        noise.channel, run_deviation(noise, root_mean_square(from.adjusted[c])));
  }
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

class Differing {
 public:
  Differing(const Recording& test, const DiagnosisSetup& setup,
            const std::vector<Reference>& references, const DiagnosisOptions& options)
      : options_(options) {
    const std::vector<Channel> channels = common_channels(test, references);
    test_recording_ = restricted(test, channels);
    const int foreign = leave_foreign_passes_out(references, test_recording_);
    DiagnosisSetup test_setup = setup;
    for (const Reference& reference : references) {
      found_.references.push_back(reference.name);
      condense_reference(restricted(reference.recording, channels), reference);
      lend_noise(references_.back(), test_setup);
    }
    test_ = condense(test_recording_, test_setup, kFewestToCompare, options_.stop);
    std::vector<CondensedRecording*> all{&test_};
    for (CondensedRecording& reference : references_) all.push_back(&reference);
    pool_noise(all);
    lend_doubt(references_, setup.noise_standard_deviation, test_);
    found_.notes = test.warnings;
    found_.notes.insert(found_.notes.end(), test_.notes.begin(), test_.notes.end());
    if (test.channels.size() > channels.size()) {
      found_.notes.push_back("channels that the reference lacks are not compared");
    }
    if (foreign > 0) {
      found_.notes.push_back(
          fmt::format("{} runs are of a pass that no reference drove and are not compared: another "
                      "pass is no difference between two series; alone against the reference it "
                      "would be compared",
                      foreign));
    }
    choose_effects(setup, references);
  }

  Diagnosis run() {
    return run_stages(found_, complete_, [&] { find(); });
  }

 private:
  void find() {
    tell("taking off what test and reference share", 0.05);
    for (const SharedBase base :
         {SharedBase::kPriorMeans, SharedBase::kCalibrated, SharedBase::kSinkageImposed}) {
      treatments_.push_back(treat(base));
    }
    found_.before = primary().lack;
    found_.after = found_.before;
    complete_ = found_;
    const bool differ = std::ranges::all_of(
        treatments_, [](const Treatment& t) { return t.lack.f > t.lack.critical; });
    if (!differ) {
      found_.verdict = Verdict::kConsistent;
      no_name();
      complete_ = found_;
    } else {
      found_.where = locate(primary().calibrated->recording(),
                            primary().calibrated->remainder_of(primary().calibrated->base()),
                            options_.seed + 1);
      complete_ = found_;
      tell("scoring what may differ", 0.15);
      contest();
      found_.ranking = capped_ranking(primary().names, chance_p_);
      complete_ = found_;
      tell("proving it on held-out conditions", 0.8);
      decide();
      complete_ = found_;
      tell("choosing the next experiment", 0.95);
      if (found_.claims.empty() || !found_.claims.front().equivalent.empty()) propose_experiments();
    }
    tell("done", 1);
  }

  void tell(std::string_view what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }
  Treatment& primary() { return treatments_[static_cast<std::size_t>(SharedBase::kCalibrated)]; }

  void condense_reference(const Recording& recording, const Reference& reference) {
    DiagnosisSetup setup = reference.setup;
    for (const CondensedRecording& before : references_) lend_noise(before, setup);
    try {
      references_.push_back(condense(recording, setup, kFewestToCompare, options_.stop));
    } catch (const InputError& bad) {
      throw InputError(fmt::format("reference {}: {}", reference.name, bad.what()));
    }
  }

  /// What varies over both may be at work in either.
  void choose_effects(const DiagnosisSetup& setup, const std::vector<Reference>& references) {
    TestBed both = test_.bed;
    Recording columns = test_recording_;
    bool same_lugs = setup.lug_height_m.has_value();
    for (const CondensedRecording& reference : references_) {
      both.conditions.insert(both.conditions.end(), reference.bed.conditions.begin(),
                             reference.bed.conditions.end());
    }
    for (const Reference& reference : references) {
      columns.columns.pass = columns.columns.pass || reference.recording.columns.pass;
      same_lugs = same_lugs && reference.setup.lug_height_m == setup.lug_height_m;
    }
    effects_ = effects_for(both, columns, EffectsOf::kDifference);
    if (same_lugs) std::erase_if(effects_, [](const Effect& e) { return e.id == "grousers"; });
  }

  Treatment treat(SharedBase base) {
    DifferenceBed bed = difference_bed(test_, references_, base);
    Treatment treatment{.base = base,
                        .measured = std::move(bed.measured),
                        .shared = std::move(bed.shared),
                        .noise_variance = std::move(bed.noise_variance)};
    treatment.calibrated = std::make_unique<CalibratedRecording>(std::move(bed.test));
    const CalibratedRecording& calibrated = *treatment.calibrated;
    treatment.lack = lack_of_fit(calibrated.recording(), calibrated.remainder_of(calibrated.base()),
                                 options_.seed, Thresholds::kDifference_p);
    return treatment;
  }

  void contest() {
    for (Treatment& t : treatments_) {
      t.contest = std::make_unique<CappedContest>(*t.calibrated);
      t.names = t.contest->score(effects_, nullptr, options_.threads);
      tell("scoring what may differ", 0.2 + 0.15 * static_cast<double>(&t - treatments_.data()));
    }
    tell("simulating nameless differences", 0.6);
    reached_ =
        primary().contest->by_chance(primary().names, kWorlds, options_.seed + 2, options_.threads);
    found_.chance_nats = reached_by_chance(reached_);
    chance_p_ = chance_p();
  }

  /// Why an id is not claimed; empty where it is.
  std::string objection_to(const std::string& id) {
    for (const Treatment& t : treatments_) {
      const CappedName* name = t.find(id);
      if (name == nullptr) return "it has no forces";
      if (name->gain_nats < Thresholds::kOverRemainder_nats) {
        return fmt::format("with {} it gains {:.0f} nats over an unnamed remainder",
                           regoplan::name(t.base), name->gain_nats);
      }
      const NameShare share = name_share(*t.calibrated, name->fit, options_.threads);
      if (share.share.low < Thresholds::kWorthANameAlone) {
        return fmt::format("with {} it explains {:.0f} % of the held-out difference",
                           regoplan::name(t.base), 100 * share.share.low);
      }
      if (share.worsened) {
        return fmt::format("with {} it predicts {} worse", regoplan::name(t.base),
                           regoplan::name(*share.worsened));
      }
      if (t.base == SharedBase::kCalibrated) {
        const double p = chance_of(reached_, name->gain_nats, share.share.low);
        if (p > Thresholds::kByChance_p) {
          return fmt::format(
              "nameless differences let some name do as well with a probability of {:.2f}", p);
        }
      }
      std::string doubt = objection(t.calibrated->problem(), name->fit);
      if (!doubt.empty()) return doubt;
    }
    return "";
  }

  /// Ids by their gain over all treatments, the best first.
  std::vector<std::pair<double, std::string>> in_order() const {
    std::vector<std::pair<double, std::string>> order;
    for (const CappedName& name : treatments_.front().names) {
      double sum = 0;
      for (const Treatment& t : treatments_) {
        const CappedName* same = t.find(name.id);
        sum += same == nullptr ? -1e6 : same->gain_nats;
      }
      order.emplace_back(sum, name.id);
    }
    std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
    return order;
  }

  /// Whether somewhere an id comes as close to another as names must not.
  bool rivals(const std::string& id, const std::string& leader) const {
    return std::ranges::any_of(treatments_, [&](const Treatment& t) {
      const CappedName *a = t.find(id), *b = t.find(leader);
      return a != nullptr && b != nullptr &&
             a->gain_nats > b->gain_nats - Thresholds::kOverOthers_nats;
    });
  }

  void decide() {
    const auto order = in_order();
    NameClass claimed;
    for (const auto& [sum, id] : order) {
      const bool near = claimed.ids.empty()
                            ? id == order.front().second || rivals(id, order.front().second)
                            : rivals(id, claimed.ids.front());
      if (!near) continue;
      const std::string doubt = objection_to(id);
      if (doubt.empty()) {
        claimed.ids.push_back(id);
      } else if (claimed.ids.empty()) {
        found_.notes.push_back(fmt::format("{} is not claimed: {}", id, doubt));
      }
    }
    const std::string doubt = objection_to_class(claimed.ids);
    if (claimed.ids.empty() || !doubt.empty()) {
      if (!doubt.empty()) found_.notes.push_back(doubt);
      found_.verdict = Verdict::kUnexplained;
      no_name();
      return;
    }
    claim(claimed);
  }

  void claim(const NameClass& claimed) {
    Treatment& t = primary();
    PartialClaim partial =
        first_claim(*t.calibrated, t.names, claimed.ids, chance_p_, options_.threads);
    if (claimed.ids.size() == 1) {
      add_further_names(*t.calibrated, *t.contest, effects_, t.find(claimed.ids.front())->gain_nats,
                        options_.threads, partial);
    }
    const CandidateFit& fit = partial.fit;
    found_.names_added = steps_of(*t.calibrated, partial, options_.threads);
    found_.claims = std::move(partial.claims);
    found_.remainder_share = remainder_share(found_.claims);
    found_.after = lack_of_fit(t.calibrated->recording(), t.calibrated->remainder_of(fit),
                               options_.seed, Thresholds::kDifference_p);
    const bool whole_difference = found_.after.f <= found_.after.critical;
    found_.verdict = !whole_difference         ? Verdict::kPartly
                     : claimed.ids.size() == 1 ? Verdict::kNamed
                                               : Verdict::kClass;
    hand_out(fit);
  }

  /// How often nameless differences let some name do as well as the first.
  double chance_p() {
    const Treatment& t = primary();
    if (t.names.empty()) return 1;
    const NameShare share = name_share(*t.calibrated, t.names.front().fit, options_.threads);
    return chance_of(reached_, t.names.front().gain_nats, share.share.low);
  }

  void no_name() {
    if (found_.verdict == Verdict::kConsistent) {
      using Kind = Account::Kind;
      for (const Kind kind : {Kind::kNone, Kind::kParameters, Kind::kUnexplained}) {
        found_.ranking.push_back({Account{kind}.id(), kind == Kind::kNone ? 1.0 : 0.0, 0});
      }
    }
    found_.remainder_share = found_.verdict == Verdict::kUnexplained ? 1 : 0;
    hand_out(primary().calibrated->base());
  }

  void propose_experiments() {
    constexpr std::size_t kMostRivals = 4;
    std::vector<ScoredId> rivals;
    for (const CappedName& name : primary().names) {
      if (rivals.size() == kMostRivals) break;
      rivals.push_back(
          {.account = {.effects = {name.id}}, .score = name.gain_nats, .fit = name.fit});
    }
    found_.next_experiments = next_experiments(primary().calibrated->problem(), rivals);
  }

  /// Figures are of the difference; the model handed out is of the test as it was measured, with
  /// what it shares with the reference in its unnamed correction.
  void hand_out(const CandidateFit& fit) {
    Treatment& t = primary();
    const bool adds = found_.verdict != Verdict::kConsistent;
    const CalibratedRecording& difference = *t.calibrated;
    const CandidateFit* claimed = fit.candidate.effects.empty() ? nullptr : &fit;
    const HeldOut proof = difference.held_out({.fit = claimed}, options_.threads);
    found_.fit = proof.fit;
    found_.held_out_by = proof.families.by;
    found_.share_explained = proof.share_explained;
    CondensedRecording whole = difference.recording();
    restore(t, whole);
    const CalibratedRecording measured(std::move(whole));
    const std::vector<std::size_t> left = remainder_settings(measured.problem(), fit);
    const CorrectedModel model{.fit = claimed, .remainder = left};
    const HeldOut of_test = measured.held_out(model, options_.threads);
    Correction correction = correction_by(measured, fit, left, of_test, options_.threads);
    if (!correction.refused.empty() && adds) {
      found_.notes.push_back("the corrected model is the base model: " + correction.refused);
    }
    found_.corrected_model = std::move(correction.model);
    found_.corrected_soil = correction.soil;
    found_.residuals = std::move(correction.residuals);
  }

  /// Puts back what the references share.
  static void restore(const Treatment& t, CondensedRecording& recording) {
    TestBed& bed = recording.bed;
    for (std::size_t c = 0; c < bed.channels.size(); ++c) {
      ChannelData& data = bed.channels[c];
      const Eigen::Index from = bed.offset(c), n = data.mean.size();
      data.mean = t.measured.segment(from, n);
      data.noise = t.noise_variance.segment(from, n).asDiagonal();
      for (Eigen::Index i = 0; i < n; ++i) {
        const std::size_t k = data.conditions[static_cast<std::size_t>(i)];
        for (const std::size_t run : bed.conditions[k].runs) {
          recording.adjusted[c][run] += t.shared[from + i];
        }
      }
    }
  }

  const DiagnosisOptions& options_;
  Recording test_recording_;
  CondensedRecording test_;
  std::vector<CondensedRecording> references_;
  std::vector<Effect> effects_;
  std::vector<Treatment> treatments_;
  std::vector<ByChance> reached_;  // by names in nameless differences, the soil calibrated
  double chance_p_ = 1;            // that such differences let some name do as well as the first
  Diagnosis found_;
  Diagnosis complete_;  // the stages of it that are
};

}  // namespace

Diagnosis diagnose_difference(const Recording& test, const DiagnosisSetup& setup,
                              const std::vector<Reference>& references,
                              const DiagnosisOptions& options) {
  if (options.progress) options.progress("reading test and reference alike", 0.02);
  try {
    return Differing(test, setup, references, options).run();
  } catch (const Interrupted&) {  // before test and references could be compared
    return undecided(test);
  }
}

}  // namespace regoplan
