#include "diagnosis/findings/sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "diagnosis/findings/gain_unit.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

struct Quantity {
  std::string words;
  std::string unit;
  double per_file_unit = 1;
};

Quantity quantity_of(Channel channel) {
  switch (channel) {
    case Channel::kFx:
      return {"drawbar pull", "N"};
    case Channel::kFy:
      return {"side force", "N"};
    case Channel::kTorque:
      return {"torque", "N m"};
    case Channel::kSinkage:
      return {"sinkage", "mm", 1000};
    case Channel::kRutLeft:
      return {"left rut depth", "mm", 1000};
    case Channel::kRutRight:
      return {"right rut depth", "mm", 1000};
  }
  return {};
}

/// What columns of conditions are called; others go by their own names.
Quantity quantity_of(const std::string& column) {
  static const std::map<std::string, Quantity> kWords{
      {"slip_ratio", {"slip ratio", ""}},
      {"slip_angle_deg", {"slip angle", "deg"}},
      {"abs_slip_angle_deg", {"slip angle to either side", "deg"}},
      {"load_n", {"load", "N"}},
      {"speed_mps", {"speed", "m/s"}},
      {"position_m", {"position", "m"}},
      {"time_s", {"time", "s"}},
      {"day", {"day", ""}},
      {"warm_up", {"what is left of a warm-up", ""}},
      {"after_slip_ratio", {"slip ratio of the run before", ""}},
      {"after_load_n", {"load of the run before", "N"}}};
  const auto known = kWords.find(column);
  return known == kWords.end() ? Quantity{column, ""} : known->second;
}

/// In minutes, hours or days what took longer than two of them.
Quantity time_in_its_unit(const Quantity& seconds, double longest_s) {
  constexpr double kMinute_s = 60, kHour_s = 60 * kMinute_s, kDay_s = 24 * kHour_s;
  if (longest_s > 2 * kDay_s) return {seconds.words, "days", 1 / kDay_s};
  if (longest_s > 2 * kHour_s) return {seconds.words, "h", 1 / kHour_s};
  if (longest_s > 2 * kMinute_s) return {seconds.words, "min", 1 / kMinute_s};
  return seconds;
}

/// "slip ratio 0.3 to 0.8".
std::string range_words(const std::string& column, double from, double to) {
  if (column == "run_order") {  // runs count from 1, as the rows of the recording do
    return fmt::format("run {:.0f} to {:.0f}", std::ceil(from) + 1, std::floor(to) + 1);
  }
  if (column == "on_day") return fmt::format("day {:.0f} of the recording", from);
  Quantity quantity = quantity_of(column);
  if (quantity.unit == "s") {
    quantity = time_in_its_unit(quantity, std::max(std::abs(from), std::abs(to)));
  }
  const auto number = [&](double value, int digits) {
    return fmt::format("{:.{}g}", quantity.per_file_unit * value, digits);
  };
  // Clocks and beds may begin far from zero, where three digits do not tell two edges apart.
  const bool begins_anywhere = column == "time_s" || column == "position_m";
  int digits = 3;
  while (begins_anywhere && to != from && digits < 17 &&
         number(from, digits) == number(to, digits)) {
    ++digits;
  }
  if (!begins_anywhere) {
    const auto ends = to_digits_of_the_larger(from, to);
    from = ends[0];
    to = ends[1];
  }
  const std::string first = number(from, digits), last = number(to, digits);
  std::string text = fmt::format("{} {}", quantity.words, first);
  if (last != first) text += fmt::format(" to {}", last);
  return quantity.unit.empty() ? text : fmt::format("{} {}", text, quantity.unit);
}

std::string region_words(const MismatchRegion& region) {
  std::string text;
  for (const auto& [column, range] : region.region) {
    text +=
        fmt::format("{}{}", text.empty() ? " at " : ", ", range_words(column, range[0], range[1]));
  }
  return text;
}

