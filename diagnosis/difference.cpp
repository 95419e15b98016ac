#include "diagnosis/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <map>
#include <memory>

#include "diagnosis/bed/compared_recordings.h"
#include "diagnosis/checks/location.h"
#include "diagnosis/checks/shared_shortcomings.h"
#include "diagnosis/fit/effect_list.h"
#include "diagnosis/model_of_test.h"
#include "diagnosis/names/capped_contest.h"
#include "diagnosis/names/claim.h"
#include "diagnosis/names/name_share.h"
#include "diagnosis/names/next_experiment.h"
#include "diagnosis/names/partial_claim.h"
#include "diagnosis/proven_difference.h"
#include "diagnosis/recording/thresholds.h"
#include "diagnosis/run_differences.h"
#include "diagnosis/stages.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// The test and what it is compared with, under one setting of the base model.
struct Treatment {
  SharedBase base = SharedBase::kPriorMeans;
  MeasuredTest measured;
  std::unique_ptr<CalibratedRecording> calibrated;
  LackOfFit lack;
  std::unique_ptr<CappedContest> contest;
  std::vector<CappedName> names;
  std::map<std::string, NameShare> shares;  // of those that were asked for

  const NameShare& share_of(const CappedName& name, int threads) {
    const auto known = shares.find(name.id);
    if (known != shares.end()) return known->second;
    return shares.emplace(name.id, name_share(*calibrated, name.fit, threads)).first->second;
  }

  const CappedName* find(std::string_view id) const {
    const auto found = std::ranges::find(names, id, &CappedName::id);
    return found == names.end() ? nullptr : &*found;
  }
};

constexpr std::string_view kLugs = "grousers";

/// Standard errors that stand out among so many looks as two do in one (Bonferroni).
double clear_errors_among(std::size_t looks) {
  const boost::math::normal standard;
  const double tail =
      boost::math::cdf(boost::math::complement(standard, Thresholds::kClear_errors));
  return boost::math::quantile(
      boost::math::complement(standard, tail / static_cast<double>(looks)));
}

