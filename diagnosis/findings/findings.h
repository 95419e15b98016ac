#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/recording/recording.h"
#include "terramech/mechanisms/generic_correction.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

enum class Verdict {
  kConsistent,   ///< no lack of fit at the prior means
  kParameters,   ///< none after calibration, every pull within 4.5 prior standard deviations
  kNamed,        ///< by one name for each effect
  kClass,        ///< by names that these data cannot tell apart
  kUnexplained,  ///< a real mismatch that no name fits
  kPartly,       ///< by names, or a class, that stand beside an unnamed remainder
  kUndecided,    ///< interrupted before there was one
};

/// `consistent`, `parameters`, `named`, `class`, `unexplained`, `partly`, `undecided`.
std::string_view name(Verdict verdict);

struct Estimate {
  double value = 0;
  double standard_deviation = 0;
};

/// Part of the excess misfit on held-out conditions, and its range over ways to hold out.
struct Share {
  double explained = 0;
  double low = 0, high = 0;
};

/// One effect that the diagnosis claims.
struct Claim {
  std::string id;
  std::string form;        ///< the one that fits best; of instruments, the channels or how
  double probability = 0;  ///< of the class
  std::map<std::string, Estimate> parameters;
  std::vector<std::string> equivalent;  ///< further ids that these data cannot tell apart
  std::vector<Channel> channels;        ///< in which it shows
  double evidence_nats = 0;             ///< over the best score without it
  /// Beside a capped remainder: over a mismatch without a name.
  std::optional<double> over_unexplained_nats;
  std::optional<Share> share;  ///< that it adds to those before it, where there is an excess
  std::map<std::string, Share> member_shares;  ///< of a class: what each id explains in its place

  /// Whether `name` is among the ids that may be at work.
  bool is_of(const std::string& name) const {
    return name == id || std::ranges::find(equivalent, name) != equivalent.end();
  }
};

/// What the tests say of the calibrated model without any effect.
enum class PlainModel {
  kHolds,    ///< nothing speaks against it
  kDoubted,  ///< no lack of fit, but the misfit lies along some effect
  kRefuted,  ///< lack of fit, or soil numbers farther from their tests than can be
};

/// `holds`, `doubted`, `refuted`.
std::string_view name(PlainModel plain);

/// What speaks for a name before any is held out.
struct NameSupport {
  PlainModel tests = PlainModel::kHolds;  ///< before names were scored
  double best_gain_nats = 0;  ///< of the best name over other soil numbers, a pair's prior counted
  double log_odds = 0;        ///< of all that is not the plain model, no prior for that counted
};

struct ScoredCandidate {
  std::string id;  ///< of a mechanism, an instrument fault, `a+b`, `none`, `parameters`, ...
  double probability = 0;
  double evidence_nats = 0;  ///< log marginal likelihood over that of `parameters`
};

/// A part of the operating space in which measurement and fitted model differ.
struct MismatchRegion {
  Channel channel = Channel::kFx;
  std::map<std::string, std::array<double, 2>> region;  ///< column: from, to, in the file's unit
  double effect = 0;                                    ///< measured - model, the channel's unit
  std::array<double, 2> ci95{};
  double p_value = 1;
};

/// How well one channel fits on conditions held out of the fit.
struct ChannelFit {
  Channel channel = Channel::kFx;
  double noise_floor = 0;      ///< replicate scatter of those rows
  double baseline_rmse = 0;    ///< model at the prior means
  double calibrated_rmse = 0;  ///< soil numbers fitted
  double corrected_rmse = 0;   ///< and the claim's mechanisms, or the generic correction
};

/// Names added one by one, no remainder: what each further one makes of held-out conditions.
struct NameStep {
  std::string id;  ///< of the name that this step adds
  std::vector<ChannelFit> fit;
  double share_explained = 0;  ///< by the names so far
};

struct LackOfFit {
  double f = 0;
  double critical = 0;
  double p_value = 1;
  int degrees_of_freedom = 0;
  int pure_error_degrees_of_freedom = 0;
};