/// "Sinkage lies 6.05 mm (95 %: 5.79 to 6.3) above the calibrated model at slip ratio 0.65".
/// \param beside what the measured is held against
std::string mismatch_words(const MismatchRegion& region, std::string_view beside) {
  Quantity quantity = quantity_of(region.channel);
  quantity.words.front() = static_cast<char>(std::toupper(quantity.words.front()));
  const double up = region.effect < 0 ? -quantity.per_file_unit : quantity.per_file_unit;
  const auto [least, most] = std::minmax({up * region.ci95[0], up * region.ci95[1]});
  return fmt::format("{} lies {:.3g} {} (95 %: {:.3g} to {:.3g}) {} the {}{}", quantity.words,
                     up * region.effect, quantity.unit, least, most,
                     region.effect < 0 ? "below" : "above", beside, region_words(region));
}

std::string experiment_words(const Diagnosis& diagnosis) {
  if (diagnosis.next_experiments.empty()) return "";
  const Experiment& best = diagnosis.next_experiments.front();
  if (best.further_sensor) {
    return fmt::format(" Measure {} to decide.", quantity_of(*best.further_sensor).words);
  }
  std::string at;
  for (const auto& [column, value] : best.conditions) {
    at += fmt::format("{}{}", at.empty() ? "" : ", ", range_words(column, value, value));
  }
  return fmt::format(" To decide, measure at {}.", at);
}

/// "45 %"; what is nearly nothing or nearly all is not told as that.
std::string percent_words(double share) {
  constexpr double kRounds = 0.005;
  if (share > 0 && share < kRounds) return "under 1 %";
  if (share < 1 && share >= 1 - kRounds) return "over 99 %";
  return fmt::format("{:.0f} %", 100 * share);
}

std::string share_words(const Share& share) {
  std::string text = percent_words(share.explained);
  if (share.high - share.low > 0.02) {
    text += fmt::format(" ({:.0f} to {:.0f} % over ways to hold out)", 100 * share.low,
                        100 * share.high);
  }
  return text;
}

std::vector<std::string> names_of(const Claim& claim) {
  std::vector<std::string> names{claim.id};
  names.insert(names.end(), claim.equivalent.begin(), claim.equivalent.end());
  return names;
}

/// " (turned about z: turn_rad 0.17, std 0.01)" of a claim that stands alone.
std::string number_words(const Claim& claim) {
  if (!claim.equivalent.empty() || claim.form.empty()) return "";
  std::string numbers;
  for (const auto& [name, estimate] : claim.parameters) {
    if (estimate.standard_deviation <= 0) continue;  // known, not fitted
    numbers += fmt::format("{}{} {:.3g}, std {:.2g}", numbers.empty() ? ": " : "; ", name,
                           estimate.value, estimate.standard_deviation);
  }
  const std::string unit = unit_of_gain(claim);
  if (!unit.empty()) numbers += fmt::format("; is it in {}?", unit);
  return fmt::format(" ({}{})", claim.form, numbers);
}

/// "slip_sinkage explains 45 %; max_stress_angle or rear_contact explains 30 %".
std::string partial_words(const Diagnosis& diagnosis) {
  std::string what;
  for (const Claim& claim : diagnosis.claims) {
    what += fmt::format("{}{} explains {} of it", what.empty() ? "" : "; ",
                        list_of(names_of(claim)), share_words(claim.share.value_or(Share{})));
  }
  return what + fmt::format("; {} has no name.", percent_words(diagnosis.remainder_share));
}

/// What the mismatch is to the measured: one of the model, or one between two recordings.
std::string against(const Diagnosis& diagnosis) {
  return diagnosis.references.empty() ? "mismatch" : "difference from the reference";
}

/// "noise", and where nobody told it, whence it comes.
std::string noise_words(const Diagnosis& diagnosis) {
  if (diagnosis.guessed_noise.empty()) return "noise";
  std::string channels;
  for (const Channel channel : diagnosis.guessed_noise) {
    channels += fmt::format("{}{}", channels.empty() ? "" : ", ", name(channel));
  }
  return "noise, which is guessed from neighbouring conditions for " + channels;
}

