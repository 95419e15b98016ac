#include "diagnosis/sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

std::string experiment_words(const Diagnosis& diagnosis) {
  if (diagnosis.next_experiments.empty()) return "";
  const Experiment& best = diagnosis.next_experiments.front();
  if (best.further_sensor) {
    return fmt::format(" Measure {} to decide.", name(*best.further_sensor));
  }
  std::string at;
  for (const auto& [column, value] : best.conditions) {
    at += fmt::format("{}{} {:.3g}", at.empty() ? "" : ", ", column, value);
  }
  return fmt::format(" To decide, measure at {}.", at);
}

}  // namespace

std::string words_of(const MismatchRegion& region) {
  std::string text;
  for (const auto& [column, range] : region.region) {
    text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", column, range[0]);
    if (range[1] != range[0]) text += fmt::format(" to {:.3g}", range[1]);
  }
  return text.empty() ? "all conditions" : text;
}

std::string sentence_of(const Diagnosis& diagnosis) {
  std::string where;
  if (!diagnosis.where.empty()) {
    const MismatchRegion& worst = diagnosis.where.front();
    where = fmt::format(
        "{} differs from the calibrated model by {:+.3g} (95 %: {:.3g} to {:.3g}) "
        "at {}; ",
        name(worst.channel), worst.effect, worst.ci95[0], worst.ci95[1], words_of(worst));
  }
  switch (diagnosis.verdict) {
    case Verdict::kConsistent:
      return "The recording agrees with the model at the prior soil numbers: nothing beyond noise.";
    case Verdict::kParameters: {
      const auto worst = std::ranges::max_element(diagnosis.soil, [](const auto& a, const auto& b) {
        return std::abs(a.pull) < std::abs(b.pull);
      });
      std::string most;
      if (worst != diagnosis.soil.end()) {
        most =
            fmt::format(" (most: {} {:.4g} instead of {:.4g}, {:+.1f} prior standard deviations)",
                        worst->parameter, worst->calibrated.value, worst->prior.value, worst->pull);
      }
      return "Other soil numbers explain the recording to within its noise" + most +
             "; no physics is missing that these data could show.";
    }
    case Verdict::kNamed:
    case Verdict::kClass: {
      std::string what;
      for (const Claim& claim : diagnosis.claims) {
        std::vector<std::string> names{claim.id};
        names.insert(names.end(), claim.equivalent.begin(), claim.equivalent.end());
        what += fmt::format("{}{}, {:.0f} %", what.empty() ? "" : "; and ", list_of(names),
                            100 * claim.probability);
      }
      std::string text = where + "the data say " + what + ".";
      const double left = 1 - diagnosis.share_explained;
      if (left > 0.1) {
        text += fmt::format(" Named, but {:.0f} % of the excess misfit remains.",
                            100 * std::min(left, 1.0));
      }
      if (diagnosis.verdict == Verdict::kClass) {
        text += " These data cannot tell the names apart." + experiment_words(diagnosis);
      }
      return text;
    }
    case Verdict::kUnexplained:
      return where +
             "the mismatch is real and no known name explains it; it is modelled without a "
             "name, within the conditions measured only." +
             experiment_words(diagnosis);
  }
  return "";
}

}  // namespace regoplan