class Differing {
 public:
  Differing(const Recording& test, const DiagnosisSetup& setup,
            const std::vector<Reference>& references, const DiagnosisOptions& options)
      : options_(options), compared_(read_alike(test, setup, references, options.stop)) {
    for (const Reference& reference : references) found_.references.push_back(reference.name);
    found_.notes = compared_.notes;
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
    const bool alike =
        std::ranges::any_of(treatments_, [](const Treatment& t) { return !is_proven(t.lack); });
    if (alike) {
      consistent();
      complete_ = found_;
    } else {
      found_.where_off = WhereOff::kReference;
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

  /// What varies over both may be at work in either.
  void choose_effects(const DiagnosisSetup& setup, const std::vector<Reference>& references) {
    TestBed both = compared_.test.bed;
    Recording columns = compared_.recording;
    bool same_lugs = setup.lug_height_m.has_value(), told_lugs = same_lugs;
    for (const CondensedRecording& reference : compared_.references) {
      both.conditions.insert(both.conditions.end(), reference.bed.conditions.begin(),
                             reference.bed.conditions.end());
    }
    for (const Reference& reference : references) {
      columns.columns.pass = columns.columns.pass || reference.recording.columns.pass;
      same_lugs = same_lugs && reference.setup.lug_height_m == setup.lug_height_m;
      told_lugs = told_lugs && reference.setup.lug_height_m.has_value();
    }
    effects_ = effects_for(both, columns, EffectsOf::kDifference);
    if (same_lugs) std::erase_if(effects_, [](const Effect& e) { return e.id == kLugs; });
    lugs_differ_ = told_lugs && !same_lugs;
  }

  Treatment treat(SharedBase base) {
    DifferenceBed bed = difference_bed(compared_.test, compared_.references, base);
    Treatment treatment{.base = base, .measured = std::move(bed.measured)};
    treatment.calibrated = std::make_unique<CalibratedRecording>(std::move(bed.test));
    const CalibratedRecording& calibrated = *treatment.calibrated;
    treatment.lack = lack_of_difference(calibrated, calibrated.base(), options_.seed);
    return treatment;
  }

  void contest() {
    for (Treatment& t : treatments_) {
      t.contest = std::make_unique<CappedContest>(*t.calibrated);
      t.names = t.contest->score(effects_, nullptr, options_.threads);
      for (CappedName& name : t.names) {
        if (lugs_differ_ && name.id == kLugs) name.prior_nats = Thresholds::kTold_nats;
      }
      std::ranges::stable_sort(t.names, std::greater{}, posterior_nats);
      tell("scoring what may differ", 0.2 + 0.15 * static_cast<double>(&t - treatments_.data()));
    }
    tell("simulating nameless differences", 0.6);
    const auto reached_by = [&](const std::vector<CappedName>& names) {
      return nats_by_chance(*primary().calibrated, *primary().contest, names, options_.seed + 2,
                            options_.threads);
    };
    any_by_chance_ = reached_by(primary().names);
    const CappedName* lugs = primary().find(kLugs);
    if (lugs_differ_ && lugs != nullptr) {
      lugs_by_chance_ = reached_by({*lugs});
      found_.notes.push_back(
          "test and reference tell different lugs: whether chance does as well as grousers is "
          "asked of grousers alone, not of the best of all names");
    }
    if (primary().names.empty()) return;
    const CappedName& first = primary().names.front();
    found_.chance_nats = reached_by_chance(by_chance(first.id));
    chance_p_ = nameless_p(first);
  }

  /// That a difference without a name lets some name do as well as this one. Odds that are told
  /// beforehand of the name are odds against one without any, too.
  double nameless_p(const CappedName& name) const {
    const double p = chance_of(by_chance(name.id), name.over_unexplained_nats);
    return p / (p + (1 - p) * std::exp(name.prior_nats));
  }

  /// Over a difference without a name, in worlds where it has none: of the best of all names, or of
  /// one that is told beforehand to differ.
  const std::vector<double>& by_chance(const std::string& id) const {
    return id == kLugs && !lugs_by_chance_.empty() ? lugs_by_chance_ : any_by_chance_;
  }

  /// Why an id is not claimed; empty where it is.
  std::string objection_to(const std::string& id) {
    for (Treatment& t : treatments_) {
      const CappedName* name = t.find(id);
      if (name == nullptr) return "it has no forces";
      if (posterior_nats(*name) < Thresholds::kDifferenceOverRemainder_nats) {
        return fmt::format("with {} it gains {:.0f} nats over an unnamed remainder",
                           regoplan::name(t.base), name->gain_nats);
      }
      const NameShare& share = t.share_of(*name, options_.threads);
      if (share.share.low < Thresholds::kWorthANameAlone) {
        return fmt::format("with {} it explains {:.0f} % of the held-out difference",
                           regoplan::name(t.base), 100 * share.share.low);
      }
      if (share.worsens(
              clear_errors_among(treatments_.size() * t.calibrated->bed().channels.size()))) {
        return fmt::format("with {} it predicts {} worse by {:.1f} standard errors",
                           regoplan::name(t.base), regoplan::name(share.loss.channel),
                           share.loss.errors);
      }
      std::string doubt = objection(t.calibrated->problem(), name->fit);
      if (!doubt.empty()) return doubt;
    }
    return "";
  }

  /// Why names that fit alike are not claimed; empty where they are. What makes one of them more
  /// than chance makes the class: its others are not denied for doing a little less.
  std::string objection_to_names(const std::vector<std::string>& ids) {
    double p = 1;
    for (const std::string& id : ids) {
      p = std::min(p, nameless_p(*primary().find(id)));
    }
    if (p > Thresholds::kByChance_p) {
      return fmt::format(
          "{}: nameless differences let some name do as well with a probability of {:.2f}",
          fmt::join(ids, " or "), p);
    }
    const bool leave_nothing = !is_proven(left_by(primary().find(ids.front())->fit));
    const std::string doubt = objection_to_class(ids, leave_nothing);
    return doubt.empty() ? likelier_than(ids, found_.ranking) : doubt;
  }

  /// Ids by their gain over all treatments, the best first.
  std::vector<std::pair<double, std::string>> in_order() const {
    std::vector<std::pair<double, std::string>> order;
    for (const CappedName& name : treatments_.front().names) {
      double sum = 0;
      for (const Treatment& t : treatments_) {
        const CappedName* same = t.find(name.id);
        sum += same == nullptr ? -1e6 : posterior_nats(*same);
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
             posterior_nats(*a) > posterior_nats(*b) - Thresholds::kOverOthers_nats;
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
    if (!claimed.ids.empty()) {
      const std::string doubt = objection_to_names(claimed.ids);
      if (doubt.empty()) return claim(claimed);
      found_.notes.push_back(doubt);
    }
    found_.verdict = Verdict::kUnexplained;
    no_name();
  }

  /// The names claimed, and where they are one what else is at work beside it, in one setting.
  PartialClaim claim_under(const Treatment& t, const std::vector<std::string>& ids) const {
    PartialClaim claim = first_claim(*t.calibrated, t.names, ids, chance_p_, options_.threads);
    if (ids.size() == 1) {
      add_further_names(*t.calibrated, *t.contest, effects_, t.find(ids.front())->gain_nats,
                        options_.threads, claim);
    }
    return claim;
  }

  /// Takes back further names that another setting of the base model does not add.
  void keep_what_all_add(const std::vector<std::string>& ids, PartialClaim& claim) {
    for (const Treatment& t : treatments_) {
      if (claim.claims.size() == 1) return;
      if (&t == &primary()) continue;
      const PartialClaim other = claim_under(t, ids);
      const auto stands = [&](const Claim& one) {
        return std::ranges::any_of(other.claims, [&](const Claim& c) { return c.is_of(one.id); });
      };
      const auto first_to_fall = std::ranges::find_if_not(claim.claims, stands);
      const auto kept = static_cast<std::size_t>(first_to_fall - claim.claims.begin());
      claim.claims.resize(kept);
      claim.steps.resize(kept);
      claim.fit = claim.steps.back();
    }
  }

  void claim(const NameClass& claimed) {
    Treatment& t = primary();
    PartialClaim partial = claim_under(t, claimed.ids);
    keep_what_all_add(claimed.ids, partial);
    const CandidateFit& fit = partial.fit;
    found_.names_added = steps_of(*t.calibrated, partial, options_.threads);
    found_.claims = std::move(partial.claims);
    found_.remainder_share = remainder_share(found_.claims);
    found_.after = left_by(fit);
    const bool leaves_part = leaves_a_part(found_.after, found_.claims);
    found_.verdict = leaves_part               ? Verdict::kPartly
                     : claimed.ids.size() == 1 ? Verdict::kNamed
                                               : Verdict::kClass;
    if (!leaves_part && is_proven(found_.after)) tell_little_left();
    hand_out(fit);
  }

  void tell_little_left() {
    found_.notes.push_back(fmt::format(
        "what is claimed leaves more than noise does (p = {:.2g}), but less than {:.0f} % of the "
        "difference: too little for a part without a name",
        found_.after.p_value, std::floor(100 * found_.remainder_share) + 1));
  }

  LackOfFit left_by(const CandidateFit& fit) {
    return lack_of_difference(*primary().calibrated, fit, options_.seed);
  }

  /// No difference is proven: how likely none is goes by the setting that lets them differ least.
  void consistent() {
    using Kind = Account::Kind;
    found_.verdict = Verdict::kConsistent;
    const auto least = std::ranges::max_element(treatments_, {},
                                                [](const Treatment& t) { return t.lack.p_value; });
    found_.before = found_.after = least->lack;
    const double p = least->lack.p_value;
    if (p < Thresholds::kConsistent_p) {
      found_.notes.push_back(
          fmt::format("test and reference may differ: p = {:.2g} with {}, where they differ least; "
                      "a difference is told below {}, and more runs would decide",
                      p, regoplan::name(least->base), Thresholds::kDifference_p));
    }
    const double none = probability_of_no_difference(p);
    found_.ranking = {{Account{Kind::kNone}.id(), none, 0},
                      {Account{Kind::kUnexplained}.id(), 1 - none, 0},
                      {Account{Kind::kParameters}.id(), 0, 0}};
    no_name();
  }

  void no_name() {
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
    found_.excess_is_clear = has_clear_excess(difference.bed(), proof);
    found_.differences = run_differences(difference, fit);
    Correction correction = model_of_test(difference, t.measured, fit, proof, options_.threads);
    if (!correction.refused.empty() && adds) {
      found_.notes.push_back("the corrected model is the base model: " + correction.refused);
    }
    if (!correction.carried.empty()) found_.notes.push_back(correction.carried);
    found_.corrected_model = std::move(correction.model);
    found_.corrected_soil = correction.soil;
    found_.soil = std::move(correction.soil_pulls);
    tell_pulls();
    found_.residuals = std::move(correction.residuals);
  }

  void tell_pulls() {
    std::string pulls;
    for (const SoilPull& one : found_.soil) {
      if (std::abs(one.pull) <= Thresholds::kSuspectPull) continue;
      pulls += fmt::format("{}{} by {:.1f}", pulls.empty() ? "" : ", ", one.parameter,
                           std::abs(one.pull));
    }
    if (pulls.empty()) return;
    found_.notes.push_back(
        fmt::format("fitted to the reference, the soil lies off its tests ({} of their standard "
                    "deviations): it "
                    "may stand for physics that both recordings lack",
                    pulls));
  }

  const DiagnosisOptions& options_;
  ComparedRecordings compared_;
  std::vector<Effect> effects_;
  std::vector<Treatment> treatments_;
  bool lugs_differ_ = false;           // as test and references tell
  std::vector<double> any_by_chance_;  // of the best name in nameless differences
  std::vector<double> lugs_by_chance_;
  double chance_p_ = 1;  // that such differences let some name do as well as the first
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