/// Whose soil number was pulled most, and how far.
std::string parameters_words(const Diagnosis& diagnosis) {
  std::string text =
      "Other soil numbers explain the recording to within its " + noise_words(diagnosis);
  const auto worst = std::ranges::max_element(
      diagnosis.soil, {}, [](const SoilPull& one) { return std::abs(one.pull); });
  if (worst != diagnosis.soil.end()) {
    text += fmt::format(" (most: {} {:.4g} instead of {:.4g}, {:+.1f} prior standard deviations)",
                        worst->parameter, worst->calibrated.value, worst->prior.value, worst->pull);
  }
  const bool is_far =
      worst != diagnosis.soil.end() && std::abs(worst->pull) > Thresholds::kSuspectPull;
  if (diagnosis.suspects.empty() || !is_far) {
    if (diagnosis.suspects.empty() && diagnosis.support.tests == PlainModel::kHolds) {
      return text + "; no physics is missing that these data could show.";
    }
    text +=
        "; what stands out beside it proves nothing on held-out conditions and is taken for "
        "chance (see the notes)";
    if (diagnosis.suspects.empty()) return text + ".";
    return text + "; nearest to a name: " + list_of(diagnosis.suspects) + ".";
  }
  return text +
         "; a number that far from its tests is no clean bill: " + list_of(diagnosis.suspects) +
         " would do instead.";
}

/// The names of the claims, and what they leave.
std::string named_words(const Diagnosis& diagnosis) {
  std::string what;
  for (const Claim& claim : diagnosis.claims) {
    what += fmt::format("{}{}, {}{}", what.empty() ? "" : "; and ", list_of(names_of(claim)),
                        probability_words(claim.probability), number_words(claim));
  }
  const bool is_rough = std::ranges::all_of(diagnosis.claims, [](const Claim& claim) {
    return claim.probability <= Thresholds::kRoughName;
  });
  std::string text =
      is_rough
          ? what + " fits best, and leaves so much that something on no list may do it instead."
          : "the data say " + what + ".";
  if (diagnosis.correction_refused) {
    return text + " Named, but the corrected model leaves it out (see the notes).";
  }
  if (!diagnosis.excess_is_clear) return text;
  constexpr double kTold = 0.1;
  // What the table of shares says as well, where there is one.
  if (std::ranges::any_of(diagnosis.claims, [](const Claim& claim) { return !!claim.share; })) {
    if (diagnosis.remainder_share <= kTold) return text;
    return text + fmt::format(" {:.0f} % of the excess misfit on held-out conditions has no name.",
                              100 * diagnosis.remainder_share);
  }
  const double left = 1 - diagnosis.share_explained;
  if (left <= kTold) return text;
  return text + fmt::format(
                    " Named, but the corrected model leaves {:.0f} % of the excess misfit on "
                    "held-out conditions.",
                    100 * std::min(left, 1.0));
}

/// A constant drag adds to the torque of every run what a zero adds, on whatever soil.
std::string lifted_wheel_words() {
  return " To decide, lift the wheel and read its torque at rest and turning: a bias is there at "
         "rest too, a bearing drags only while it turns.";
}

/// What would part names that fit alike; empty where there are none.
std::string class_words(const Diagnosis& diagnosis) {
  const bool apart = std::ranges::all_of(
      diagnosis.claims, [](const Claim& claim) { return claim.equivalent.empty(); });
  if (apart) return "";
  const bool is_zero_or_drag = std::ranges::any_of(diagnosis.claims, [](const Claim& claim) {
    return claim.is_of("sensor_bias") && claim.is_of("bearing_drag");
  });
  return " These data cannot tell the names apart." +
         (is_zero_or_drag ? lifted_wheel_words() : experiment_words(diagnosis));
}