struct SoilPull {
  std::string parameter;  ///< key of the soil file
  Estimate prior;
  Estimate calibrated;  ///< without any mechanism
  Estimate corrected;   ///< with the claim; as calibrated where there is none
  double pull = 0;      ///< (calibrated - prior mean)/prior standard deviation
  double corrected_pull = 0;
};

struct Experiment {
  std::map<std::string, double> conditions;  ///< column: value in the file's unit
  std::optional<Channel> further_sensor;     ///< a channel that this recording lacks
  std::vector<std::string> separates;        ///< ids
  double expected_gain_nats = 0;
};

struct SmallestDetectable {
  std::string id;
  std::string parameter;
  double value = 0;          ///< amplitude that these data would have shown with 80 % power
  double low = 0, high = 0;  ///< usual range
  bool is_usual = true;      ///< such effects come so large
};

/// One row of the recording against the models, for pictures.
struct RunResidual {
  std::size_t run = 0;
  Channel channel = Channel::kFx;
  double measured = 0;
  double noise = 0;     ///< standard deviation
  double baseline = 0;  ///< model at the prior means
  double calibrated = 0;
  double corrected = 0;
  double held_out = 0;  ///< corrected model fitted without this row's family
  double held_out_standard_deviation = 0;
};

/// One row of the test less what the references share with it, the calibrated base model included.
struct RunDifference {
  std::size_t run = 0;
  Channel channel = Channel::kFx;
  double difference = 0;
  double standard_deviation = 0;  ///< of its condition's mean, what is shared included
  double by_names = 0;            ///< what the claims make of it, no remainder added
};

/// What the places of a mismatch are off.
enum class WhereOff {
  kCalibratedModel,
  kSoilBesideClaim,  ///< the model with its soil fitted beside what is claimed, which is left out
  kReference,
};
std::string_view name(WhereOff off);

/// Everything that a diagnosis finds.
struct Diagnosis {
  Verdict verdict = Verdict::kUndecided;
  std::string sentence;            ///< the finding, for a person
  std::vector<std::string> notes;  ///< signs, units, outliers, what was assumed
  std::vector<Claim> claims;
  std::vector<ScoredCandidate> ranking;  ///< sums to 1
  NameSupport support;
  std::vector<MismatchRegion> where;  ///< strongest first
  WhereOff where_off = WhereOff::kCalibratedModel;
  std::vector<ChannelFit> fit;
  std::string held_out_by;  ///< `slip_angle`, `slip band`, ...
  double share_explained = 0;
  bool excess_is_clear = false;  ///< of noise, on held-out conditions: a share of it says something
  bool correction_refused = false;  ///< none proved its worth: what is handed on has no name's part
  /// All that is unexplained is that replicates follow what the run before left in the bed.
  bool only_bed_memory = false;
  /// Channels whose noise neither replicates nor the setup tell, but neighbouring conditions.
  std::vector<Channel> guessed_noise = {};
  LackOfFit before, after;
  std::vector<SoilPull> soil;
  std::vector<Experiment> next_experiments;
  std::vector<SmallestDetectable> smallest_detectable;
  std::vector<RunResidual> residuals;
  std::vector<RunDifference> differences;  ///< with references only
  WheelModelSpec corrected_model;  ///< calibrated soil, the claim's mechanisms, or `generic`
  UncertainSoil corrected_soil;
  std::vector<NameStep> names_added;  ///< of the claims, first to last
  std::vector<std::string> suspects;  ///< names that would do instead of a soil number
  double remainder_share = 0;         ///< of the excess misfit, which the claims leave
  /// The over_unexplained_nats that one nameless world in forty lets some name reach; 0: not
  /// needed.
  double chance_nats = 0;
  std::vector<std::string> references;  ///< what the recording was compared with
  bool interrupted = false;
};

/// Whether some claim stands for names that do the same.
bool is_class(const std::vector<Claim>& claims);

/// `named` or `class`, of claims whose shares have been measured; `partly` where they clearly leave
/// more than names that stand beside a remainder may leave.
Verdict verdict_of_names(const Diagnosis& diagnosis);

/// A diagnosis that was interrupted before it had found anything.
Diagnosis undecided(const Recording& recording);

}  // namespace regoplan