/// Where the run before is all that replicates tell beside the soil.
std::string bed_memory_words() {
  return "replicates follow what the run before left in the bed (see the notes), and no name on "
         "the list does that; beside it nothing is missing that these data could show. The "
         "corrected model is the calibrated one, for a bed as it was in the mean. To decide, "
         "prepare the bed anew before each run.";
}

/// Names that are likelier than all else, the first by a third and more and others half as likely,
/// are not denied, though they are not claimed.
std::string nameless_words(const Diagnosis& diagnosis) {
  constexpr double kNear = 1.0 / 3;
  const std::vector<std::string> none{"unexplained", "parameters", "none"};
  std::vector<std::string> nearest;
  for (const ScoredCandidate& one : diagnosis.ranking) {
    const double least = nearest.empty() ? kNear : diagnosis.ranking.front().probability / 2;
    if (one.probability < least || std::ranges::find(none, one.id) != none.end()) break;
    nearest.push_back(one.id);
  }
  if (nearest.empty()) return "no known name explains it";
  return fmt::format("no known name stands (nearest: {})", list_of(nearest));
}

}  // namespace

std::string probability_words(double probability) {
  return probability > 0.99 ? "over 99 %" : fmt::format("{:.0f} %", 100 * probability);
}

namespace {

std::string no_difference_words(double p_value) {
  if (p_value >= Thresholds::kConsistent_p) {
    return "The recording and its reference do not differ beyond their noise.";
  }
  return fmt::format(
      "The recording and its reference may differ (p = {:.2g}), but not by as much as proves it.",
      p_value);
}

/// What the places of a mismatch are off.
std::string_view held_against(const Diagnosis& diagnosis) {
  switch (diagnosis.where_off) {
    case WhereOff::kCalibratedModel:
      return "calibrated model";
    case WhereOff::kSoilBesideClaim:
      return "model with its soil fitted beside the claim";
    case WhereOff::kReference:
      return "reference";
  }
  return "";
}

std::string words_of(const Diagnosis& diagnosis) {
  std::string where;
  if (!diagnosis.where.empty()) {
    where = mismatch_words(diagnosis.where.front(), held_against(diagnosis)) + "; ";
  }
  switch (diagnosis.verdict) {
    case Verdict::kConsistent:
      if (!diagnosis.references.empty()) return no_difference_words(diagnosis.before.p_value);
      return "The recording agrees with the model at the prior soil numbers: nothing beyond " +
             noise_words(diagnosis) + ".";
    case Verdict::kParameters:
      return parameters_words(diagnosis);
    case Verdict::kNamed:
    case Verdict::kClass:
      return where + named_words(diagnosis) + class_words(diagnosis);
    case Verdict::kPartly:
      return where + "part of the " + against(diagnosis) +
             " has a name: " + partial_words(diagnosis) + class_words(diagnosis);
    case Verdict::kUnexplained:
      if (diagnosis.only_bed_memory) return where + bed_memory_words();
      return where + "the " + against(diagnosis) + " is real and " + nameless_words(diagnosis) +
             "; it is modelled without a name, within the conditions measured only." +
             experiment_words(diagnosis);
    case Verdict::kUndecided:
      return "The diagnosis was interrupted before it had a verdict.";
  }
  return "";
}

}  // namespace

std::array<double, 2> to_digits_of_the_larger(double from, double to) {
  const double larger = std::max(std::abs(from), std::abs(to));
  if (!std::isfinite(larger) || larger == 0) return {from, to};
  constexpr int kDigits = 3;
  const double unit = std::pow(10, kDigits - 1 - std::floor(std::log10(larger)));
  const auto rounded = [unit](double value) { return std::round(value * unit) / unit + 0.0; };
  return {rounded(from), rounded(to)};
}

std::string sentence_of(const Diagnosis& diagnosis) {
  std::string text = words_of(diagnosis);
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(text.front()));
  return text;
}

}  // namespace regoplan
